#include "subjects/bust/export.h"

#include <algorithm>
#include <array>
#include <optional>

#include "dermis/base/file.h"
#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/optics/gltf_profile.h"
#include "dermis/optics/tissue/pigment_maps.h"

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

// Mean of the map's colours on the mesh, weighted by area.
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
    return {.thickness_mm = kHeadWidth_mm,
            .attenuation_color = to_vec3(volume.attenuation_color),
            .attenuation_distance_mm = float(volume.attenuation_distance_m * 1000),
            .multiscatter_color = to_vec3(volume.multiscatter_color),
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

struct MadeFile {
    std::filesystem::path path;
    std::vector<std::byte> bytes;
};

MadeFile text_file(const std::filesystem::path& path, std::string_view text) {
    const auto bytes = as_bytes(text);
    return {path, {bytes.begin(), bytes.end()}};
}

Result<std::vector<MadeFile>> mesh_files(const std::filesystem::path& path, const Bust& bust,
                                         const Profile& profile) {
    if (to_lower(path.extension().string()) == ".obj") {
        const ObjTexts texts = obj_texts(path, bust.mesh);
        return std::vector{text_file(mtl_path(path), texts.mtl), text_file(path, texts.obj)};
    }
    DERMIS_TRY_ASSIGN(Mesh mesh, with_embedded_maps(bust));
    mesh.materials[0].scattering = body_of(profile, bust);
    const std::string extras[] = {gltf_extras(profile)};
    Result<std::vector<std::byte>> bytes = glb_bytes(mesh, {}, extras);
    if (!bytes) return bytes.error().within(path.string());
    return std::vector{MadeFile{path, std::move(*bytes)}};
}

Result<void> add_maps(std::vector<MadeFile>& files, const std::filesystem::path& folder, const Bust& bust) {
    PigmentMaps pigments{.melanin = bust.melanin, .blood = bust.blood, .residue = {}};
    add_residue(pigments, bust.albedo, PigmentTable(SkinModel{}));
    const Image* const images[] = {&bust.albedo,      &bust.normal,  &bust.roughness, &bust.specular,
                                   &bust.kernel_size, &bust.melanin, &bust.blood,     &pigments.residue};
    static_assert(std::size(images) == std::size(kBustMaps));
    for (size_t i = 0; i < std::size(kBustMaps); ++i) {
        Result<std::vector<std::byte>> png = encode_image(".png", *images[i]);
        if (!png) return png.error().within((folder / kBustMaps[i]).string());
        files.push_back({folder / kBustMaps[i], std::move(*png)});
    }
    return {};
}

}  // namespace

Result<void> check_bust_path(const std::filesystem::path& path) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".obj" || extension == ".glb") return {};
    return Error{path.string() + ": the bust is written as .glb or .obj"};
}

Result<void> write_bust(const std::filesystem::path& path, const Bust& bust, const Profile& profile,
                        const std::filesystem::path& maps_folder) {
    if (Result<void> good = check_bust_path(path); !good) return good;
    DERMIS_TRY_ASSIGN(std::vector<MadeFile> files, mesh_files(path, bust, profile));
    if (!maps_folder.empty())
        if (Result<void> added = add_maps(files, maps_folder, bust); !added) return added;
    std::vector<FileContent> contents;
    for (const MadeFile& file : files) contents.push_back({file.path, file.bytes});
    return write_files(contents);
}

}  // namespace dermis
