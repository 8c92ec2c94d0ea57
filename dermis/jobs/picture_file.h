#pragma once
// The file of a reference: layers, and what was rendered as JSON. One run and a merge of parts write it
// here, so that both write the same bytes.

#include <filesystem>
#include <string>
#include <vector>

#include "dermis/base/output_check.h"
#include "dermis/image/tone_map.h"
#include "dermis/reference/picture.h"

namespace dermis::inline jobs {

/// The text that a picture's files carry beside the pixels.
struct PictureFacts {
    std::string description = "{}";  ///< JSON object: scene and settings, in the order of the file
    std::string credit;              ///< empty, or the line that goes wherever the picture goes
    std::vector<std::string> scene_warnings;
    ToneMap tone_map = ToneMap::none;
    float exposure_ev = 0;
};

/// The facts' description with what came out: passes, relative_error, noise_reached, stopped, warnings. Keys
/// that the description has already stay where they are.
[[nodiscard]] std::string described(const PictureFacts& facts, const ReferencePicture& picture, bool stopped);

/// The outputs for check_outputs(): the picture as .exr; the preview, if any, in a format that is known. The
/// error names -o or --preview.
[[nodiscard]] Result<FileUse> picture_files(const std::filesystem::path& picture,
                                            const std::filesystem::path& preview,
                                            std::vector<std::filesystem::path> inputs = {});

/// Layers: R,G,B,A radiance and coverage; diffuse; specular; variance of the mean; samples; skin. `text` is
/// described() and is in the header as "dermis".
[[nodiscard]] Result<void> write_picture_file(const std::filesystem::path& path, const PictureFacts& facts,
                                              const ReferencePicture& picture, const std::string& text);

/// For display: the scene's exposure and tone map, 8 bits.
[[nodiscard]] Result<void> write_preview_file(const std::filesystem::path& path, const PictureFacts& facts,
                                              const ReferencePicture& picture);

}  // namespace dermis::inline jobs
