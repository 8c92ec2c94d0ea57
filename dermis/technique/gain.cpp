#include "dermis/technique/gain.h"

#include <algorithm>
#include <utility>

#include "dermis/technique/transmission.h"

namespace dermis::inline technique {

const std::vector<std::string>& gain_names() {
    static const std::vector<std::string> kNames = {"none", "curvature", "map", "links"};
    return kNames;
}

void use_gain(Pass& pass, Gain gain) {
    pass.constants.emplace_back(kGainConstant, int32_t(gain));
    // Links bring the light through thin parts, too.
    if (gain != Gain::links) return;
    const auto transmission =
        std::ranges::find(pass.constants, kTransmissionConstant, &std::pair<std::string, int32_t>::first);
    if (transmission != pass.constants.end()) transmission->second = kTransmissionNone;
}

Gain gain_of(const ParameterValues& values) {
    const Parameter* gain = values.table().find("gain");
    return gain ? Gain(int32_t(values.get(*gain)[0])) : Gain::none;
}

ParameterValues with_gain(ParameterValues values, Gain gain) {
    if (const Parameter* own = values.table().find("gain")) values.put(*own, {double(gain), 0, 0});
    return values;
}

ParameterValues without_gain(ParameterValues values) {
    return with_gain(std::move(values), Gain::none);
}

}  // namespace dermis::inline technique
