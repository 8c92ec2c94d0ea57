#include "dermis/engines/web/parts.h"

#include <algorithm>

#include "dermis/image/colour.h"
#include "dermis/image/dilate.h"
#include "dermis/image/resample.h"
#include "dermis/render/material_maps.h"
#include "dermis/scene/image_source.h"
#include "dermis/scene/skin_profiles.h"

namespace dermis::inline engines::web {
namespace {

constexpr int kQuality = 82;

struct Sides {
    int width = 1, height = 1;
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

}  // namespace

Result<Image> load_map(const Material& material, const Mesh& mesh, std::string_view texture, int side) {
    const auto map = std::ranges::find(material_maps(), texture, &MaterialMap::texture);
    const ImageSource* source = map_source(*map, material);
    if (!source) return Image();
    DERMIS_TRY_ASSIGN(Image image,
                      load_image_source(*source, map->is_color ? ImageUse::color : ImageUse::data));
    if (material.dilate_texels > 0)
        dilate(image, atlas_mask(mesh, image.width, image.height), material.dilate_texels);
    if (map->is_single) {
        const int channel = source == &(material.*map->source) ? map->preferred_channel : map->packed_channel;
        image = single_channel(image, channel < image.channels ? channel : 0);
    }
    const Texels texels = texture == "normal_map" ? Texels::unit_vectors : Texels::values;
    const int longest = std::max(image.width, image.height);
    if (longest > side)
        image = resize(image, std::max(image.width * side / longest, 1),
                       std::max(image.height * side / longest, 1), texels);
    return image;
}

void warn_of_materials(const Scene& scene, std::string_view product, std::vector<std::string>& warnings) {
    const std::string all = "all skin of the " + std::string(product);
    if (skin_profiles(scene) != std::vector{scene.skin.profile})
        warnings.push_back("profiles of materials are dropped: " + all + " has " + scene.skin.profile);
    if (has_scatter_weights(scene))
        warnings.push_back("scatter of materials is dropped: " + all + " scatters");
}

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

Result<nlohmann::json> add_maps(std::vector<WebFile>& files, const Material& material, const Mesh& mesh,
                                const std::string& prefix, int map_side) {
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
        DERMIS_TRY_ASSIGN(const Image image, load_map(material, mesh, texture, map_side));
        if (image.empty()) continue;
        const std::string_view textures[] = {texture};
        DERMIS_TRY(add(name, three_channels(image), textures));
    }
    std::array<Image, 3> singles;
    constexpr std::string_view kTextures[] = {"roughness_map", "specular_map", "occlusion_map"};
    for (size_t i = 0; i < singles.size(); ++i) {
        DERMIS_TRY_ASSIGN(singles[i], load_map(material, mesh, kTextures[i], map_side));
    }
    if (std::ranges::any_of(singles, [](const Image& image) { return !image.empty(); }))
        DERMIS_TRY(add("surface", packed(singles), kTextures));
    return made;
}

}  // namespace dermis::inline engines::web
