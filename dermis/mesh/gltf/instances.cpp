#include "dermis/mesh/gltf/instances.h"

#include <fmt/core.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace dermis::inline mesh::gltf {
namespace {

std::vector<float> weights_of(const JsonView& list) {
    std::vector<float> weights;
    for (size_t i = 0; i < list.size() && !list.failed(); ++i) weights.push_back(float(list[i].number(0)));
    return weights;
}

Affine scaled(double factor) {
    return {factor * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
}

}  // namespace

Instances::Instances(Document& document, double mm_per_unit) : Instances(document, scaled(mm_per_unit)) {}

Instances::Instances(Document& document, const Affine& to_mm) : document_(document), to_mm_(to_mm) {
    const JsonView materials = document_.view()["materials"];
    for (size_t i = 0; i < materials.size() && !failed(); ++i)
        uv_mappings_.push_back(uv_mapping_of_material(document_, materials[i]));
}

std::vector<Instance> Instances::in_pose(const Pose& pose) {
    instances_.clear();
    joints_of_skin_.clear();
    target_weights_.clear();
    placements_ = vertices_ = indices_ = 0;
    node_poses_ = sample_clip(document_, pose);
    tree_ = read_nodes(document_, to_mm_, node_poses_);
    if (!checked_) check_size();
    checked_ = true;
    for (const uint64_t node : tree_.drawn) add_node(node, pose);
    if (!failed() && document_.view()["nodes"].size() == 0)  // a bare mesh library
        for (size_t i = 0; i < document_.view()["meshes"].size(); ++i)
            add_mesh(i, {.node = {}, .node_name = "", .world = to_mm_, .joints = {}, .morph = {}}, pose);
    return std::move(instances_);
}

uint64_t Instances::vertices_of(uint64_t mesh) {
    const JsonView primitives = document_.view()["meshes"][size_t(mesh)]["primitives"];
    uint64_t count = 0;
    for (size_t i = 0; i < primitives.size() && !failed(); ++i) {
        const JsonView position = primitives[i]["attributes"]["POSITION"];
        if (!position.exists()) continue;
        const JsonView accessor = document_.view()["accessors"][size_t(position.integer(0))];
        if (!failed()) count += std::min<uint64_t>(accessor["count"].integer(0), UINT32_MAX);
    }
    return count;
}

// Before anything is read: a few kilobytes of nodes can ask for one mesh a hundred thousand times.
void Instances::check_size() {
    std::map<uint64_t, uint64_t> known;
    uint64_t vertices = 0;
    for (const uint64_t node : tree_.drawn) {
        const JsonView view = document_.view()["nodes"][size_t(node)];
        const uint64_t mesh = view["mesh"].integer(0);
        const auto [at, is_new] = known.try_emplace(mesh, 0);
        if (is_new) at->second = vertices_of(mesh);
        if (failed()) return;
        vertices += at->second;
        if (vertices > document_.max_vertices)
            return view.fail(fmt::format("more vertices than dermis loads ({})", document_.max_vertices));
    }
}

void Instances::add_node(uint64_t index, const Pose& pose) {
    if (failed()) return;
    const JsonView node = document_.view()["nodes"][size_t(index)];
    Placement placement{.node = index,
                        .node_name = node["name"].text(""),
                        .world = tree_.world[size_t(index)],
                        .joints = {},
                        .morph = weights_of(node["weights"])};
    if (const auto posed = node_poses_.find(index); posed != node_poses_.end())
        if (!posed->second.weights.empty()) placement.morph = posed->second.weights;
    if (node["skin"].exists()) {
        const uint64_t skin = node["skin"].integer(0);
        const auto [at, is_new] = joints_of_skin_.try_emplace(skin);
        if (is_new) at->second = joint_matrices(document_, skin, tree_.world);
        placement.joints = at->second;
    }
    if (!failed()) add_mesh(node["mesh"].integer(0), placement, pose);
}

void Instances::add_mesh(uint64_t index, const Placement& placement, const Pose& pose) {
    const JsonView mesh = document_.view()["meshes"][size_t(index)];
    const JsonView primitives = mesh["primitives"];
    const std::string name = mesh["name"].text(placement.node_name);
    std::vector<float> morph = placement.morph.empty() ? weights_of(mesh["weights"]) : placement.morph;
    choose_weights(pose, mesh, morph);
    note_weights(mesh, morph);
    for (size_t i = 0; i < primitives.size() && !failed(); ++i) {
        const uint32_t material = material_of(primitives[i]);
        if (failed()) return;
        Primitive* primitive = primitive_of(index, i, material, placement.joints.size());
        if (!primitive) continue;
        vertices_ += primitive->positions.size() / 3;
        indices_ += primitive->indices.size();
        if (vertices_ > document_.max_vertices || indices_ > 6 * document_.max_vertices)
            return primitives[i].fail("more triangles than dermis loads");
        instances_.push_back({.name = name,
                              .placement = placements_,
                              .node = placement.node,
                              .source = primitives[i],
                              .primitive = primitive,
                              .material = material,
                              .world = placement.world,
                              .joints = placement.joints,
                              .morph = morph});
    }
    ++placements_;
}

Primitive* Instances::primitive_of(uint64_t mesh, size_t index, uint32_t material, size_t joint_count) {
    const auto [at, is_new] = primitives_.try_emplace({mesh, index, joint_count});
    std::optional<Primitive>& kept = at->second;
    if (is_new) {
        const PrimitiveOptions options = {
            .uv_mapping = material == kDefaultMaterial ? UvMapping{} : uv_mappings_[material],
            .joint_count = joint_count};
        const JsonView source = document_.view()["meshes"][size_t(mesh)]["primitives"][index];
        if (!read_primitive(document_, source, options, kept.emplace())) kept.reset();
    }
    return kept ? &*kept : nullptr;
}

void Instances::note_weights(const JsonView& mesh, std::span<const float> morph) {
    if (std::ranges::all_of(morph, [](float weight) { return weight == 0; })) return;
    const std::vector<std::string> names = target_names(mesh);
    for (size_t i = 0; i < std::min(names.size(), morph.size()); ++i) {
        float& known = target_weights_[names[i]];
        if (std::abs(morph[i]) > std::abs(known)) known = morph[i];
    }
}

uint32_t Instances::material_of(const JsonView& source) {
    if (!source["material"].exists()) return kDefaultMaterial;
    const uint64_t material = source["material"].integer(0);
    if (material >= uv_mappings_.size())
        return source["material"].fail(fmt::format("material {} does not exist", material)), 0;
    return uint32_t(material);
}

PlacedVertices place_vertices(Document& document, const Instance& instance, const Affine& to_mm, Mesh& mesh,
                              std::vector<Vec3>& unmorphed_mm) {
    const MorphedVertices at = morph(document, instance.source, *instance.primitive, instance.morph);
    if (instance.source.failed()) return {};
    PlacedVertices placed{.has_unmorphed = !at.unmorphed.empty()};
    const auto vec3 = [](const std::vector<float>& v, size_t first) {
        return Vec3{v[first], v[first + 1], v[first + 2]};
    };
    const Influences& influences = instance.primitive->influences;
    for (size_t i = 0; i < at.positions.size() / 3; ++i) {
        const Affine world =
            influences.per_vertex == 0 ? instance.world : blend(instance.joints, influences, i, to_mm);
        const double determinant = world.linear.determinant();
        placed.determinants += determinant;
        mesh.positions_mm.push_back(world.point(vec3(at.positions, 3 * i)));
        unmorphed_mm.push_back(at.unmorphed.empty() ? mesh.positions_mm.back()
                                                    : world.point(vec3(at.unmorphed, 3 * i)));
        mesh.normals.push_back(at.normals.empty() ? Vec3{}
                                                  : world.for_normals().direction(vec3(at.normals, 3 * i)));
        Vec4 tangent{0, 0, 0, 0};
        if (!at.tangents.empty()) {
            const Vec3 t = world.direction(vec3(at.tangents, 4 * i));
            const float sign = at.tangents[4 * i + 3] < 0 ? -1.0f : 1.0f;
            tangent = {t.x, t.y, t.z, determinant < 0 ? -sign : sign};
        }
        mesh.tangents.push_back(tangent);
    }
    return placed;
}

void append_triangles(std::span<const uint32_t> triangles, size_t first, bool mirrored,
                      std::vector<uint32_t>& indices) {
    for (size_t i = 0; i < triangles.size(); i += 3)
        for (const size_t k : {size_t(0), size_t(mirrored ? 2 : 1), size_t(mirrored ? 1 : 2)})
            indices.push_back(uint32_t(first) + triangles[i + k]);
}

}  // namespace dermis::inline mesh::gltf
