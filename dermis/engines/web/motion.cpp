// What moves an object of the page, in the words of glTF, as engines/common/SkinHeadMotion.js reads it:
// nodes, meshes, skins and animations. In place of an accessor's number there is where its values are in
// motion.bin, and by which factor whole numbers are the values:
//
//     position, normal  3 x s16, 3 x s8, without morph
//     tangent           4 x s8
//     influences        4 x u16 joints and 4 x u16 weights a set
//     morph target      vertices that it moves as u16 (u32), changes of their positions 3 x s16 and of their
//                       normals 3 x s8; CURVATURE, the change of the mean curvature, s8 in steps
//                       (target_curvature.h), of a target that changes it
//
// A mesh has "vertices", the vertices of the page that its own are. Targets that no clip uses are left out.

#include <algorithm>
#include <cmath>
#include <limits>

#include "dermis/engines/web/parts.h"

namespace dermis::inline engines::web {
namespace {

using nlohmann::json;

// Of a target's largest move, below which a vertex is left out; and the same of the change of a unit normal.
constexpr float kLeastMove = 1.0f / 1024, kLeastTurn = 0.01f;

constexpr const char* type_name(float) {
    return "f32";
}
constexpr const char* type_name(int16_t) {
    return "s16";
}
constexpr const char* type_name(int8_t) {
    return "s8";
}
constexpr const char* type_name(uint16_t) {
    return "u16";
}
constexpr const char* type_name(uint32_t) {
    return "u32";
}

template <class T>
json add_numbers(Binary& binary, const std::vector<T>& numbers) {
    json made = {{"offset", binary.begin_block()}, {"count", numbers.size()}, {"type", type_name(T())}};
    for (const T number : numbers) binary.put(number);
    return made;
}

template <class T>
json add_scaled(Binary& binary, const std::vector<float>& numbers) {
    float most = 1e-9f;
    for (const float number : numbers) most = std::max(most, std::abs(number));
    const float scale = most / float(std::numeric_limits<T>::max());
    std::vector<T> whole;
    for (const float number : numbers) whole.push_back(T(std::lround(number / scale)));
    json made = add_numbers(binary, whole);
    made["scale"] = to_json(scale);
    return made;
}

void append(std::vector<float>& numbers, Vec3 v, float scale = 1) {
    numbers.insert(numbers.end(), {v.x * scale, v.y * scale, v.z * scale});
}

template <class Number>
json add_vertices(Binary& binary, const std::vector<uint32_t>& vertices) {
    return add_numbers(binary, std::vector<Number>(vertices.begin(), vertices.end()));
}
json add_vertices(Binary& binary, const std::vector<uint32_t>& vertices) {
    const bool wide = !vertices.empty() && std::ranges::max(vertices) > 65535;
    return wide ? add_vertices<uint32_t>(binary, vertices) : add_vertices<uint16_t>(binary, vertices);
}

// Vertices of a part that the page has.
struct PartOnPage {
    const RigPart& part;
    std::vector<uint32_t> own, page;  // numbers in the part and on the page
};

PartOnPage part_on_page(const RigPart& part, std::span<const uint32_t> number_on_page) {
    PartOnPage found{part, {}, {}};
    for (uint32_t i = 0; i < part.vertices.size(); ++i)
        if (const uint32_t on_page = number_on_page[part.vertices[i]]; on_page != kNotOnPage)
            found.own.push_back(i), found.page.push_back(on_page);
    return found;
}

// Weights of a set whose sum stays 1.
std::vector<uint16_t> whole_weights(const PartOnPage& on_page) {
    const size_t influences = on_page.part.influences;
    std::vector<uint16_t> all;
    for (const uint32_t v : on_page.own) {
        const auto weights = std::span(on_page.part.weights).subspan(v * influences, influences);
        const size_t first = all.size();
        float sum = 0;
        for (const float weight : weights) sum += weight;
        int rest = 65535;
        for (const float weight : weights) {
            all.push_back(uint16_t(std::lround(weight / sum * 65535)));
            rest -= all.back();
        }
        all[first] = uint16_t(all[first] + rest);  // the strongest
    }
    return all;
}

template <class T>
std::vector<T> set_of(const std::vector<T>& values, size_t influences, size_t set) {
    std::vector<T> four;
    for (size_t v = 0; v * influences < values.size(); ++v)
        for (size_t i = 4 * set; i < 4 * set + 4; ++i) four.push_back(values[v * influences + i]);
    return four;
}

void add_influences(Binary& binary, const PartOnPage& on_page, json& attributes) {
    const size_t influences = on_page.part.influences;
    if (influences == 0) return;
    const std::vector<uint16_t> weights = whole_weights(on_page);
    std::vector<uint16_t> joints;
    for (const uint32_t v : on_page.own)
        for (size_t i = 0; i < influences; ++i) joints.push_back(on_page.part.joints[v * influences + i]);
    for (size_t set = 0; 4 * set < influences; ++set) {
        attributes["JOINTS_" + std::to_string(set)] = add_numbers(binary, set_of(joints, influences, set));
        json& stored = attributes["WEIGHTS_" + std::to_string(set)];
        stored = add_numbers(binary, set_of(weights, influences, set));
        stored["scale"] = to_json(1.0f / 65535);
    }
}

// `curvature`: null where the target changes none.
json add_target(Binary& binary, const PartOnPage& on_page, const RigTarget& target,
                const TargetCurvature* curvature) {
    float most = 0;
    for (const uint32_t v : on_page.own) most = std::max(most, length(target.moves_mm[v]));
    std::vector<uint32_t> places;
    std::vector<float> moves, turns;
    std::vector<int8_t> bends;
    for (uint32_t i = 0; i < on_page.own.size(); ++i) {
        const Vec3 move = target.moves_mm[on_page.own[i]], turn = target.turns[on_page.own[i]];
        if (length(move) <= most * kLeastMove && length(turn) < kLeastTurn) continue;
        places.push_back(i);
        append(moves, move, 0.001f);
        append(turns, turn);
        if (curvature) bends.push_back(curvature->changes[on_page.part.vertices[on_page.own[i]]]);
    }
    json positions = add_scaled<int16_t>(binary, moves), normals = add_scaled<int8_t>(binary, turns);
    positions["places"] = normals["places"] = add_vertices(binary, places);
    positions["total"] = normals["total"] = 3 * on_page.own.size();
    json made = {{"POSITION", positions}, {"NORMAL", normals}};
    if (!curvature) return made;
    made["CURVATURE"] = add_numbers(binary, bends);
    made["CURVATURE"]["places"] = positions["places"];
    made["CURVATURE"]["total"] = on_page.own.size();
    return made;
}

// The targets of a part that a clip moves or that its pose has.
std::vector<size_t> used_targets(const Rig& rig, const RigPart& part) {
    std::vector<size_t> used;
    for (size_t t = 0; t < part.targets.size(); ++t) {
        bool moves = part.target_weights[t] != 0;
        for (const RigClip& clip : rig.clips)
            for (const RigChannel& channel : clip.channels)
                for (size_t i = t; channel.path == "weights" && channel.node == part.node &&
                                   t < channel.keys.width && i < channel.keys.values.size();
                     i += channel.keys.width)
                    moves = moves || channel.keys.values[i] != 0;
        if (moves) used.push_back(t);
    }
    return used;
}

json mesh_json(Binary& binary, const PartOnPage& on_page, const std::vector<size_t>& targets,
               std::span<const TargetCurvature> curvatures) {
    const Mesh& mesh = on_page.part.mesh;
    std::vector<float> positions, normals, tangents;
    for (const uint32_t v : on_page.own) {
        append(positions, mesh.positions_mm[v], 0.001f);
        append(normals, mesh.normals[v]);
        const Vec4 t = mesh.tangents[v];
        tangents.insert(tangents.end(), {t.x, t.y, t.z, t.w});
    }
    json attributes = {{"POSITION", add_scaled<int16_t>(binary, positions)},
                       {"NORMAL", add_scaled<int16_t>(binary, normals)},
                       {"TANGENT", add_scaled<int8_t>(binary, tangents)}};
    add_influences(binary, on_page, attributes);
    json primitive = {{"attributes", std::move(attributes)}, {"targets", json::array()}};
    json weights = json::array();
    for (const size_t t : targets) {
        const RigTarget& target = on_page.part.targets[t];
        const auto found = std::ranges::find(curvatures, target.name, &TargetCurvature::name);
        primitive["targets"].push_back(
            add_target(binary, on_page, target, found == curvatures.end() ? nullptr : &*found));
        weights.push_back(to_json(on_page.part.target_weights[t]));
    }
    return {{"primitives", {std::move(primitive)}},
            {"weights", weights},
            {"vertices", add_vertices(binary, on_page.page)}};
}

json node_json(const RigNode& node) {
    json made = {{"children", node.children}};
    if (node.matrix) {
        made["matrix"] = *node.matrix;
        return made;
    }
    made["translation"] = node.translation;
    made["rotation"] = node.rotation;
    made["scale"] = node.scale;
    return made;
}

// Weights of the used targets alone.
std::vector<float> values_of(const RigChannel& channel, const std::vector<size_t>& targets) {
    if (channel.path != "weights") return channel.keys.values;
    std::vector<float> values;
    for (size_t first = 0; first < channel.keys.values.size(); first += channel.keys.width)
        for (const size_t t : targets)
            if (t < channel.keys.width) values.push_back(channel.keys.values[first + t]);
    return values;
}

json clip_json(Binary& binary, const RigClip& clip, const Rig& rig,
               const std::vector<std::vector<size_t>>& targets) {
    json samplers = json::array(), channels = json::array();
    for (const RigChannel& channel : clip.channels) {
        const auto part = std::ranges::find(rig.parts, channel.node, &RigPart::node);
        const std::vector<float> values = part == rig.parts.end()
                                              ? channel.keys.values
                                              : values_of(channel, targets[size_t(part - rig.parts.begin())]);
        if (values.empty()) continue;
        const gltf::Interpolation kind = channel.keys.interpolation;
        channels.push_back(
            {{"sampler", samplers.size()}, {"target", {{"node", channel.node}, {"path", channel.path}}}});
        samplers.push_back({{"input", add_numbers(binary, channel.keys.times_s)},
                            {"output", add_numbers(binary, values)},
                            {"interpolation", kind == gltf::Interpolation::step     ? "STEP"
                                              : kind == gltf::Interpolation::linear ? "LINEAR"
                                                                                    : "CUBICSPLINE"}});
    }
    return {{"name", clip.name}, {"samplers", samplers}, {"channels", channels}};
}

}  // namespace

std::vector<std::string> used_targets(const Rig& rig) {
    std::vector<std::string> names;
    for (const RigPart& part : rig.parts)
        for (const size_t t : used_targets(rig, part))
            if (const std::string& name = part.targets[t].name; std::ranges::find(names, name) == names.end())
                names.push_back(name);
    return names;
}

json add_motion(Binary& binary, const Rig& rig, std::span<const TargetCurvature> curvatures,
                std::span<const uint32_t> number_on_page) {
    json made = {{"scene", 0},
                 {"scenes", {{{"nodes", {0}}}}},
                 {"nodes", json::array()},
                 {"meshes", json::array()},
                 {"skins", json::array()},
                 {"animations", json::array()},
                 {"most_curvature_per_mm", to_json(kMostMeanCurvatureChange)}};
    for (const RigNode& node : rig.nodes) made["nodes"].push_back(node_json(node));
    std::vector<std::vector<size_t>> targets;
    for (const RigPart& part : rig.parts) {
        targets.push_back(used_targets(rig, part));
        json& node = made["nodes"][part.node];
        node["mesh"] = made["meshes"].size();
        if (part.skin) node["skin"] = *part.skin;
        made["meshes"].push_back(
            mesh_json(binary, part_on_page(part, number_on_page), targets.back(), curvatures));
    }
    for (const RigSkin& skin : rig.skins) {
        std::vector<float> binds;
        for (const auto& matrix : skin.inverse_binds) binds.insert(binds.end(), matrix.begin(), matrix.end());
        made["skins"].push_back(
            {{"joints", skin.joints}, {"inverseBindMatrices", add_numbers(binary, binds)}});
    }
    for (const RigClip& clip : rig.clips) {
        json one = clip_json(binary, clip, rig, targets);
        if (!one["channels"].empty()) made["animations"].push_back(std::move(one));
    }
    return made;
}

}  // namespace dermis::inline engines::web
