#include "dermis/scene/image_source.h"

#include <algorithm>

namespace dermis::inline scene {

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
    if (!loaded && !source.named_by.empty())
        return Error{loaded.error().message + " (named by " + source.named_by + ")"};
    if (!loaded) return loaded.error();
    return std::move(loaded->image);
}

Result<Image> load_alpha(const Material& material) {
    // A map of all four channels is named twice in MTL files.
    const bool own = material.alpha_map.present() && material.alpha_map.name != material.base_color_map.name;
    Image one(1, 1, 1, PixelFormat::u8);
    one.set(0, 0, 0, 1);
    if (!own && !material.base_color_map.present()) return one;
    DERMIS_TRY_ASSIGN(Image image,
                      load_image_source(own ? material.alpha_map : material.base_color_map, ImageUse::data));
    const int alpha = alpha_channel(image);
    if (alpha < 0 && !own) return one;
    return single_channel(image, std::max(alpha, 0));
}

}  // namespace dermis::inline scene
