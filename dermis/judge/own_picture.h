#pragma once
// Pictures of another renderer for the judge: the same scene and camera, with and without scattering.

#include <filesystem>
#include <string>
#include <string_view>

#include "dermis/base/result.h"
#include "dermis/image/image.h"

namespace dermis::inline judge {

/// Linear, f32, of one size, without exposure. Light and albedo are the scene's: a white diffuse surface that
/// faces a light of intensity 1 has radiance 1 (docs/reference.md).
struct OwnPicture {
    std::string name;
    Image with, without;  ///< scattering; 3 or 4 channels
};

/// The row's id; its name is "picture[NAME]".
inline constexpr std::string_view kPictureId = "picture";
/// How far `without` may be from the baseline's picture, as RMS over the baseline's, before a warning says
/// so: highlights differ by less between renderers.
inline constexpr double kPictureDifference = 0.1;

struct OwnPictureFiles {
    std::string name;
    std::filesystem::path with, without;
};
/// "NAME=with.exr,without.exr". The error says how to write it.
[[nodiscard]] Result<OwnPictureFiles> parse_own_picture(std::string_view text);

/// Errors name the file: no linear floats (.exr, .hdr), sizes that differ, NaN.
[[nodiscard]] Result<OwnPicture> read_own_picture(const OwnPictureFiles& files);

/// Errors: no name or one with brackets, no colours, sizes that differ from each other or from the
/// comparison's, NaN.
[[nodiscard]] Result<void> check_own_picture(const OwnPicture& picture, int width, int height);

}  // namespace dermis::inline judge
