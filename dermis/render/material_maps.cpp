#include "dermis/render/material_maps.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dermis/base/parallel.h"
#include "dermis/base/vec.h"
#include "dermis/image/dilate.h"
#include "dermis/image/resample.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline render {
namespace {

// 8-bit images keep their bits (a copy, four channels); anything deeper becomes half floats.
std::vector<std::byte> expand_to_four(const Image& image) {
    const size_t count = image.pixel_count();
    std::vector<std::byte> out(count * 4, std::byte{255});
    const auto* in = image.bytes.data();
    const int channels = image.channels;
    for (size_t i = 0; i < count; ++i) {
        const std::byte* texel = in + i * size_t(channels);
        std::byte* target = out.data() + i * 4;
        target[0] = texel[0];
        target[1] = texel[channels >= 3 ? 1 : 0];
        target[2] = texel[channels >= 3 ? 2 : 0];
        if (channels == 4) target[3] = texel[3];
    }
    return out;
}

Image to_half_image(const Image& image, int channels) {
    Image half(image.width, image.height, channels, PixelFormat::f16);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < channels; ++c) {
                const bool present = c < image.channels;
                half.set(x, y, c, present ? image.at(x, y, c) : c == 3 ? 1.0f : image.at(x, y, 0));
            }
    return half;
}

// Unit normals in 16 bits: the length in smaller levels then tells how far the normals differ. In 8 bits,
// rounded at every level, a mean of shallow bumps would be off by half of their slope.
Image to_normals(const Image& image) {
    if (image.encoding != Encoding::linear) return to_normals(to_linear_float(image));
    Image normals(image.width, image.height, 4, PixelFormat::u16);
    parallel_for(size_t(image.height), 16, [&](size_t begin, size_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width; ++x) {
                Vec3 n = {image.at(x, y, 0) * 2 - 1, image.at(x, y, 1) * 2 - 1, image.at(x, y, 2) * 2 - 1};
                n = dot(n, n) > 0 ? normalize(n) : Vec3{0, 0, 1};
                normals.set(x, y, 0, n.x * 0.5f + 0.5f);
                normals.set(x, y, 1, n.y * 0.5f + 0.5f);
                normals.set(x, y, 2, n.z * 0.5f + 0.5f);
                normals.set(x, y, 3, 1);
            }
    });
    return normals;
}

gpu::AddressMode address_mode(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::repeat:
            return gpu::AddressMode::repeat;
        case TextureWrap::clamp:
            return gpu::AddressMode::clamp;
        case TextureWrap::mirror:
            return gpu::AddressMode::mirror;
    }
    return gpu::AddressMode::repeat;
}

// A grey map holds mean curvature alone; its other two channels become those of flat skin.
Image curvature_channels(Image image, float mid, std::string& warning, const std::string& name) {
    image = to_linear_float(image);
    if (image.channels >= 3 && !is_grey(image)) return image;
    warning = name +
              ": holds mean curvature only, so skin scatters as on a sphere of it, not at all on a saddle; "
              "`dermis bake curvature` writes how it bends in each direction";
    Image channels(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) channels.set(x, y, c, c == 0 ? image.at(x, y, 0) : mid);
    return channels;
}

}  // namespace

const std::vector<MaterialMap>& material_maps() {
    static const std::vector<MaterialMap> kMaps = {
        {.texture = "albedo_map", .source = &Material::base_color_map, .is_color = true},
        {.texture = "normal_map",
         .source = &Material::normal_map,
         .is_normals = true,
         .neutral = {128, 128, 255, 255}},
        {.texture = "wrinkle_maps",
         .source = &Material::wrinkle_stretch_map,
         .is_normals = true,
         .second_layer = &Material::wrinkle_compress_map,
         .neutral = {128, 128, 255, 255}},
        {.texture = "specular_map",
         .source = &Material::specular_map,
         .is_single = true,
         .preferred_channel = 3},
        {.texture = "roughness_map",
         .source = &Material::roughness_map,
         .is_single = true,
         .packed = &Material::metallic_roughness_map,
         .packed_channel = 1},
        {.texture = "metallic_map",
         .source = &Material::metallic_map,
         .is_single = true,
         .packed = &Material::metallic_roughness_map,
         .packed_channel = 2},
        {.texture = "occlusion_map", .source = &Material::occlusion_map, .is_single = true},
        {.texture = "thickness_map",
         .source = &Material::thickness_map,
         .is_single = true,
         .preferred_channel = 1},
        {.texture = "kernel_size_map",
         .source = &Material::kernel_size_map,
         .is_single = true,
         .neutral = {}},
        {.texture = "scatter_map", .source = &Material::scatter_map, .is_single = true},
        {.texture = "curvature_map", .source = &Material::curvature_map, .neutral = {}},
        {.texture = "opacity_map", .source = &Material::opacity_map, .is_color = true},
        {.texture = "emission_map", .source = &Material::emission_map, .is_color = true},
        {.texture = "alpha_map",
         .source = &Material::alpha_map,
         .is_single = true,
         .packed = &Material::base_color_map}};
    return kMaps;
}

const ImageSource* map_source(const MaterialMap& map, const Material& material) {
    if (map.source == &Material::alpha_map && cutoff_of_map(material) == 0) return nullptr;
    if ((material.*map.source).present()) return &(material.*map.source);
    for (const auto other : {map.packed, map.second_layer})
        if (other && (material.*other).present()) return &(material.*other);
    return nullptr;
}

std::vector<std::string> missing_map_warnings(const Scene& scene, std::string_view texture) {
    const auto map = std::ranges::find(material_maps(), texture, &MaterialMap::texture);
    std::string key(texture.substr(0, texture.rfind("_map")));
    std::vector<std::string> warnings;
    for (const SceneObject& object : scene.objects)
        for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
            if (object.classes[i] != MaterialClass::skin || map_source(*map, object.mesh.materials[i]))
                continue;
            warnings.push_back("material '" + object.mesh.materials[i].name + "' has no " + key +
                               " map, which these settings need; name one as " + key +
                               " under [maps] of a scene file, or choose another setting");
        }
    return warnings;
}

gpu::TextureData neutral_map(const MaterialMap& map) {
    gpu::TextureData data = {.name = map.texture + " (neutral)",
                             .format = map.is_single ? ImageFormat::r8 : ImageFormat::rgba8,
                             .srgb = map.is_color};
    data.layers = map.second_layer ? 2 : 1;
    for (int layer = 0; layer < data.layers; ++layer)
        for (size_t i = 0; i < bytes_per_texel(data.format); ++i)
            data.bytes.push_back(std::byte{map.neutral[i]});
    return data;
}

namespace {

// A layer that is absent is black, as nothing reads it.
Result<LoadedMap> load_layers(const MaterialMap& map, const Material& material, const Mesh& mesh) {
    const ImageSource& source = *map_source(map, material);
    LoadedMap loaded;
    Image layers[2];
    int width = 1, height = 1;
    for (const int layer : {0, 1}) {
        const ImageSource& of_layer = material.*(layer == 0 ? map.source : map.second_layer);
        if (!of_layer.present()) continue;
        DERMIS_TRY_ASSIGN(Image image, load_image_source(of_layer, ImageUse::data));
        if (image.channels < 3) return Error{of_layer.name + ": a normal map has red, green and blue"};
        if (const auto doubt = doubt_of_normal_map(image, material.normal_space))
            loaded.warning = of_layer.name + ": given as a normal map, but " + *doubt;
        if (material.dilate_texels > 0)
            dilate(image, atlas_mask(mesh, image.width, image.height), material.dilate_texels);
        layers[layer] = to_normals(image);
        width = std::max(width, image.width), height = std::max(height, image.height);
    }
    loaded.texture = {.name = source.name,
                      .format = ImageFormat::rgba16,
                      .width = width,
                      .height = height,
                      .layers = 2,
                      .generate_mips = true,
                      .address_u = address_mode(source.wrap_u),
                      .address_v = address_mode(source.wrap_v)};
    for (Image& layer : layers) {
        if (layer.empty()) layer = Image(width, height, 4, PixelFormat::u16);
        if (layer.width != width || layer.height != height)
            layer = resize(layer, width, height, Texels::unit_vectors);
        loaded.texture.bytes.insert(loaded.texture.bytes.end(), layer.bytes.begin(), layer.bytes.end());
    }
    return loaded;
}

}  // namespace

Result<LoadedMap> load_material_map(const MaterialMap& map, const Material& material, const Mesh& mesh) {
    if (map.second_layer) return load_layers(map, material, mesh);
    const ImageSource& source = *map_source(map, material);
    const int channel = &source == &(material.*map.source) ? map.preferred_channel : map.packed_channel;
    DERMIS_TRY_ASSIGN(Image decoded,
                      map.source == &Material::alpha_map
                          ? load_alpha(material)
                          : load_image_source(source, map.is_color ? ImageUse::color : ImageUse::data));
    Image& image = decoded;
    std::string warning;
    if (map.is_normals)
        if (const auto doubt = doubt_of_normal_map(image, material.normal_space))
            warning = source.name + ": given as a normal map, but " + *doubt;
    if (map.source == &Material::curvature_map)
        image = curvature_channels(std::move(image), material.curvature_mid, warning, source.name);
    if (material.dilate_texels > 0)
        dilate(image, atlas_mask(mesh, image.width, image.height), material.dilate_texels);
    gpu::TextureData data = {.name = source.name, .width = image.width, .height = image.height};
    data.generate_mips = true;
    data.address_u = address_mode(source.wrap_u), data.address_v = address_mode(source.wrap_v);
    if (map.is_single) {
        const Image single = single_channel(image, channel < image.channels ? channel : 0);
        data.format = single.format == PixelFormat::u8 ? ImageFormat::r8 : ImageFormat::r16f;
        data.bytes = single.format == PixelFormat::u8 ? single.bytes : to_half_image(single, 1).bytes;
    } else if (map.is_normals && image.channels >= 3) {
        data.format = ImageFormat::rgba16;
        data.bytes = to_normals(image).bytes;
    } else if (image.format == PixelFormat::u8) {
        data.format = ImageFormat::rgba8;
        data.srgb = image.encoding == Encoding::srgb;
        data.bytes = expand_to_four(image);
    } else {
        data.format = ImageFormat::rgba16f;
        data.bytes = to_half_image(to_linear_float(image), 4).bytes;
    }
    return LoadedMap{std::move(data), std::move(warning)};
}

namespace {

struct NormalCount {
    size_t texels = 0;  // that are neither black nor white
    size_t unit = 0;    // of them, vectors of about unit length
    double sum_z = 0;   // over those
};

// Some 65,536 texels, on a grid.
NormalCount count_normals(const Image& image) {
    constexpr int kSide = 256;
    constexpr float kTolerance = 0.2f;  // blurred and compressed maps have shorter vectors
    const int step_x = std::max(1, image.width / kSide), step_y = std::max(1, image.height / kSide);
    NormalCount count;
    for (int y = step_y / 2; y < image.height; y += step_y)
        for (int x = step_x / 2; x < image.width; x += step_x) {
            const Vec3 code = {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
            const float low = std::min({code.x, code.y, code.z}), high = std::max({code.x, code.y, code.z});
            if (high < 0.02f || low > 0.98f) continue;
            ++count.texels;
            const Vec3 n = code * 2.0f - Vec3{1, 1, 1};
            if (std::abs(length(n) - 1) > kTolerance) continue;
            ++count.unit;
            count.sum_z += n.z;
        }
    return count;
}

}  // namespace

std::optional<std::string> doubt_of_normal_map(const Image& image, NormalSpace space) {
    // Measured on maps of heads: tangent space 0.95 and above, object space 0.1 to 0.3.
    constexpr double kTangentZ = 0.6, kLeastUnit = 0.5;
    if (image.channels < 3)
        return "a normal map has three channels, this has " + std::to_string(image.channels);
    const NormalCount count = count_normals(image);
    if (count.texels == 0) return std::nullopt;
    if (double(count.unit) < kLeastUnit * double(count.texels))
        return "most of its texels are no unit vectors: is it a colour map, or one of heights (give that as "
               "displacement)?";
    const double mean_z = count.sum_z / double(count.unit);
    if (space == NormalSpace::tangent && mean_z < kTangentZ)
        return "its normals point in all directions: if it is an object-space map, say normal_space = "
               "\"object\" under [maps]";
    if (space == NormalSpace::object && mean_z > 0.9)
        return "all of its normals point along +Z: if it is a tangent-space map, say normal_space = "
               "\"tangent\" under [maps]";
    return std::nullopt;
}

}  // namespace dermis::inline render
