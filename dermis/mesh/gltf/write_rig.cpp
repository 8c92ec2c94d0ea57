// What moves a mesh into a GLB: each part of the rig as a mesh of its own, so that nodes, weights and clips
// stay as the source has them.

#include <algorithm>
#include <string>

#include "dermis/mesh/gltf/glb_content.h"

namespace dermis::inline mesh::gltf {
namespace {

OrderedJson node_json(const RigNode& node) {
    OrderedJson json = OrderedJson::object();
    if (!node.name.empty()) json["name"] = node.name;
    if (node.matrix) {
        json["matrix"] = *node.matrix;
    } else {
        if (node.translation != std::array<double, 3>{}) json["translation"] = node.translation;
        if (node.rotation != std::array<double, 4>{0, 0, 0, 1}) json["rotation"] = node.rotation;
        if (node.scale != std::array<double, 3>{1, 1, 1}) json["scale"] = node.scale;
    }
    if (!node.children.empty()) json["children"] = node.children;
    return json;
}

// The values of the part's vertices alone.
std::vector<std::vector<Vec2>> numbers_of(const RigPart& part, std::span<const std::vector<Vec2>> more_uvs) {
    std::vector<std::vector<Vec2>> numbers(more_uvs.size());
    for (size_t i = 0; i < more_uvs.size(); ++i)
        for (const uint32_t v : part.vertices) numbers[i].push_back(more_uvs[i][v]);
    return numbers;
}

// One set of four: JOINTS_n, WEIGHTS_n.
template <class T>
std::vector<T> set_of(const std::vector<T>& values, size_t influences, size_t set) {
    std::vector<T> four;
    for (size_t first = 4 * set; first < values.size(); first += influences)
        four.insert(four.end(), values.begin() + std::ptrdiff_t(first),
                    values.begin() + std::ptrdiff_t(first + 4));
    return four;
}

void add_influences(GlbContent& glb, const RigPart& part, OrderedJson& attributes) {
    const size_t count = part.vertices.size();
    for (size_t set = 0; 4 * set < part.influences; ++set) {
        const std::vector<uint16_t> joints = set_of(part.joints, part.influences, set);
        const std::vector<float> weights = set_of(part.weights, part.influences, set);
        attributes["JOINTS_" + std::to_string(set)] =
            glb.add_accessor(std::as_bytes(std::span(joints)), count, kU16, "VEC4", kArrayBuffer);
        attributes["WEIGHTS_" + std::to_string(set)] =
            glb.add_accessor(std::as_bytes(std::span(weights)), count, kF32, "VEC4", kArrayBuffer);
    }
}

void add_part(GlbContent& glb, const RigPart& part, std::span<const std::vector<Vec2>> more_uvs) {
    OrderedJson attributes = add_attributes(glb, part.mesh, numbers_of(part, more_uvs));
    add_influences(glb, part, attributes);
    OrderedJson targets = OrderedJson::array(), names = OrderedJson::array();
    for (const RigTarget& target : part.targets) {
        std::vector<Vec3> moves;
        for (const Vec3& move_mm : target.moves_mm) moves.push_back(move_mm * 0.001f);
        const size_t positions = glb.add_changes(moves, true), normals = glb.add_changes(target.turns, false);
        targets.push_back({{"POSITION", positions}, {"NORMAL", normals}});
        names.push_back(target.name);
    }
    add_mesh(glb, part.mesh, attributes, targets);
    OrderedJson& mesh = glb.root["meshes"].back();
    if (!part.targets.empty()) {
        mesh["weights"] = part.target_weights;
        mesh["extras"]["targetNames"] = names;
    }
    OrderedJson& node = glb.root["nodes"][part.node];
    node["mesh"] = glb.root["meshes"].size() - 1;
    if (part.skin) node["skin"] = *part.skin;
}

void add_skin(GlbContent& glb, const RigSkin& skin) {
    const size_t binds = glb.add_accessor(std::as_bytes(std::span(skin.inverse_binds)),
                                          skin.inverse_binds.size(), kF32, "MAT4", std::nullopt);
    glb.root["skins"].push_back({{"inverseBindMatrices", binds}, {"joints", skin.joints}});
}

size_t add_sampler(GlbContent& glb, const RigChannel& channel, OrderedJson& samplers) {
    const Keys& keys = channel.keys;
    const size_t input = glb.add_accessor(std::as_bytes(std::span(keys.times_s)), keys.times_s.size(), kF32,
                                          "SCALAR", std::nullopt);
    glb.root["accessors"].back()["min"] = {keys.times_s.front()};
    glb.root["accessors"].back()["max"] = {keys.times_s.back()};
    const bool weights = channel.path == "weights";
    const size_t width = weights ? 1 : keys.width;
    const size_t output =
        glb.add_accessor(std::as_bytes(std::span(keys.values)), keys.values.size() / width, kF32,
                         weights      ? "SCALAR"
                         : width == 4 ? "VEC4"
                                      : "VEC3",
                         std::nullopt);
    samplers.push_back({{"input", input},
                        {"interpolation", keys.interpolation == Interpolation::step     ? "STEP"
                                          : keys.interpolation == Interpolation::linear ? "LINEAR"
                                                                                        : "CUBICSPLINE"},
                        {"output", output}});
    return samplers.size() - 1;
}

void add_clip(GlbContent& glb, const RigClip& clip) {
    OrderedJson samplers = OrderedJson::array(), channels = OrderedJson::array();
    for (const RigChannel& channel : clip.channels) {
        const size_t sampler = add_sampler(glb, channel, samplers);
        channels.push_back(
            {{"sampler", sampler}, {"target", {{"node", channel.node}, {"path", channel.path}}}});
    }
    glb.root["animations"].push_back({{"name", clip.name}, {"channels", channels}, {"samplers", samplers}});
}

}  // namespace

void add_rig(GlbContent& glb, const Rig& rig, std::span<const std::vector<Vec2>> more_uvs) {
    glb.root["nodes"] = OrderedJson::array();
    for (const RigNode& node : rig.nodes) glb.root["nodes"].push_back(node_json(node));
    for (const RigPart& part : rig.parts) add_part(glb, part, more_uvs);
    for (const RigSkin& skin : rig.skins) add_skin(glb, skin);
    for (const RigClip& clip : rig.clips) add_clip(glb, clip);
}

}  // namespace dermis::inline mesh::gltf
