#pragma once
// A small glTF that moves: a part of a sphere with a target and a clip, as text with its buffer inside.

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "mesh/mesh_files.h"

namespace dermis::test {

/// A square of 13 x 13 vertices, 200 mm wide, bulging 40 mm towards +Z, of the material "skin". Target "lift"
/// raises its middle by 30 mm; the clip "nod" (2 s) takes lift from 0 to 1 and turns the node by 90 degrees
/// about the view axis.
inline std::string moving_sheet() {
    constexpr int kSide = 13, kVertices = kSide * kSide;
    std::vector<float> positions, lifts, uvs;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float u = float(x) / (kSide - 1), v = float(y) / (kSide - 1);
            const float r2 = 4 * ((u - 0.5f) * (u - 0.5f) + (v - 0.5f) * (v - 0.5f));
            positions.insert(positions.end(), {0.2f * (u - 0.5f), 0.2f * (0.5f - v), 0.04f * (1 - r2 / 2)});
            lifts.insert(lifts.end(), {0, 0, 0.03f * std::exp(-6 * r2)});
            uvs.insert(uvs.end(), {u, v});
        }
    std::string bytes, views, accessors;
    int count = 0;
    const auto add = [&](const auto& values, const std::string& type, int component, size_t elements) {
        const size_t size = values.size() * sizeof(values[0]), at = bytes.size();
        bytes.resize(at + size);
        std::memcpy(bytes.data() + at, values.data(), size);
        const std::string comma = count > 0 ? "," : "";
        views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(at) + R"(,"byteLength":)" +
                 std::to_string(size) + "}";
        accessors += comma + R"({"bufferView":)" + std::to_string(count) + R"(,"componentType":)" +
                     std::to_string(component) + R"(,"type":")" + type + R"(","count":)" +
                     std::to_string(elements) + "}";
        return count++;
    };
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y + 1 < kSide; ++y)
        for (uint32_t x = 0; x + 1 < kSide; ++x) {
            const uint32_t a = y * kSide + x, b = a + kSide;
            indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    constexpr int kFloat = 5126, kUint = 5125;
    add(positions, "VEC3", kFloat, kVertices);
    add(lifts, "VEC3", kFloat, kVertices);
    add(uvs, "VEC2", kFloat, kVertices);
    add(indices, "SCALAR", kUint, indices.size());
    add(std::vector<float>{0, 2}, "SCALAR", kFloat, 2);
    add(std::vector<float>{0, 1}, "SCALAR", kFloat, 2);
    const float half = std::sqrt(0.5f);
    add(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, "VEC4", kFloat, 2);
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"materials":[{"name":"skin"}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":3,)"
           R"("material":0,"targets":[{"POSITION":1}]}],"extras":{"targetNames":["lift"]}}],)"
           R"("animations":[{"name":"nod","channels":[)"
           R"({"sampler":0,"target":{"node":0,"path":"weights"}},)"
           R"({"sampler":1,"target":{"node":0,"path":"rotation"}}],)"
           R"("samplers":[{"input":4,"output":5},{"input":4,"output":6}]}],)"
           R"("accessors":[)" +
           accessors + R"(],"bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" +
           std::to_string(bytes.size()) + R"(,"uri":")" + data_uri(bytes) + "\"}]}";
}

}  // namespace dermis::test
