#pragma once
// A drawn frame to files.

#include <filesystem>
#include <string>

#include "dermis/image/io.h"
#include "dermis/render/renderer.h"

namespace dermis::inline render {

struct OutputSettings {
    int png_bits = 8;     ///< 8 or 16
    bool layers = false;  ///< EXR only: diffuse, specular and the G-buffer beside the picture
    std::string credit;   ///< is written into the file
    std::string description;
};

/// Whether `path` and the settings go together, before anything expensive runs.
[[nodiscard]] Result<void> check_output(const std::filesystem::path& path, const OutputSettings& settings);

/// The parts of a picture of the last frame: its linear numbers (radiance, or a view of the G-buffer), the
/// tone-mapped picture in the bits of a PNG, and the text that files of both carry.
[[nodiscard]] Result<Image> linear_picture(Renderer& renderer, const std::string& view);
[[nodiscard]] Result<Image> display_picture(Renderer& renderer, int png_bits);
[[nodiscard]] ImageText picture_text(const OutputSettings& settings);

/// PNG: the tone-mapped picture. EXR: linear radiance (half), layered when asked; layers draw the frame again
/// for each view. Uses the renderer's last draw, whose arguments these are.
[[nodiscard]] Result<void> write_output(Renderer& renderer, const Technique& technique,
                                        const ParameterValues& values, const DrawSettings& draw,
                                        const std::filesystem::path& path, const OutputSettings& settings);

}  // namespace dermis::inline render
