#pragma once
// The first passes of every technique that lights the skin in its atlas: culls, the light map, and, where
// blurs are to be in millimetres, the atlas's metric and gutter texels that hold the light from across the UV
// seam.

#include <functional>

#include "dermis/technique/atlas_cull.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/shadow_channels.h"
#include "dermis/technique/transmission.h"

namespace dermis::inline technique {

/// Which texels no pass works on: those outside the view, those that face away, both.
enum class AtlasCull : int32_t { none, frustum, back_face, both };

/// The parameters of every technique that lights the skin in its atlas: a part of the technique's own, with
/// the rows of atlas_parameters().
struct AtlasParams {
    int32_t light_map_size = 512;  ///< texels: light_map_side()
    AtlasCull cull = AtlasCull::both;
    float kernel_growth = 0.5f;
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
};
[[nodiscard]] const ParameterTable& atlas_parameters();

/// Texels of the light map's side: light_map_size, or more where the atlas has gaps.
[[nodiscard]] int light_map_side(const AtlasParams& params, const FrameContext& frame);

/// `params` with a smaller light map, for Technique::coarse: `scale` times as large, but not under 256.
[[nodiscard]] AtlasParams coarse_light_map(AtlasParams params, float scale);

struct AtlasLightSettings {
    ShadowChannelSettings shadow;
    AtlasCullSettings cull;
    SpecularModel specular = SpecularModel::ggx;  ///< what the diffuse light is reduced by (forward.h)
    int size = 1024;                              ///< of the light map
    bool in_mm = false;
    bool carry_seams = true;  ///< in mm: blurs cross UV seams; else taps that leave a chart are dropped
    float pre_scatter = 0;    ///< the map takes base colour ^ this
    /// In mm: the metric's steps are kernel size * scale + bias long, and at most longest_texels.
    float kernel_scale_mm = 0, kernel_bias_mm = 1, longest_texels = 16;
};

/// Values that follow from the parameters and the size of the atlas's gaps.
[[nodiscard]] AtlasLightSettings atlas_light_settings(const AtlasParams& params, const FrameContext& frame);

/// In texels of the light map, the farthest that `length_mm` reaches on nearly all of the skin (99 % of its
/// area); longer steps are cut to it, so that culls know how far light is carried.
[[nodiscard]] float longest_step_texels(float length_mm, int size, const FrameContext& frame);

/// Side of a texel on the skin, the median by area.
[[nodiscard]] double typical_texel_mm(int size, const FrameContext& frame);

/// What passes into the shadow of the key light: `occluded` of it, and the tint of translucent surfaces to
/// the power `trans_shadow_alpha`.
struct ShadowStrength {
    float occluded = 0, trans_shadow_alpha = 1;
};

/// The uniform block Skin of shaders/atlas/light.glsl. `kept`: what the blur leaves of the light that a light
/// map with texels of this side on the skin cannot hold.
[[nodiscard]] std::vector<NamedValue> atlas_skin_values(const std::function<Vec3(double texel_mm)>& kept,
                                                        ShadowStrength shadow = {});

/// The share that `blur` leaves of a wave of 2.5 texels. The map holds half of such a wave: averaging a texel
/// and reading between texels leave sinc(1/2.5)^3 = .43 to sinc(1/2.5)^2 = .57. Captured shares with 2, 2.5
/// and 3 texels differ by .02 at most (head scan and bust, 128 and 256 pixels).
[[nodiscard]] Vec3 kept_of_half_held_wave(const GaussianSum& blur, double texel_mm);

/// Image "light_map_a" must be declared, in mm "light_map_b" too; the map ends in light_map_a. In mm it is
/// (exitance, 1) or 0, and the metric is there for read_atlas_metric(); else alpha is the kernel size and 1
/// where nothing was written.
void add_atlas_light(PassList& list, const AtlasLightSettings& settings, const FrameContext& frame);

/// For a pass whose shader includes shaders/atlas/blur_mm.glsl; its "source" is `source`.
void read_atlas_metric(Pass& pass, const std::string& source, const AtlasLightSettings& settings);

/// The same of shaders/atlas/walk_mm.glsl; ways from tap to tap are up to `longest_way` steps of the metric.
void read_atlas_walk(Pass& pass, const std::string& source, const AtlasLightSettings& settings,
                     float longest_way);

}  // namespace dermis::inline technique
