#include "dermis/scene/image_source.h"

#include <algorithm>
#include <cmath>

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
        image.bytes.assign(source.pixels.span().begin(), source.pixels.span().end());
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

namespace {

// Rows of the triangle's box, each from the first to the last covered centre by the three edges.
void fill_triangle(Image& mask, Vec2 a, Vec2 b, Vec2 c) {
    const float area = cross(b - a, c - a);
    if (area == 0) return;
    if (area < 0) std::swap(b, c);
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const int x0 = std::max(0, int(std::floor(low_x))), x1 = std::min(mask.width - 1, int(std::ceil(high_x)));
    const int y0 = std::max(0, int(std::floor(low_y))),
              y1 = std::min(mask.height - 1, int(std::ceil(high_y)));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const Vec2 p = {float(x) + 0.5f, float(y) + 0.5f};
            if (cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0)
                mask.bytes[size_t(y) * size_t(mask.width) + size_t(x)] = std::byte{255};
        }
}

bool inside(Vec2 uv) {
    return uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
}

}  // namespace

Image atlas_mask(const Mesh& mesh, int width, int height) {
    Image mask(width, height, 1, PixelFormat::u8);
    if (mesh.uvs.empty()) return mask;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vec2 corners[3];
        bool all_inside = true;
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 uv = mesh.uvs[mesh.indices[i + k]];
            all_inside = all_inside && inside(uv);
            corners[k] = {uv.x * float(width), uv.y * float(height)};
        }
        if (all_inside) fill_triangle(mask, corners[0], corners[1], corners[2]);
    }
    return mask;
}

}  // namespace dermis::inline scene
