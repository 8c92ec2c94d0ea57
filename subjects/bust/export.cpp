#include "subjects/bust/export.h"

#include <array>
#include <optional>

#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/mesh/write_mesh.h"

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

Result<void> write_bust(const std::filesystem::path& path, const Bust& bust) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".obj") return write_obj(path, bust.mesh);
    if (extension != ".glb") return Error{path.string() + ": the bust is written as .glb or .obj"};
    const Result<Mesh> mesh = with_embedded_maps(bust);
    return mesh ? write_glb(path, *mesh) : mesh.error();
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
