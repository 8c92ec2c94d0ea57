#pragma once
// Profiles as MaterialX documents (.mtlx): the subsurface of one OpenPBR surface, node open_pbr_surface.
//
// subsurface_radius * subsurface_radius_scale is read and written as OpenPBR 1.1 defines it: the mean free
// path 1 / sigma_t, of a volume whose half-space shows subsurface_color. (OpenPBR's own example skins hold
// diffuse mean free paths there: the presets openpbr_skin_1 to _6.) The unit is that of the file, or cm.
// subsurface_color is linear Rec. 709, or converted from the colour space that the file names. The radius
// scale is a length per channel and no colour: it is not converted.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// A Burley profile. `place` names the text in errors: "skin.mtlx:3: ...". What was assumed, converted or not
/// read follows the file's name in `source`, separated by semicolons.
/// Errors: not XML, no open_pbr_surface or several, subsurface_weight 0, an input that is connected to a
/// node, a number out of its range (also of MtlxSurface), an unknown unit or colour space.
[[nodiscard]] Result<Profile> parse_mtlx(std::string_view text, std::string_view place);
[[nodiscard]] Result<Profile> read_mtlx(const std::filesystem::path& path);

/// Values of the surface that belong to a scene's skin, not to a profile; nothing where the file does not
/// say it, or by a map. Both as skin.roughness and skin.ior of a scene: perceptual
/// roughness, and the index of refraction.
struct MtlxSurface {
    std::optional<double> roughness, ior;
};
/// Errors: those of read_mtlx for a document that does not have one surface, and a number out of its range.
[[nodiscard]] Result<MtlxSurface> read_mtlx_surface(const std::filesystem::path& path);

/// A document of version 1.39 with the surface and its material; radius in cm, colour in lin_rec709, as that
/// of the base too. Without scattering direction: subsurface_scatter_anisotropy is 0.
[[nodiscard]] std::string mtlx_text(const Profile& profile);
/// What the document of `written` loses of its profile, and the meaning of its numbers; a
/// sentence each.
[[nodiscard]] std::vector<std::string> mtlx_notes(const Profile& profile, const Profile& written);

}  // namespace dermis::inline optics
