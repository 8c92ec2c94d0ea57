#include "dermis/jobs/picture_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"

namespace dermis::inline jobs {

std::string described(const PictureFacts& facts, const ReferencePicture& picture, bool stopped) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(facts.description, nullptr, false);
    std::vector<std::string> warnings = facts.scene_warnings;
    warnings.insert(warnings.end(), picture.warnings.begin(), picture.warnings.end());
    json["passes"] = picture.passes;
    json["relative_error"] = picture.relative_error;
    json["noise_reached"] = picture.reached_noise;
    json["stopped"] = stopped;
    json["warnings"] = warnings;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<FileUse> picture_files(const std::filesystem::path& picture, const std::filesystem::path& preview,
                              std::vector<std::filesystem::path> inputs) {
    if (to_lower(picture.extension().string()) != ".exr")
        return Error{"-o " + picture.string() + ": the reference is linear and layered; name a .exr file"};
    FileUse files = {.outputs = {picture}, .inputs = std::move(inputs)};
    if (preview.empty()) return files;
    if (const auto encoded =
            encode_image(preview.extension().string(), Image(1, 1, 3, PixelFormat::u8, Encoding::srgb), {});
        !encoded)
        return Error{"--preview " + preview.string() + ": " + encoded.error().message};
    files.outputs.push_back(preview);
    return files;
}

Result<void> write_picture_file(const std::filesystem::path& path, const PictureFacts& facts,
                                const ReferencePicture& picture, const std::string& text) {
    const ImageLayer layers[] = {{"", picture.radiance},         {"diffuse", picture.diffuse},
                                 {"specular", picture.specular}, {"variance", picture.variance},
                                 {"samples", picture.samples},   {"skin", picture.skin}};
    ImageText inside = {{"dermis", text}};
    if (!facts.credit.empty()) inside["credit"] = facts.credit;
    return write_layered_exr(path, layers, inside);
}

Result<void> write_preview_file(const std::filesystem::path& path, const PictureFacts& facts,
                                const ReferencePicture& picture) {
    const Image shown = tone_mapped(picture.radiance, facts.tone_map, std::exp2(facts.exposure_ev));
    Image opaque(shown.width, shown.height, 3);
    for (size_t i = 0; i < opaque.pixel_count(); ++i)
        std::copy_n(&shown.floats()[4 * i], 3, &opaque.floats()[3 * i]);
    const ImageText text = facts.credit.empty() ? ImageText{} : ImageText{{"credit", facts.credit}};
    return write_image(path, convert(opaque, PixelFormat::u8, Encoding::srgb), text);
}

}  // namespace dermis::inline jobs
