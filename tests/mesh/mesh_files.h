#pragma once
// Small mesh files in memory, and the checks every loaded mesh must pass.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dermis/mesh/read_mesh.h"
#include "test_paths.h"

namespace dermis::test {

inline std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

inline double area_mm2(const Mesh& mesh) {
    double sum = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](size_t k) { return mesh.positions_mm[mesh.indices[i + k]]; };
        sum += length(cross(p(1) - p(0), p(2) - p(0))) / 2;
    }
    return sum;
}

/// The files beside a mesh, by relative path.
inline ReadSibling siblings(std::map<std::string, std::string> files) {
    return [files = std::move(files)](const std::string& path) -> Result<std::vector<std::byte>> {
        const auto found = files.find(path);
        if (found == files.end()) return Error{path + ": cannot open"};
        const auto bytes = bytes_of(found->second);
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
}

inline Result<LoadedMesh> parse_obj_text(const std::string& text,
                                         std::map<std::string, std::string> files = {},
                                         const MeshOptions& options = {}) {
    return parse_mesh(bytes_of(text), MeshFormat::obj, "dir/test.obj", siblings(std::move(files)), options);
}

inline Result<LoadedMesh> parse_gltf_text(const std::string& text,
                                          std::map<std::string, std::string> files = {},
                                          const MeshOptions& options = {}) {
    return parse_mesh(bytes_of(text), MeshFormat::gltf, "dir/test.gltf", siblings(std::move(files)), options);
}

inline bool any_contains(const std::vector<std::string>& lines, const std::string& part) {
    for (const std::string& line : lines)
        if (line.find(part) != std::string::npos) return true;
    return false;
}

/// What read_mesh.h states of every result.
inline void expect_sound(const Mesh& mesh) {
    const size_t count = mesh.positions_mm.size();
    ASSERT_EQ(mesh.normals.size(), count);
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == count);
    ASSERT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == count);
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    for (const uint32_t index : mesh.indices) ASSERT_LT(index, count);
    for (const Vec3& p : mesh.positions_mm) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const Vec3& n : mesh.normals) ASSERT_NEAR(length(n), 1, 1e-4);
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        const Vec4 t = mesh.tangents[i];
        ASSERT_NEAR(length(Vec3{t.x, t.y, t.z}), 1, 1e-4);
        ASSERT_NEAR(dot(Vec3{t.x, t.y, t.z}, mesh.normals[i]), 0, 1e-3);
        ASSERT_EQ(std::abs(t.w), 1);
    }
    uint32_t next = 0;
    for (const Submesh& submesh : mesh.submeshes) {
        ASSERT_EQ(submesh.first_index, next);
        ASSERT_LT(submesh.material, mesh.materials.size());
        next += submesh.index_count;
    }
    ASSERT_EQ(next, mesh.indices.size());
}

/// A cube of side 2 around the origin: six quads, one material, UVs and normals if wanted.
inline const std::string kCubeObj =
    "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\nf 6/1 5/2 8/3 7/4\nf 2/1 6/2 7/3 3/4\nf 5/1 1/2 4/3 8/4\nf 4/1 3/2 7/3 8/4\n"
    "f 5/1 6/2 2/3 1/4\n";

/// Little-endian binary for buffers.
class Binary {
  public:
    template <class T>
    Binary& add(std::initializer_list<T> values) {
        for (const T value : values) {
            char raw[sizeof(T)];
            std::memcpy(raw, &value, sizeof value);
            bytes_.append(raw, sizeof value);
        }
        return *this;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

inline std::string base64(const std::string& bytes) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](size_t k) { return i + k < bytes.size() ? uint32_t(uint8_t(bytes[i + k])) : 0u; };
        const uint32_t bits = at(0) << 16 | at(1) << 8 | at(2);
        for (size_t k = 0; k < 4; ++k)
            text += i + k < bytes.size() + 1 ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string data_uri(const std::string& bytes) {
    return "data:application/octet-stream;base64," + base64(bytes);
}

/// JSON and binary as a GLB.
inline std::string glb(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    const auto chunk = [](uint32_t type, const std::string& content) {
        return Binary().add<uint32_t>({uint32_t(content.size()), type}).bytes() + content;
    };
    const std::string body = chunk(0x4E4F534A, json) + (binary.empty() ? "" : chunk(0x004E4942, binary));
    return Binary().add<uint32_t>({0x46546C67, 2, uint32_t(12 + body.size())}).bytes() + body;
}

/// Four corners of a unit square, u16 indices: 48 bytes of positions, 12 of indices.
inline const std::string kSquareBinary =
    Binary().add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<uint16_t>({0, 1, 2, 0, 2, 3}).bytes();

/// The square as glTF; `extra` goes into the root object, `node` is the node's content after "mesh":0.
inline std::string square_gltf(const std::string& node = "", const std::string& extra = "",
                               const std::string& primitive_extra = "", const std::string& uri = "") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
           R"(}],"meshes":[{"name":"square","primitives":[{"attributes":{"POSITION":0},"indices":1)" +
           primitive_extra +
           R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
           R"("buffers":[{"byteLength":60,"uri":")" +
           (uri.empty() ? data_uri(kSquareBinary) : uri) + "\"}]" + extra + "}";
}

inline std::filesystem::path asset(const std::string& name) {
    const char* directory = std::getenv("DERMIS_ASSETS");
    return std::filesystem::path(directory ? directory : DERMIS_SOURCE_DIR "/../shared/assets") / name;
}

}  // namespace dermis::test
