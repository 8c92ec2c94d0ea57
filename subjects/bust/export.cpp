#include "subjects/bust/export.h"

#include <algorithm>
#include <array>
#include <optional>

#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/optics/gltf_profile.h"

namespace dermis {
namespace {

// `channels` channels of 255 with the grey map in one of them: glTF keeps roughness in G, the specular factor
// in A.
Image in_channel(const Image& grey, int channels, int channel, uint8_t rest) {
    Image image(grey.width, grey.height, channels, PixelFormat::u8);
    const auto from = grey.values<uint8_t>();
    const auto to = image.values<uint8_t>();
    for (size_t i = 0; i < from.size(); ++i)
        for (int c = 0; c < channels; ++c)
            to[i * size_t(channels) + size_t(c)] = c == channel ? from[i] : rest;
    return image;
}

// Of the map's colours on the mesh, by area.
Rgb mean_albedo(const Bust& bust) {
    const Mesh& mesh = bust.mesh;
    const Image& map = bust.albedo;
    Rgb sum = {};
    double area_mm2 = 0;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const Vec3 ab = mesh.positions_mm[b] - mesh.positions_mm[a],
                   ac = mesh.positions_mm[c] - mesh.positions_mm[a];
        const double weight = length(cross(ab, ac)) / 2;
        const Vec2 uv = (mesh.uvs[a] + mesh.uvs[b] + mesh.uvs[c]) * (1.0f / 3);
        const int x = std::clamp(int(uv.x * float(map.width)), 0, map.width - 1);
        const int y = std::clamp(int(uv.y * float(map.height)), 0, map.height - 1);
        for (int k = 0; k < 3; ++k) sum[size_t(k)] += weight * double(srgb_decode(map.at(x, y, k)));
        area_mm2 += weight;
    }
    for (double& channel : sum) channel /= area_mm2;
    return sum;
}

// Light enters the body where it would be reflected diffusely, and leaves it after scattering. The thickness
// is that of a head: what draws by it alone lets no light through.
Material::Scattering body_of(const Profile& profile, const Bust& bust) {
    constexpr float kHeadWidth_mm = 155;
    const GltfVolume volume = gltf_volume(profile, mean_albedo(bust));
    const auto color = [](const Rgb& c) { return Vec3{float(c[0]), float(c[1]), float(c[2])}; };
    return {.thickness_mm = kHeadWidth_mm,
            .attenuation_color = color(volume.attenuation_color),
            .attenuation_distance_mm = float(volume.attenuation_distance_m * 1000),
            .multiscatter_color = color(volume.multiscatter_color),
            .diffuse_transmission = 1};
}

Result<Mesh> with_embedded_maps(const Bust& bust) {
    Mesh mesh = bust.mesh;
    Material& skin = mesh.materials[0];
    struct Slot {
        ImageSource Material::*map;
        const char* name;
        Image image;
    };
    std::array slots = {
        Slot{&Material::base_color_map, "albedo", bust.albedo},
        Slot{&Material::normal_map, "normal", bust.normal},
        Slot{&Material::metallic_roughness_map, "roughness", in_channel(bust.roughness, 3, 1, 0)},
        Slot{&Material::specular_map, "specular", in_channel(bust.specular, 4, 3, 255)}};
    std::array<std::optional<Error>, slots.size()> errors;
    parallel_for(slots.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Result<std::vector<std::byte>> png = encode_image(".png", slots[i].image);
            if (!png)
                errors[i] = png.error();
            else
                skin.*slots[i].map = {.name = slots[i].name, .encoded = std::move(*png)};
        }
    });
    for (const std::optional<Error>& error : errors)
        if (error) return *error;
    return mesh;
}

}  // namespace

Result<void> write_bust(const std::filesystem::path& path, const Bust& bust, const Profile& profile) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".obj") return write_obj(path, bust.mesh);
    if (extension != ".glb") return Error{path.string() + ": the bust is written as .glb or .obj"};
    Result<Mesh> mesh = with_embedded_maps(bust);
    if (mesh) mesh->materials[0].scattering = body_of(profile, bust);
    const std::string extras[] = {gltf_extras(profile)};
    return mesh ? write_glb(path, *mesh, {}, extras) : mesh.error();
}

Result<void> write_bust_maps(const std::filesystem::path& folder, const Bust& bust) {
    const std::pair<const char*, const Image*> maps[] = {{"albedo.png", &bust.albedo},
                                                         {"normal.png", &bust.normal},
                                                         {"roughness.png", &bust.roughness},
                                                         {"specular.png", &bust.specular},
                                                         {"kernel_size.png", &bust.kernel_size}};
    for (const auto& [name, image] : maps)
        if (Result<void> written = write_image(folder / name, *image); !written) return written;
    return {};
}

}  // namespace dermis
