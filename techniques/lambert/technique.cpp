// Lambert 1760, Photometria: a surface whose radiance is the same in all directions. It does not scatter and
// is the baseline of every comparison.

#include "dermis/technique/forward.h"

namespace dermis {
namespace {

struct Params {
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    return {.passes = {forward_skin_pass("lambert/lambert.frag", values.as<Params>().specular, frame)}};
}

}  // namespace

Technique make_lambert_technique() {
    return {.id = "lambert",
            .summary = "no scattering: the baseline",
            .source = "Lambert 1760, Photometria",
            .is_baseline = true,
            .parameters = parameters(),
            .build = build};
}

}  // namespace dermis
