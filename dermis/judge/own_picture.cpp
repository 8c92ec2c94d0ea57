#include "dermis/judge/own_picture.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/io.h"

namespace dermis::inline judge {
namespace {

Result<Image> read_linear(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const LoadedImage loaded, read_image(path, ImageUse::data));
    const PixelFormat format = loaded.image.format;
    if (format != PixelFormat::f16 && format != PixelFormat::f32)
        return Error{path.string() + ": has " + (format == PixelFormat::u8 ? "8" : "16") +
                     "-bit numbers; shares need linear floats: write .exr or .hdr"};
    return to_linear_float(loaded.image);
}

std::string size_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

}  // namespace

Result<OwnPictureFiles> parse_own_picture(std::string_view text) {
    const size_t equals = text.find('='), comma = text.rfind(',');
    if (equals == std::string_view::npos || comma == std::string_view::npos || comma < equals)
        return Error{"'" + std::string(text) + "': write NAME=with.exr,without.exr"};
    OwnPictureFiles files{.name = std::string(text.substr(0, equals)),
                          .with = text.substr(equals + 1, comma - equals - 1),
                          .without = text.substr(comma + 1)};
    if (files.name.empty() || files.with.empty() || files.without.empty())
        return Error{"'" + std::string(text) + "': write NAME=with.exr,without.exr"};
    return files;
}

Result<OwnPicture> read_own_picture(const OwnPictureFiles& files) {
    DERMIS_TRY_ASSIGN(Image with, read_linear(files.with));
    DERMIS_TRY_ASSIGN(Image without, read_linear(files.without));
    return OwnPicture{files.name, std::move(with), std::move(without)};
}

Result<void> check_own_picture(const OwnPicture& picture, int width, int height) {
    if (picture.name.empty() || picture.name.find_first_of("[],\"") != std::string::npos)
        return Error{"the name '" + picture.name + "' of a picture: letters, digits, '_' and '-'"};
    for (const auto& [image, which] : {std::pair(&picture.with, "with"), {&picture.without, "without"}}) {
        const std::string place = picture.name + ", " + which + " scattering: ";
        if (image->channels < 3) return Error{place + "has no colours; three channels are judged"};
        if (image->width != width || image->height != height)
            return Error{place + "is " + size_text(*image) + ", the comparison " + std::to_string(width) +
                         "x" + std::to_string(height)};
        if (!std::ranges::all_of(image->floats(), [](float v) { return std::isfinite(v); }))
            return Error{place + "has values that are no numbers"};
    }
    return {};
}

}  // namespace dermis::inline judge
