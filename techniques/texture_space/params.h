#pragma once
// The parameters of texture_space, and what follows from them for the blur.

#include <cstdint>
#include <vector>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"
#include "techniques/texture_space/blur_fit.h"
#include "techniques/texture_space/constants.h"

namespace dermis::texture_space {

enum class Blur : int32_t { profile, source, set };
enum class Filter : int32_t {
    poisson = kFilterPoisson,
    gaussian = kFilterGaussian,
    box = kFilterBox,
    kawase = kFilterKawase
};
enum class Dilate : int32_t { off = kDilateOff, source = kDilateSource, written_only = kDilateWrittenOnly };
enum class Space : int32_t { texels = kSpaceTexels, mm = kSpaceMm };
enum class Seams : int32_t { drop, carry };
enum class SpecularShadow : int32_t {
    off = kSpecularShadowOff,
    source = kSpecularShadowSource,
    shadow_map = kSpecularShadowMap
};

inline constexpr float kMaxBlurRadius = 64;

struct Params {
    AtlasParams atlas;
    Blur blur = Blur::profile;
    Filter filter = Filter::gaussian;
    int32_t blur_passes = 4;
    float blur_scale = 2;
    float blur_bias = 1;
    Dilate dilate = Dilate::written_only;
    Space space = Space::mm;
    Seams seams = Seams::carry;
    bool single_channel_opacity = false;
    bool second_light_shadow = false;
    ShadowLookup shadow_lookup = ShadowLookup::disk;
    float exempt_1_u = 0, exempt_1_v = 0, exempt_1_radius = 0;
    float exempt_2_u = 0, exempt_2_v = 0, exempt_2_radius = 0;
    bool cull_distance = false;
    float cull_beyond_mm = 3000;
    SpecularShadow specular_shadow = SpecularShadow::shadow_map;
    float specular_shadow_scale = 1;
    float specular_shadow_bias = 0;
    SpecularModel specular = SpecularModel::ggx;
};

[[nodiscard]] ParameterTable parameter_table();

/// Radii are radius * (kernel map * kernel_scale + kernel_bias), in mm or texels.
struct BlurPlan {
    int size = 1024;  ///< of the light map
    Filter filter = Filter::poisson;
    bool in_mm = true;
    bool keeps_lit = true;  ///< the map before the blur is read by the final mesh too
    float kernel_scale = 0, kernel_bias = 1;
    std::vector<BlurPass> passes;
    float fitted_texel_mm = 0;  ///< for which passes were fitted; 0: set by hand, or in texels
    float tap_variance = 1;     ///< along one axis, at radius 1
};

[[nodiscard]] BlurPlan blur_plan(const Params& params, const FrameContext& frame);

/// blur=set as one Gaussian of the passes' variance where the kernel map is 0, in mm^2, or texels^2 with
/// space=texels.
[[nodiscard]] GaussianSum set_blur(const Params& params);

/// The farthest tap of a pass along one axis of the atlas, in radii of its filter.
[[nodiscard]] float widest_tap(Filter filter, size_t pass);

/// A smaller light map, and fewer of the blur's passes at a width that is the same: for Technique::coarse.
[[nodiscard]] Params coarse_params(Params params, float scale);

}  // namespace dermis::texture_space
