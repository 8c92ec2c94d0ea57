// Oren, Nayar 1994: diffuse reflection of a surface made of Lambertian facets. It flattens the shading as
// rough skin does and does not scatter.

#include "dermis/technique/forward.h"

namespace dermis {
namespace {

struct Params {
    float facet_sigma_rad = 0.35f;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .number(&Params::facet_sigma_rad, "facet_sigma_rad", "rad", 0, 1.5707963,
                "standard deviation of the facets' slope angle; 0 is Lambert")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    return {.passes = {forward_skin_pass("oren_nayar/oren_nayar.frag", values.as<Params>().specular, frame)}};
}

}  // namespace

Technique make_oren_nayar_technique() {
    return {.id = "oren_nayar",
            .summary = "rough diffuse reflection, no scattering",
            .source = "Oren, Nayar 1994, Generalization of Lambert's Reflectance Model",
            .parameters = parameters(),
            .build = build};
}

}  // namespace dermis
