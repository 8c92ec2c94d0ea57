#include "dermis/scene/image_source.h"

namespace dermis {

Result<Image> load_image_source(const ImageSource& source, ImageUse use) {
    if (!source.pixels.empty()) {
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
