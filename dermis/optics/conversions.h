#pragma once
// The same skin in the words of other tools, and back.
//
// "Radius" is four different lengths in them: Burley's d, the mean free path 1 / sigma_t, the diffuse mean
// free path 1 / sigma_tr, or the width of a blur; in mm, cm, m or scene units. Everything goes through one
// canonical form, per channel {albedo A, Burley d in mm}, so that a conversion is two steps and each names
// its quantity, unit and boundary assumption. The table of docs/profiles.md is made from this.
//
//     Result<ToolId> hdrp = find_tool("hdrp");
//     ToolSettings settings = to_tool(*hdrp, burley_equivalent(*find_profile("jensen_skin1")));

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

enum class ToolId {
    faceworks,
    separable_sss,
    hdrp,
    unreal,
    babylon,
    blender_burley,
    blender_random_walk,
    blender_random_walk_skin,
    openpbr,
    gltf_volume_scatter,
    pbrt,
};

/// One parameter of a tool as its own interface names it. Scalars hold their number in value[0].
struct ToolKey {
    std::string_view name;
    int count;  ///< 1, or 3 for red, green, blue
    Rgb default_value;
    double min, max;
    std::string_view unit;  ///< "" for ratios and colours
    std::string_view meaning;
};

/// The meaning of a tool's numbers.
struct ToolConvention {
    ToolId id;
    std::string_view name;
    std::string_view length;    ///< the physical quantity behind its "radius"
    std::string_view boundary;  ///< what is assumed of the surface that light enters and leaves by
    std::string_view lost;      ///< what of {A, d} it cannot hold; "" if nothing
    std::vector<ToolKey> keys;
};

struct ToolSettings {
    ToolId tool;
    std::vector<Rgb> values;  ///< in the order of the convention's keys
};

[[nodiscard]] const std::vector<ToolConvention>& tool_conventions();
[[nodiscard]] const ToolConvention& convention_of(ToolId tool);
/// Errors: an unknown name; the message has the closest known one.
[[nodiscard]] Result<ToolId> find_tool(std::string_view name);

/// The tool's own defaults where it has some, else a plausible skin.
[[nodiscard]] ToolSettings default_settings(ToolId tool);

/// Sets one key. Errors: an unknown key, a number out of the key's range, not `count` (or one) numbers.
[[nodiscard]] Result<void> set_value(ToolSettings& settings, std::string_view key,
                                     const std::vector<double>& numbers);

/// burley is check()ed. Round trips to_canonical(to_tool(x)) = x within 1e-9 but for what the convention
/// names as lost.
[[nodiscard]] ToolSettings to_tool(ToolId tool, const BurleyProfile& burley);
[[nodiscard]] Result<BurleyProfile> to_canonical(const ToolSettings& settings);

/// The volume whose half-space shows the profile's albedo under diffuse light and, by Christensen and Burley
/// 2015, equation 6, blurs it with the profile's d: index-matched albedo inversion, reduced mean free path
/// s(A) d. For a random walk. An albedo of 1 gives a medium without absorption, whose walk ends only at the
/// surface.
[[nodiscard]] ScatteringMedium medium_of(const BurleyProfile& burley, double g, double eta);
/// The volume of a random walk for a profile: a dipole's own, else the medium above for the Burley profile of
/// the same albedo, mean radius and g, index-matched. docs/figures.md has the error of its half-space.
[[nodiscard]] ScatteringMedium walk_medium_of(const Profile& profile);

/// An albedo of 1 means a pure blur whose colour lies in a map: no volume that absorbs looks so. Its walks
/// take a volume of kBlurAlbedo and the same mean radius.
inline constexpr double kBlurAlbedo = 0.5;
[[nodiscard]] bool is_pure_blur(const Profile& profile, int channel);
/// One line that names the channels that got kBlurAlbedo; "" if none did.
[[nodiscard]] std::string walk_volume_note(const Profile& profile);

/// d / (1 - alpha g) and times (1 - alpha g): between a length that tools state for sigma_t and that of
/// isotropic scattering of the same sigma_t' = sigma_t (1 - alpha g).
[[nodiscard]] BurleyProfile with_anisotropy(BurleyProfile isotropic, double g);
[[nodiscard]] BurleyProfile without_anisotropy(BurleyProfile burley);
/// The inverse conversion; its albedo is within 1e-4.
[[nodiscard]] BurleyProfile burley_of(const ScatteringMedium& medium);

}  // namespace dermis::inline optics
