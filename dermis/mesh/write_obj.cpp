#include <fmt/format.h>

#include <iterator>

#include "dermis/base/file.h"
#include "dermis/mesh/write_mesh.h"

namespace dermis::inline mesh {
namespace {

std::string one_word(std::string name) {
    for (char& c : name)
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') c = '_';
    return name.empty() ? "default" : name;
}

std::string mtl_text(const std::vector<Material>& materials) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const Material& m : materials) {
        const Vec3 c = m.base_color_linear, e = m.emission_linear;
        fmt::format_to(out, "newmtl {}\nKd {} {} {}\nKe {} {} {}\nPr {}\nPm {}\nNi {}\nd {}\n",
                       one_word(m.name), c.x, c.y, c.z, e.x, e.y, e.z, m.roughness, m.metallic, m.ior,
                       m.opacity);
        const auto map = [&](const char* key, const ImageSource& image) {
            // Embedded images have no path to name.
            if (image.encoded.empty() && !image.name.empty()) fmt::format_to(out, "{} {}\n", key, image.name);
        };
        map("map_Kd", m.base_color_map);
        map("norm", m.normal_map);
        map("map_Ks", m.specular_map);
        map("disp", m.displacement_map);
    }
    return text;
}

std::string obj_text(const Mesh& mesh, const std::string& library) {
    std::string text = "# millimetres, Y up\nmtllib " + library + "\n";
    const auto out = std::back_inserter(text);
    for (const Vec3& p : mesh.positions_mm) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec2& uv : mesh.uvs) fmt::format_to(out, "vt {} {}\n", uv.x, 1 - uv.y);
    for (const Vec3& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n.x, n.y, n.z);
    for (const Submesh& submesh : mesh.submeshes) {
        fmt::format_to(out, "usemtl {}\n", one_word(mesh.materials[submesh.material].name));
        for (uint32_t i = 0; i < submesh.index_count; i += 3) {
            text += 'f';
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t n = mesh.indices[submesh.first_index + i + k] + 1;
                fmt::format_to(out, " {}", n);
                if (!mesh.uvs.empty() || !mesh.normals.empty()) text += '/';
                if (!mesh.uvs.empty()) fmt::format_to(out, "{}", n);
                if (!mesh.normals.empty()) fmt::format_to(out, "/{}", n);
            }
            text += '\n';
        }
    }
    return text;
}

}  // namespace

std::filesystem::path mtl_path(const std::filesystem::path& obj_path) {
    return std::filesystem::path(obj_path).replace_extension(".mtl");
}

ObjTexts obj_texts(const std::filesystem::path& path, const Mesh& mesh) {
    return {.mtl = mtl_text(mesh.materials), .obj = obj_text(mesh, mtl_path(path).filename().string())};
}

Result<void> write_obj(const std::filesystem::path& path, const Mesh& mesh) {
    const ObjTexts texts = obj_texts(path, mesh);
    const FileContent files[] = {{mtl_path(path), as_bytes(texts.mtl)}, {path, as_bytes(texts.obj)}};
    return write_files(files);
}

}  // namespace dermis::inline mesh
