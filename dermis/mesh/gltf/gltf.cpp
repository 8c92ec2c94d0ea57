// The node tree of a glTF file, flattened into one mesh: one submesh a primitive and node.

#include "dermis/mesh/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/mesh/follow_normals.h"
#include "dermis/mesh/gltf/instances.h"

namespace dermis::inline mesh::gltf {
namespace {

class SceneReader {
  public:
    SceneReader(Document& document, double mm_per_unit)
        : document_(document), mm_per_unit_(mm_per_unit), instances_(document, mm_per_unit) {
        material_scales_.assign(document_.view()["materials"].size(), 0);
    }

    Mesh run(const Pose& pose, TargetWeights& target_weights) {
        for (const Instance& instance : instances_.in_pose(pose))
            if (!failed()) append(instance);
        finish();
        target_weights = instances_.target_weights();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] bool failed() const { return document_.messages.error.has_value(); }

    void append(const Instance& instance) {
        const Primitive& primitive = *instance.primitive;
        if (primitive.indices.empty()) return;
        const size_t first = mesh_.positions_mm.size(), count = primitive.positions.size() / 3;
        const PlacedVertices placed =
            place_vertices(document_, instance, instances_.to_mm(), mesh_, unmorphed_mm_);
        if (failed()) return;
        any_unmorphed_ |= placed.has_unmorphed;
        append_colors(primitive, count);
        any_normals_ |= !primitive.normals.empty();
        any_tangents_ |= !primitive.tangents.empty();
        const uint32_t material = instance.material;
        if (material != kDefaultMaterial && material_scales_[material] == 0)
            material_scales_[material] =
                std::cbrt(std::abs(placed.determinants) / double(count)) / mm_per_unit_;
        mesh_.submeshes.push_back({.name = instance.name,
                                   .first_index = uint32_t(mesh_.indices.size()),
                                   .index_count = uint32_t(primitive.indices.size()),
                                   .material = material});
        append_triangles(primitive.indices, first, placed.determinants < 0, mesh_.indices);
    }

    void append_colors(const Primitive& primitive, size_t count) {
        for (size_t i = 0; i < count; ++i) {
            mesh_.uvs.push_back(primitive.uvs.empty() ? Vec2{}
                                                      : Vec2{primitive.uvs[2 * i], primitive.uvs[2 * i + 1]});
            const float* c = primitive.colors.empty() ? nullptr : &primitive.colors[4 * i];
            mesh_.colors_linear.push_back(c ? Vec4{c[0], c[1], c[2], c[3]} : Vec4{1, 1, 1, 1});
        }
        any_uvs_ |= !primitive.uvs.empty();
        any_colors_ |= !primitive.colors.empty();
        if (primitive.uvs.empty()) without_uvs_ += count;
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

    Document& document_;
    double mm_per_unit_;
    Instances instances_;
    Mesh mesh_;
    std::vector<double> material_scales_;  // of the first node that uses each; 0 while unused
    std::vector<Vec3> unmorphed_mm_;       // positions without the targets that have no normals
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
            SceneReader(document, options.unit_mm.value_or(1000)).run(options.pose, loaded.target_weights);
    if (!document.messages.error) loaded.motion = read_motion(document);
    if (!document.messages.error) name_what_is_left_out(document);
    if (document.messages.error) return *document.messages.error;
    loaded.warnings = std::move(document.messages.warnings);
    return loaded;
}

}  // namespace dermis::inline mesh::gltf
