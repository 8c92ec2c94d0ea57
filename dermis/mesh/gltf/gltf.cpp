// The node tree of a glTF file, flattened into one mesh: one submesh a primitive and node.

#include "dermis/mesh/gltf/gltf.h"

#include <fmt/core.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dermis/mesh/follow_normals.h"
#include "dermis/mesh/gltf/animation.h"
#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/material.h"
#include "dermis/mesh/gltf/node_tree.h"
#include "dermis/mesh/gltf/primitive.h"

namespace dermis::inline mesh::gltf {
namespace {

// Where a mesh is drawn.
struct Placement {
    std::string node_name;
    Affine world;
    std::span<const Affine> joints;  // empty: not skinned
    std::vector<float> morph;        // weights; empty: the mesh's own
};

std::vector<float> weights_of(const JsonView& list) {
    std::vector<float> weights;
    for (size_t i = 0; i < list.size() && !list.failed(); ++i) weights.push_back(float(list[i].number(0)));
    return weights;
}

class SceneReader {
  public:
    SceneReader(Document& document, double mm_per_unit, const Pose& pose)
        : document_(document), mm_per_unit_(mm_per_unit), pose_(pose) {
        to_mm_.linear *= mm_per_unit;
    }

    Mesh run(TargetWeights& target_weights) {
        const JsonView materials = document_.view()["materials"];
        material_scales_.assign(materials.size(), 0);
        for (size_t i = 0; i < materials.size() && !failed(); ++i)
            uv_mappings_.push_back(uv_mapping_of_material(document_, materials[i]));
        node_poses_ = sample_clip(document_, pose_);
        tree_ = read_nodes(document_, to_mm_, node_poses_);
        check_size();
        for (const uint64_t node : tree_.drawn) add_node(node);
        if (!failed() && document_.view()["nodes"].size() == 0)  // a bare mesh library
            for (size_t i = 0; i < document_.view()["meshes"].size(); ++i)
                add_mesh(i, {.node_name = "", .world = to_mm_, .joints = {}, .morph = {}});
        finish();
        target_weights = std::move(target_weights_);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] bool failed() const { return document_.messages.error.has_value(); }

    uint64_t vertices_of(uint64_t mesh) {
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
    void check_size() {
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

    void add_node(uint64_t index) {
        if (failed()) return;
        const JsonView node = document_.view()["nodes"][size_t(index)];
        Placement placement{.node_name = node["name"].text(""),
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
        if (!failed()) add_mesh(node["mesh"].integer(0), placement);
    }

    void add_mesh(uint64_t index, const Placement& placement) {
        const JsonView mesh = document_.view()["meshes"][size_t(index)];
        const JsonView primitives = mesh["primitives"];
        const std::string name = mesh["name"].text(placement.node_name);
        std::vector<float> morph = placement.morph.empty() ? weights_of(mesh["weights"]) : placement.morph;
        take_chosen_weights(mesh, morph);
        note_weights(mesh, morph);
        for (size_t i = 0; i < primitives.size() && !failed(); ++i) {
            const uint32_t material = material_of(primitives[i]);
            if (failed()) return;
            const PrimitiveOptions options = {
                .uv_mapping = material == kDefaultMaterial ? UvMapping{} : uv_mappings_[material],
                .joint_count = placement.joints.size(),
                .morph = morph};
            Primitive primitive;
            if (read_primitive(document_, primitives[i], options, primitive))
                append(primitives[i], name, material, primitive, placement);
        }
    }

    // The pose's weights by name or number.
    void take_chosen_weights(const JsonView& mesh, std::vector<float>& morph) {
        if (pose_.morph.empty()) return;
        const std::vector<std::string> names = target_names(mesh);
        morph.resize(names.size());
        for (size_t i = 0; i < names.size(); ++i)
            for (const std::string& key : {numbered_name(i), names[i]})
                if (const auto chosen = pose_.morph.find(key); chosen != pose_.morph.end())
                    morph[i] = chosen->second;
    }

    void note_weights(const JsonView& mesh, std::span<const float> morph) {
        if (std::ranges::all_of(morph, [](float weight) { return weight == 0; })) return;
        const std::vector<std::string> names = target_names(mesh);
        for (size_t i = 0; i < std::min(names.size(), morph.size()); ++i) {
            float& known = target_weights_[names[i]];
            if (std::abs(morph[i]) > std::abs(known)) known = morph[i];
        }
    }

    uint32_t material_of(const JsonView& source) {
        if (!source["material"].exists()) return kDefaultMaterial;
        const uint64_t material = source["material"].integer(0);
        if (material >= material_scales_.size())
            return source["material"].fail(fmt::format("material {} does not exist", material)), 0;
        return uint32_t(material);
    }

    // One vertex; its tangent is zero where the file has none.
    void append_vertex(const Primitive& primitive, size_t i, const Affine& world) {
        const auto vec3 = [](const std::vector<float>& v, size_t at) {
            return Vec3{v[at], v[at + 1], v[at + 2]};
        };
        mesh_.positions_mm.push_back(world.point(vec3(primitive.positions, 3 * i)));
        unmorphed_mm_.push_back(primitive.unmorphed.empty() ? mesh_.positions_mm.back()
                                                            : world.point(vec3(primitive.unmorphed, 3 * i)));
        any_unmorphed_ |= !primitive.unmorphed.empty();
        const Vec3 n = primitive.normals.empty()
                           ? Vec3{}
                           : world.for_normals().direction(vec3(primitive.normals, 3 * i));
        mesh_.normals.push_back(n);
        mesh_.uvs.push_back(primitive.uvs.empty() ? Vec2{}
                                                  : Vec2{primitive.uvs[2 * i], primitive.uvs[2 * i + 1]});
        Vec4 tangent{0, 0, 0, 0};
        if (!primitive.tangents.empty()) {
            const Vec3 t = world.direction(vec3(primitive.tangents, 4 * i));
            const float sign = primitive.tangents[4 * i + 3] < 0 ? -1.0f : 1.0f;
            tangent = {t.x, t.y, t.z, world.linear.determinant() < 0 ? -sign : sign};
        }
        mesh_.tangents.push_back(tangent);
        const float* c = primitive.colors.empty() ? nullptr : &primitive.colors[4 * i];
        mesh_.colors_linear.push_back(c ? Vec4{c[0], c[1], c[2], c[3]} : Vec4{1, 1, 1, 1});
    }

    void append(const JsonView& source, const std::string& name, uint32_t material, Primitive& primitive,
                const Placement& placement) {
        if (primitive.indices.empty()) return;
        const size_t first = mesh_.positions_mm.size(), count = primitive.positions.size() / 3;
        if (mesh_.indices.size() + primitive.indices.size() > 6 * document_.max_vertices)
            return source.fail("more triangles than dermis loads");
        double determinants = 0;
        for (size_t i = 0; i < count; ++i) {
            const Affine world = primitive.influences.per_vertex == 0
                                     ? placement.world
                                     : blend(placement.joints, primitive.influences, i, to_mm_);
            append_vertex(primitive, i, world);
            determinants += world.linear.determinant();
        }
        any_normals_ |= !primitive.normals.empty();
        any_uvs_ |= !primitive.uvs.empty();
        any_tangents_ |= !primitive.tangents.empty();
        any_colors_ |= !primitive.colors.empty();
        if (primitive.uvs.empty()) without_uvs_ += count;
        if (material != kDefaultMaterial && material_scales_[material] == 0)
            material_scales_[material] = std::cbrt(std::abs(determinants) / double(count)) / mm_per_unit_;
        mesh_.submeshes.push_back({.name = name,
                                   .first_index = uint32_t(mesh_.indices.size()),
                                   .index_count = uint32_t(primitive.indices.size()),
                                   .material = material});
        // A mirrored triangle shows its back; turning it round keeps fronts outside.
        for (size_t i = 0; i < primitive.indices.size(); i += 3) {
            if (determinants < 0) std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
            for (size_t k = 0; k < 3; ++k)
                mesh_.indices.push_back(uint32_t(first) + primitive.indices[i + k]);
        }
    }

    void finish() {
        if (failed()) return;
        if (mesh_.indices.empty()) return document_.messages.fail("", "no triangles in the default scene");
        if (any_normals_ && any_unmorphed_) turn_normals(unmorphed_mm_, mesh_);
        if (!any_normals_) mesh_.normals.clear();
        if (!any_uvs_) mesh_.uvs.clear();
        if (!any_tangents_) mesh_.tangents.clear();
        if (!any_colors_) mesh_.colors_linear.clear();
        if (any_uvs_ && without_uvs_ > 0)
            document_.messages.warn("",
                                    std::to_string(without_uvs_) + " vertices have no UV; they get (0, 0)");
        mesh_.materials = read_materials(document_, mm_per_unit_, material_scales_);
        const auto default_number = uint32_t(mesh_.materials.size());
        for (Submesh& submesh : mesh_.submeshes)
            if (submesh.material == kDefaultMaterial) submesh.material = default_number;
        const bool uses_default = std::ranges::any_of(
            mesh_.submeshes, [&](const Submesh& submesh) { return submesh.material == default_number; });
        if (uses_default) mesh_.materials.emplace_back().name = "default";
    }

    static constexpr uint32_t kDefaultMaterial = ~0u;
    Document& document_;
    double mm_per_unit_;
    const Pose& pose_;
    NodePoses node_poses_;
    Affine to_mm_;
    Mesh mesh_;
    NodeTree tree_;
    std::vector<UvMapping> uv_mappings_;  // of every material
    std::map<uint64_t, std::vector<Affine>> joints_of_skin_;
    std::vector<double> material_scales_;  // of the first node that uses each; 0 while unused
    TargetWeights target_weights_;
    std::vector<Vec3> unmorphed_mm_;  // positions without the targets that have no normals
    bool any_unmorphed_ = false;
    bool any_normals_ = false, any_uvs_ = false, any_tangents_ = false, any_colors_ = false;
    size_t without_uvs_ = 0;
};

void name_what_is_left_out(Document& document) {
    const JsonView cameras = document.view()["cameras"];
    if (const size_t count = cameras.size(); count > 0)
        cameras.warn(std::to_string(count) + " not used; the camera is the scene's");
}

}  // namespace

Result<LoadedMesh> parse_gltf(std::span<const std::byte> bytes, const std::filesystem::path& name,
                              const ReadSibling& read_sibling, const MeshOptions& options) {
    Document document;
    open_document(bytes, name, read_sibling, options, document);
    LoadedMesh loaded;
    if (!document.messages.error)
        loaded.mesh =
            SceneReader(document, options.unit_mm.value_or(1000), options.pose).run(loaded.target_weights);
    if (!document.messages.error) loaded.motion = read_motion(document);
    if (!document.messages.error) name_what_is_left_out(document);
    if (document.messages.error) return *document.messages.error;
    loaded.warnings = std::move(document.messages.warnings);
    return loaded;
}

}  // namespace dermis::inline mesh::gltf
