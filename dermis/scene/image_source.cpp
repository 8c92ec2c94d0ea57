#include "dermis/scene/image_source.h"

namespace dermis {

Result<Image> load_image_source(const ImageSource& source, ImageUse use) {
    if (!source.pixels.empty()) {
        if (source.width < 1 || source.height < 1 || source.channels < 1 || source.channels > 4 ||
            source.pixels.size() != size_t(source.width) * size_t(source.height) * size_t(source.channels))
            return Error{source.name + ": " + std::to_string(source.width) + " x " +
                         std::to_string(source.height) + " texels of " + std::to_string(source.channels) +
                         " channels cannot be " + std::to_string(source.pixels.size()) + " bytes"};
        Image image;
        image.width = source.width, image.height = source.height, image.channels = source.channels;
        image.format = PixelFormat::u8;
        image.encoding = use == ImageUse::color ? Encoding::srgb : Encoding::linear;
        image.bytes = source.pixels;
        return image;
    }
    Result<LoadedImage> loaded = source.encoded.empty() ? read_image(source.name, use)
                                                        : decode_image(source.encoded, source.name, use);
    if (!loaded) return loaded.error();
    return std::move(loaded->image);
}

}  // namespace dermis
