#include "dermis/engines/web/parts.h"

#include <algorithm>

#include "dermis/image/colour.h"
#include "dermis/image/dilate.h"
#include "dermis/image/resample.h"
#include "dermis/render/material_maps.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline engines::web {
namespace {

constexpr int kQuality = 82;

struct Sides {
    int width = 1, height = 1;
};

class MapWriter {
  public:
    MapWriter(const Material& material, const Mesh& mesh, int side)
        : material_(material), mesh_(mesh), side_(side) {}

    // The image behind a texture of shaders/include/surface.glsl, no larger than it may be; empty: none.
    Result<Image> load(std::string_view texture) const {
        const auto map = std::ranges::find(material_maps(), texture, &MaterialMap::texture);
        const ImageSource* source = map_source(*map, material_);
        if (!source) return Image();
        DERMIS_TRY_ASSIGN(Image image,
                          load_image_source(*source, map->is_color ? ImageUse::color : ImageUse::data));
        if (material_.dilate_texels > 0)
            dilate(image, atlas_mask(mesh_, image.width, image.height), material_.dilate_texels);
        if (map->is_single) {
            const int channel =
                source == &(material_.*map->source) ? map->preferred_channel : map->packed_channel;
            image = single_channel(image, channel < image.channels ? channel : 0);
        }
        const Texels texels = texture == "normal_map" ? Texels::unit_vectors : Texels::values;
        const int longest = std::max(image.width, image.height);
        if (longest > side_)
            image = resize(image, std::max(image.width * side_ / longest, 1),
                           std::max(image.height * side_ / longest, 1), texels);
        return image;
    }

  private:
    const Material& material_;
    const Mesh& mesh_;
    int side_;
};

constexpr std::string_view wrap_name(TextureWrap wrap) {
    return wrap == TextureWrap::clamp ? "clamp" : wrap == TextureWrap::mirror ? "mirror" : "repeat";
}

// The common wrap modes of the maps in one picture, along u and v. Error: they differ.
Result<nlohmann::json> wrap_of(const Material& material, std::span<const std::string_view> textures) {
    nlohmann::json wrap;
    for (const std::string_view texture : textures) {
        const auto map = std::ranges::find(material_maps(), texture, &MaterialMap::texture);
        const ImageSource* source = map_source(*map, material);
        if (!source) continue;
        const nlohmann::json found = {wrap_name(source->wrap_u), wrap_name(source->wrap_v)};
        if (!wrap.is_null() && wrap != found)
            return Error{
                "material '" + material.name +
                "': its maps of roughness, specular and occlusion are one picture on the page, but do "
                "not wrap alike; give them the same wrap mode"};
        wrap = found;
    }
    return wrap;
}

// Three channels of 8 bits; what is missing is 1.
Image three_channels(const Image& image) {
    const Image bytes = image.format == PixelFormat::u8
                            ? image
                            : convert(to_linear_float(image), PixelFormat::u8, image.encoding);
    if (bytes.channels == 3) return bytes;
    Image three(bytes.width, bytes.height, 3, PixelFormat::u8, bytes.encoding);
    for (int y = 0; y < bytes.height; ++y)
        for (int x = 0; x < bytes.width; ++x)
            for (int c = 0; c < 3; ++c) three.set(x, y, c, bytes.at(x, y, bytes.channels > 2 ? c : 0));
    return three;
}

// Three maps of one channel as one picture of the largest one's size.
Image packed(const std::array<Image, 3>& singles) {
    Sides sides;
    for (const Image& image : singles)
        sides = {std::max(sides.width, image.width), std::max(sides.height, image.height)};
    Image all(sides.width, sides.height, 3, PixelFormat::u8);
    for (int c = 0; c < 3; ++c) {
        const Image& single = singles[size_t(c)];
        const Image sized = single.empty() ? Image() : resize(single, sides.width, sides.height);
        for (int y = 0; y < sides.height; ++y)
            for (int x = 0; x < sides.width; ++x) all.set(x, y, c, sized.empty() ? 1.0f : sized.at(x, y, 0));
    }
    return all;
}

}  // namespace

Result<nlohmann::json> add_maps(std::vector<WebFile>& files, const Material& material, const Mesh& mesh,
                                const std::string& prefix, int map_side) {
    const MapWriter maps(material, mesh, map_side);
    nlohmann::json made = {{"maps", nlohmann::json::object()}};
    const auto add = [&](const std::string& name, const Image& image,
                         std::span<const std::string_view> textures) -> Result<void> {
        DERMIS_TRY_ASSIGN(const nlohmann::json wrap, wrap_of(material, textures));
        if (wrap != nlohmann::json{"repeat", "repeat"}) made["wraps"][name] = wrap;
        DERMIS_TRY_ASSIGN(std::vector<std::byte> jpeg, encode_jpeg(image, kQuality));
        const std::string path = "maps/" + prefix + "_" + name + ".jpg";
        made["maps"][name] = path;
        files.push_back({path, std::move(jpeg)});
        return {};
    };
    for (const std::string name : {"albedo", "normal"}) {
        const std::string texture = name + "_map";
        DERMIS_TRY_ASSIGN(const Image image, maps.load(texture));
        if (image.empty()) continue;
        const std::string_view textures[] = {texture};
        DERMIS_TRY(add(name, three_channels(image), textures));
    }
    std::array<Image, 3> singles;
    constexpr std::string_view kTextures[] = {"roughness_map", "specular_map", "occlusion_map"};
    for (size_t i = 0; i < singles.size(); ++i) {
        DERMIS_TRY_ASSIGN(singles[i], maps.load(kTextures[i]));
    }
    if (std::ranges::any_of(singles, [](const Image& image) { return !image.empty(); }))
        DERMIS_TRY(add("surface", packed(singles), kTextures));
    return made;
}

}  // namespace dermis::inline engines::web
