#include "dermis/rays/diffused_normals_file.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/image.h"
#include "dermis/image/io.h"

namespace dermis::inline rays {
namespace {

std::string sidecar_text(const DiffusedNormals& normals, const DiffusedNormalsOrigin& origin, bool green,
                         bool png) {
    const Vec3 own = own_normal_weights(origin.profile, origin.request);
    nlohmann::ordered_json weights;
    if (green)
        weights = {{"green", own.y}, {"blue", own.z}};
    else
        weights = {{"red", own.x}};
    const nlohmann::ordered_json json = {
        {"kind", "normals"},
        {"channel", green ? "green" : "red"},
        {"meaning",
         "mean of the normals around the texel, weighted by the profile without its Gaussians "
         "below finest_variance_mm2; shorter than 1 where they differ"},
        {"use",
         "own_normal_weight * shaded normal + (1 - own_normal_weight) * map: the mean normal of a channel"},
        {"own_normal_weight", weights},
        {"alpha", green ? "q" : "p"},
        {"unit", "1"},
        {"axes", "of the scene: x right, y up, z to the front"},
        {"encoding", png ? "x * 0.5 + 0.5" : "linear"},
        {"width", normals.size},
        {"height", normals.size},
        {"channels", 4},
        {"v_origin", "top"},
        {"gutter_texels", kDiffusedNormalsGutter},
        {"profile", origin.profile_name},
        {"finest_variance_mm2", origin.request.finest_variance_mm2},
        {"mesh", origin.mesh},
        {"uvs", origin.uv_file.empty() ? "of the mesh" : "TEXCOORD_1 of " + origin.uv_file},
        {"tool", "dermis " DERMIS_VERSION}};
    return json.dump(2) + "\n";
}

Image picture(const DiffusedNormals& normals, bool green, bool png) {
    const auto& texels = green ? normals.green : normals.red;
    Image image(normals.size, normals.size, 4, png ? PixelFormat::u16 : PixelFormat::f32);
    if (png) {
        std::memcpy(image.bytes.data(), texels.data(), image.bytes.size());
        return image;
    }
    for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 4; ++c) image.floats()[4 * i + c] = 2 * float(texels[i][c]) / 65535 - 1;
    return image;
}

}  // namespace

std::array<std::filesystem::path, 2> diffused_normals_paths(const std::filesystem::path& path) {
    const std::string stem = path.stem().string(), extension = path.extension().string();
    return {path.parent_path() / (stem + "_red" + extension),
            path.parent_path() / (stem + "_green" + extension)};
}

Result<void> check_diffused_normals_path(const std::filesystem::path& path) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".exr" || extension == ".png") return {};
    return Error{path.string() + ": baked normals are written as .exr or .png"};
}

Result<void> write_diffused_normals(const std::filesystem::path& path, const DiffusedNormals& normals,
                                    const DiffusedNormalsOrigin& origin) {
    if (Result<void> good = check_diffused_normals_path(path); !good) return good;
    const std::string extension = to_lower(path.extension().string());
    const bool png = extension == ".png";
    const auto paths = diffused_normals_paths(path);
    std::array<std::string, 2> texts;
    std::array<std::vector<std::byte>, 2> pictures;
    std::vector<FileContent> files;
    for (size_t i = 0; i < 2; ++i) {
        texts[i] = sidecar_text(normals, origin, i == 1, png);
        Result<std::vector<std::byte>> encoded =
            encode_image(extension, picture(normals, i == 1, png), {{"dermis", texts[i]}});
        if (!encoded) return Error{paths[i].string() + ": " + encoded.error().message};
        pictures[i] = std::move(*encoded);
        files.push_back({paths[i], pictures[i]});
        files.push_back({paths[i].string() + ".json", as_bytes(texts[i])});
    }
    return write_files(files);
}

}  // namespace dermis::inline rays
