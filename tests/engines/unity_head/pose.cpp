#include "engines/unity_head/pose.h"

#include <Eigen/Geometry>
#include <map>

#include "dermis/mesh/gltf/sampler.h"

namespace dermis::unity_head {

using nlohmann::json;

namespace {

constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};

// Numbers of a node by the name of the property.
using Properties = std::map<std::string, std::vector<double>>;

Properties properties_of(const Glb& glb, const json& node) {
    Properties found = {{"translation", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}};
    if (node.contains("mesh")) {
        const json& mesh = glb.document["meshes"][size_t(node["mesh"])];
        found["weights"] = mesh.value("weights", std::vector<double>());
    }
    for (const char* path : kPaths)
        if (node.contains(path)) found[path] = node[path].get<std::vector<double>>();
    return found;
}

std::vector<double> sampled(const Glb& glb, const json& sampler, const std::string& path, double time_s) {
    const std::string kind = sampler.value("interpolation", "LINEAR");
    gltf::Keys keys = {.interpolation = kind == "STEP"     ? gltf::Interpolation::step
                                        : kind == "LINEAR" ? gltf::Interpolation::linear
                                                           : gltf::Interpolation::cubic_spline,
                       .times_s = floats_of(glb, sampler["input"]),
                       .values = floats_of(glb, sampler["output"])};
    keys.width = keys.values.size() / keys.times_s.size();
    if (keys.interpolation == gltf::Interpolation::cubic_spline) keys.width /= 3;
    return gltf::sample(keys, time_s, path == "rotation");
}

Eigen::Matrix4d matrix_of(const json& node, const Properties& properties) {
    if (node.contains("matrix"))
        return Eigen::Map<const Eigen::Matrix4d>(node["matrix"].get<std::vector<double>>().data());
    const auto numbers = [&](const char* path) { return properties.at(path).data(); };
    Eigen::Affine3d made = Eigen::Affine3d::Identity();
    made.translate(Eigen::Map<const Eigen::Vector3d>(numbers("translation")));
    made.rotate(Eigen::Quaterniond(numbers("rotation")).normalized());
    made.scale(Eigen::Map<const Eigen::Vector3d>(numbers("scale")));
    return made.matrix();
}

void place(const Glb& glb, size_t node, const Eigen::Matrix4d& parent, const std::vector<Properties>& all,
           std::vector<PosedNode>& posed) {
    const json& source = glb.document["nodes"][node];
    posed[node].to_world = parent * matrix_of(source, all[node]);
    if (all[node].contains("weights")) posed[node].weights = all[node].at("weights");
    for (const json& child : source.value("children", json::array()))
        place(glb, child, posed[node].to_world, all, posed);
}

void add_targets(const Glb& glb, const json& primitive, const std::vector<double>& weights, Shape& shape) {
    for (size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        const json& target = primitive["targets"][i];
        for (const auto& [name, numbers] :
             {std::pair("POSITION", &shape.positions), {"NORMAL", &shape.normals}}) {
            const std::vector<float> changes = floats_of(glb, target[name]);
            for (size_t k = 0; k < changes.size(); ++k) (*numbers)[k] += float(weights[i]) * changes[k];
        }
    }
}

// Of each vertex: the blend of its bones; without a skin the node's own matrix.
std::vector<Eigen::Matrix4d> vertex_matrices(const Glb& glb, const std::vector<PosedNode>& nodes, size_t node,
                                             const json& attributes, size_t count) {
    const json& source = glb.document["nodes"][node];
    if (!source.contains("skin")) return std::vector(count, nodes[node].to_world);
    const json& skin = glb.document["skins"][size_t(source["skin"])];
    const std::vector<float> binds = floats_of(glb, skin["inverseBindMatrices"]);
    std::vector<Eigen::Matrix4d> bones;
    for (const json& joint : skin["joints"])
        bones.push_back(nodes[size_t(joint)].to_world *
                        Eigen::Map<const Eigen::Matrix4f>(&binds[16 * bones.size()]).cast<double>());
    std::vector<Eigen::Matrix4d> blends(count, Eigen::Matrix4d::Zero());
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
        const auto joints = integers_of(glb, attributes["JOINTS_" + std::to_string(set)]);
        const auto weights = floats_of(glb, attributes["WEIGHTS_" + std::to_string(set)]);
        for (size_t i = 0; i < joints.size(); ++i) blends[i / 4] += double(weights[i]) * bones[joints[i]];
    }
    return blends;
}

// The first three of each `each` numbers, as places or as directions of length 1.
void transform(std::vector<float>& numbers, size_t each, bool is_place,
               const std::vector<Eigen::Matrix4d>& matrices) {
    for (size_t v = 0; v < matrices.size(); ++v) {
        Eigen::Map<Eigen::Vector3f> at(&numbers[v * each]);
        const Eigen::Vector4d moved = matrices[v] * at.cast<double>().homogeneous();
        const Eigen::Vector3d turned = matrices[v].topLeftCorner<3, 3>() * at.cast<double>();
        at = (is_place ? Eigen::Vector3d(moved.head<3>()) : turned.normalized()).cast<float>();
    }
}

}  // namespace

Result<std::vector<PosedNode>> posed_nodes(const Glb& glb, const Moment& moment) {
    std::vector<Properties> all;
    for (const json& node : glb.document["nodes"]) all.push_back(properties_of(glb, node));
    bool has_clip = moment.clip.empty();
    for (const json& clip : glb.document.value("animations", json::array())) {
        if (clip["name"] != moment.clip) continue;
        has_clip = true;
        for (const json& channel : clip["channels"]) {
            const std::string path = channel["target"]["path"];
            all[size_t(channel["target"]["node"])][path] =
                sampled(glb, clip["samplers"][size_t(channel["sampler"])], path, moment.time_s);
        }
    }
    if (!has_clip) return Error{"the head has no clip '" + moment.clip + "'"};
    std::vector<PosedNode> posed(all.size());
    for (const json& root : glb.document["scenes"][glb.document.value("scene", size_t(0))]["nodes"])
        place(glb, root, Eigen::Matrix4d::Identity(), all, posed);
    return posed;
}

Shape posed_shape(const Glb& glb, const std::vector<PosedNode>& nodes, size_t node, const json& primitive) {
    const json& attributes = primitive["attributes"];
    Shape shape = {floats_of(glb, attributes["POSITION"]), floats_of(glb, attributes["NORMAL"]), {}};
    if (attributes.contains("TANGENT")) shape.tangents = floats_of(glb, attributes["TANGENT"]);
    add_targets(glb, primitive, nodes[node].weights, shape);
    const auto matrices = vertex_matrices(glb, nodes, node, attributes, shape.positions.size() / 3);
    transform(shape.positions, 3, true, matrices);
    transform(shape.normals, 3, false, matrices);
    if (!shape.tangents.empty()) transform(shape.tangents, 4, false, matrices);
    return shape;
}

}  // namespace dermis::unity_head
