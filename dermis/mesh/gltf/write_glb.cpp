// A mesh as one GLB: the attributes once, an index accessor a submesh, images in the same buffer.

#include <algorithm>
#include <cmath>
#include <optional>

#include "dermis/base/file.h"
#include "dermis/mesh/gltf/write_material.h"
#include "dermis/mesh/write_mesh.h"

namespace dermis::inline mesh {
namespace {

using gltf::array_of;
using gltf::GlbContent;
using gltf::Json;

enum : int { kU32 = 5125, kF32 = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };

size_t add_accessor(GlbContent& glb, std::span<const std::byte> bytes, size_t count, int component,
                    const char* type, int target) {
    // Not within the next expression: an ordered object moves its members when one is added.
    const size_t view = glb.add_view(bytes, target);
    glb.root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return glb.root["accessors"].size() - 1;
}

template <class T>
size_t add_attribute(GlbContent& glb, const std::vector<T>& values, const char* type) {
    return add_accessor(glb, std::as_bytes(std::span(values)), values.size(), kF32, type, kArrayBuffer);
}

size_t add_positions(GlbContent& glb, const Mesh& mesh) {
    std::vector<Vec3> positions_m;
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = -low;
    for (const Vec3& p_mm : mesh.positions_mm) {
        const Vec3 p = p_mm * 0.001f;
        positions_m.push_back(p);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const size_t accessor = add_attribute(glb, positions_m, "VEC3");
    glb.root["accessors"].back()["min"] = array_of(low);
    glb.root["accessors"].back()["max"] = array_of(high);
    return accessor;
}

void add_geometry(GlbContent& glb, const Mesh& mesh) {
    Json attributes;
    attributes["POSITION"] = add_positions(glb, mesh);
    if (!mesh.normals.empty()) attributes["NORMAL"] = add_attribute(glb, mesh.normals, "VEC3");
    if (!mesh.tangents.empty()) attributes["TANGENT"] = add_attribute(glb, mesh.tangents, "VEC4");
    if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = add_attribute(glb, mesh.uvs, "VEC2");
    Json primitives = Json::array();
    for (const Submesh& submesh : mesh.submeshes) {
        if (submesh.index_count == 0) continue;
        const auto bytes =
            std::as_bytes(std::span(mesh.indices).subspan(submesh.first_index, submesh.index_count));
        const size_t indices =
            add_accessor(glb, bytes, submesh.index_count, kU32, "SCALAR", kElementArrayBuffer);
        primitives.push_back(
            {{"attributes", attributes}, {"indices", indices}, {"material", submesh.material}});
    }
    glb.root["meshes"] = Json::array({{{"primitives", primitives}}});
    if (!mesh.submeshes.empty() && !mesh.submeshes.front().name.empty())
        glb.root["meshes"][0]["name"] = mesh.submeshes.front().name;
}

Result<std::vector<std::byte>> assemble(const GlbContent& glb) {
    std::string json;
    try {
        json = glb.root.dump();
    } catch (const nlohmann::json::exception&) {
        return Error{"a name is not valid UTF-8"};
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const uint64_t total = 12 + 8 + json.size() + 8 + glb.binary.size();
    if (total > UINT32_MAX) return Error{"larger than 4 GiB, the most a GLB can hold"};
    std::vector<std::byte> file;
    file.reserve(total);
    const auto put_u32 = [&](uint64_t value) {
        for (int shift = 0; shift < 32; shift += 8) file.push_back(std::byte(value >> shift & 255));
    };
    for (const uint64_t word :
         {uint64_t{0x46546C67}, uint64_t{2}, total, uint64_t{json.size()}, uint64_t{0x4E4F534A}})
        put_u32(word);
    const auto text = as_bytes(json);
    file.insert(file.end(), text.begin(), text.end());
    put_u32(glb.binary.size()), put_u32(0x004E4942);
    file.insert(file.end(), glb.binary.begin(), glb.binary.end());
    return file;
}

}  // namespace

size_t gltf::GlbContent::add_view(std::span<const std::byte> bytes, std::optional<int> target) {
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    binary.resize((binary.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(view);
    return root["bufferViews"].size() - 1;
}

Result<std::vector<std::byte>> glb_bytes(const Mesh& mesh, std::span<const NamedImage> images,
                                         std::span<const std::string> extras) {
    if (mesh.indices.empty()) return Error{"a mesh without triangles is not written"};
    GlbContent glb;
    glb.root = {{"asset", {{"version", "2.0"}, {"generator", "dermis"}}},
                {"scene", 0},
                {"scenes", Json::array({{{"nodes", {0}}}})},
                {"nodes", Json::array({{{"mesh", 0}}})}};
    DERMIS_TRY(gltf::add_materials(glb, mesh.materials, images));
    for (size_t i = 0; i < std::min(extras.size(), mesh.materials.size()); ++i) {
        if (extras[i].empty()) continue;
        glb.root["materials"][i]["extras"] = Json::parse(extras[i], nullptr, false);
        if (glb.root["materials"][i]["extras"].is_discarded())
            return Error{"the extras of material " + std::to_string(i) + " are no JSON"};
    }
    add_geometry(glb, mesh);
    glb.root["buffers"] = Json::array({{{"byteLength", glb.binary.size()}}});
    return assemble(glb);
}

Result<void> write_glb(const std::filesystem::path& path, const Mesh& mesh,
                       std::span<const NamedImage> images, std::span<const std::string> extras) {
    const Result<std::vector<std::byte>> bytes = glb_bytes(mesh, images, extras);
    return bytes ? write_file(path, *bytes) : bytes.error().within(path.string());
}

}  // namespace dermis::inline mesh
