// parse_gltf() and what parse_mesh() does to vertices, without what no pose changes.

#include "dermis/mesh/mesh_poser.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "dermis/base/text.h"
#include "dermis/mesh/follow_normals.h"
#include "dermis/mesh/gltf/instances.h"

namespace dermis::inline mesh {

struct MeshPoser::State {
    gltf::Document document;
    std::filesystem::path name;
    std::optional<gltf::Instances> instances;
    Mesh mesh;  ///< positions, normals and indices of the last pose
    std::optional<SmoothNormals> smooth;

    [[nodiscard]] Result<PosedVertices> pose(const Pose& pose);

  private:
    [[nodiscard]] Result<void> failure() const;
};

Result<void> MeshPoser::State::failure() const {
    if (!document.messages.error) return {};
    return Error{printable_line(document.messages.error->message)};
}

Result<PosedVertices> MeshPoser::State::pose(const Pose& pose) {
    document.messages.error.reset();
    std::vector<uint32_t> indices;
    std::vector<Vec3> unmorphed_mm;
    mesh.positions_mm.clear(), mesh.normals.clear(), mesh.tangents.clear();
    indices.reserve(mesh.indices.size());
    bool any_normals = false, any_unmorphed = false;
    for (const gltf::Instance& instance : instances->in_pose(pose)) {
        const gltf::Primitive& primitive = *instance.primitive;
        if (primitive.indices.empty() || document.messages.error) continue;
        const size_t first = mesh.positions_mm.size();
        const gltf::PlacedVertices placed =
            gltf::place_vertices(document, instance, instances->to_mm(), mesh, unmorphed_mm);
        any_normals |= !primitive.normals.empty();
        any_unmorphed |= placed.has_unmorphed;
        gltf::append_triangles(primitive.indices, first, placed.determinants < 0, indices);
    }
    DERMIS_TRY(failure());
    if (indices.empty()) return Error{name.string() + ": no triangles in the default scene"};
    if (!smooth || indices != mesh.indices) {
        mesh.indices = std::move(indices);
        smooth.emplace(mesh.indices);
    }
    mesh.tangents.clear();
    if (any_normals && any_unmorphed) turn_normals(unmorphed_mm, mesh, *smooth);
    for (const Vec3& p : mesh.positions_mm)
        if (!std::isfinite(p.x + p.y + p.z))
            return Error{name.string() + ": a position is out of range in millimetres; check the unit"};
    complete_normals(mesh, &*smooth);
    return PosedVertices{mesh.positions_mm, mesh.normals, instances->target_weights()};
}

Result<MeshPoser> MeshPoser::create(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                    const ReadSibling& read_sibling, const MeshOptions& options) {
    auto state = std::make_unique<State>();
    state->name = name;
    gltf::open_document(bytes, name, read_sibling, options, state->document);
    if (!state->document.messages.error)
        state->instances.emplace(state->document, options.unit_mm.value_or(1000));
    if (state->document.messages.error) return Error{printable_line(state->document.messages.error->message)};
    return MeshPoser(std::move(state));
}

Result<PosedVertices> MeshPoser::pose(const Pose& pose) const {
    return state_->pose(pose);
}

MeshPoser::MeshPoser(std::unique_ptr<State> state) : state_(std::move(state)) {}
MeshPoser::~MeshPoser() = default;
MeshPoser::MeshPoser(MeshPoser&&) noexcept = default;
MeshPoser& MeshPoser::operator=(MeshPoser&&) noexcept = default;

}  // namespace dermis::inline mesh
