#include "dermis/technique/gain.h"

namespace dermis::inline technique {

const std::vector<std::string>& gain_names() {
    static const std::vector<std::string> kNames = {"none", "curvature", "map"};
    return kNames;
}

void use_gain(Pass& pass, Gain gain) {
    pass.constants.emplace_back(kGainConstant, int32_t(gain));
}

ParameterValues without_gain(ParameterValues values) {
    if (const Parameter* gain = values.table().find("gain")) values.put(*gain, {double(Gain::none), 0, 0});
    return values;
}

}  // namespace dermis::inline technique
