// parse_gltf() and what parse_mesh() does to vertices, without what no pose changes.

#include "dermis/mesh/mesh_poser.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
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
    [[nodiscard]] Result<VertexMotion> motion();
    [[nodiscard]] Result<MotionState> state(const Pose& pose);

  private:
    [[nodiscard]] std::vector<gltf::Instance> drawn(const Pose& pose);
    [[nodiscard]] Result<void> failure() const;
};

namespace {

// Where the weights and matrices of each instance begin in a MotionState. Matrix 0 is of vertices that follow
// no joint.
struct Slots {
    std::vector<uint32_t> weight, matrix;
    uint32_t weights = 0, matrices = 1;

    explicit Slots(std::span<const gltf::Instance> instances) {
        std::map<std::pair<size_t, size_t>, uint32_t> of_placement;  // and number of targets
        std::map<std::pair<const gltf::Affine*, size_t>, uint32_t> of_skin;
        for (const gltf::Instance& instance : instances) {
            const size_t targets = instance.source["targets"].size();
            const auto [weights_at, first] = of_placement.try_emplace({instance.placement, targets}, weights);
            if (first) weights += uint32_t(targets);
            const bool skinned = instance.primitive->influences.per_vertex > 0;
            const auto key = skinned ? std::pair(instance.joints.data(), size_t(0))
                                     : std::pair<const gltf::Affine*, size_t>(nullptr, instance.placement);
            const auto [matrices_at, new_skin] = of_skin.try_emplace(key, matrices);
            if (new_skin) matrices += skinned ? uint32_t(instance.joints.size()) : 1;
            weight.push_back(weights_at->second);
            matrix.push_back(matrices_at->second);
        }
    }
};

std::array<double, 12> rows_of(const gltf::Affine& affine) {
    std::array<double, 12> rows{};
    for (size_t r = 0; r < 3; ++r) {
        for (size_t c = 0; c < 3; ++c) rows[4 * r + c] = affine.linear(Eigen::Index(r), Eigen::Index(c));
        rows[4 * r + 3] = affine.offset[Eigen::Index(r)];
    }
    return rows;
}

void append_influences(const gltf::Primitive& primitive, size_t vertex, uint32_t matrix,
                       VertexMotion& motion) {
    const gltf::Influences& all = primitive.influences;
    motion.first_influence.push_back(uint32_t(motion.influences.size()));
    if (all.per_vertex == 0) return motion.influences.push_back({matrix, 1});
    for (size_t i = vertex * all.per_vertex; i < (vertex + 1) * all.per_vertex; ++i)
        if (all.weights[i] != 0) motion.influences.push_back({matrix + all.joints[i], all.weights[i]});
    if (motion.influences.size() == motion.first_influence.back()) motion.influences.push_back({0, 1});
}

using ChangesOfVertices = std::vector<std::vector<VertexMotion::Change>>;

void append_lists(const ChangesOfVertices& lists, std::vector<uint32_t>& first,
                  std::vector<VertexMotion::Change>& all) {
    for (const auto& changes : lists) {
        first.push_back(uint32_t(all.size()));
        all.insert(all.end(), changes.begin(), changes.end());
    }
}

// Appends the changes that the targets make to one primitive: sorted by vertex, then by target.
void append_changes(gltf::Document& document, const gltf::Instance& instance, uint32_t weight,
                    VertexMotion& motion) {
    gltf::Primitive& primitive = *instance.primitive;
    ChangesOfVertices moves(primitive.positions.size() / 3), turns(moves.size());
    const size_t targets = instance.source["targets"].size();
    for (uint32_t i = 0; i < targets && !instance.source.failed(); ++i) {
        const gltf::MorphTarget& target = gltf::morph_target(document, instance.source, primitive, i);
        if (instance.source.failed()) return;
        motion.has_normals[weight + i] |= target.has_normals;
        for (size_t k = 0; k < target.moved.size(); ++k)
            moves[target.moved[k]].push_back({weight + i, target.changes[k]});
        for (size_t v = 0; v < turns.size() && !target.normals.empty() && !primitive.normals.empty(); ++v) {
            const Vec3 change = {target.normals[3 * v], target.normals[3 * v + 1], target.normals[3 * v + 2]};
            if (!(change == Vec3{})) turns[v].push_back({weight + i, change});
        }
    }
    append_lists(moves, motion.first_change, motion.changes);
    append_lists(turns, motion.first_normal_change, motion.normal_changes);
}

}  // namespace

// Without those that have no triangles.
std::vector<gltf::Instance> MeshPoser::State::drawn(const Pose& pose) {
    document.messages.error.reset();
    std::vector<gltf::Instance> all = instances->in_pose(pose);
    std::erase_if(all, [](const gltf::Instance& one) { return one.primitive->indices.empty(); });
    return all;
}

Result<VertexMotion> MeshPoser::State::motion() {
    VertexMotion motion;
    const std::vector<gltf::Instance> all = drawn({});
    DERMIS_TRY(failure());
    const Slots slots(all);
    motion.has_normals.resize(slots.weights);
    for (size_t k = 0; k < all.size(); ++k) {
        const gltf::Primitive& primitive = *all[k].primitive;
        const size_t first = motion.positions.size(), count = primitive.positions.size() / 3;
        for (size_t i = 0; i < count; ++i) {
            const auto vec3 = [&](const std::vector<float>& v) {
                return v.empty() ? Vec3{} : Vec3{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
            };
            motion.positions.push_back(vec3(primitive.positions));
            motion.normals.push_back(vec3(primitive.normals));
            append_influences(primitive, i, slots.matrix[k], motion);
        }
        append_changes(document, all[k], slots.weight[k], motion);
        DERMIS_TRY(failure());
        const gltf::Affine& transform =
            primitive.influences.per_vertex == 0 ? all[k].world : all[k].joints[0];
        gltf::append_triangles(primitive.indices, first, transform.linear.determinant() < 0, motion.indices);
    }
    motion.first_change.push_back(uint32_t(motion.changes.size()));
    motion.first_normal_change.push_back(uint32_t(motion.normal_changes.size()));
    motion.first_influence.push_back(uint32_t(motion.influences.size()));
    return motion;
}

Result<MotionState> MeshPoser::State::state(const Pose& pose) {
    const std::vector<gltf::Instance> all = drawn(pose);
    DERMIS_TRY(failure());
    const Slots slots(all);
    MotionState state{.target_weights = instances->target_weights()};
    state.weights.resize(slots.weights);
    state.matrices.resize(slots.matrices, rows_of(instances->to_mm()));
    for (size_t k = 0; k < all.size(); ++k) {
        const size_t targets = std::min(all[k].morph.size(), all[k].source["targets"].size());
        std::copy_n(all[k].morph.begin(), targets, state.weights.begin() + slots.weight[k]);
        if (all[k].primitive->influences.per_vertex == 0)
            state.matrices[slots.matrix[k]] = rows_of(all[k].world);
        else
            for (size_t j = 0; j < all[k].joints.size(); ++j)
                state.matrices[slots.matrix[k] + j] = rows_of(all[k].joints[j]);
    }
    return state;
}

Result<void> MeshPoser::State::failure() const {
    if (!document.messages.error) return {};
    return Error{printable_line(document.messages.error->message)};
}

Result<PosedVertices> MeshPoser::State::pose(const Pose& pose) {
    std::vector<uint32_t> indices;
    std::vector<Vec3> unmorphed_mm;
    mesh.positions_mm.clear(), mesh.normals.clear(), mesh.tangents.clear();
    indices.reserve(mesh.indices.size());
    bool any_normals = false, any_unmorphed = false;
    for (const gltf::Instance& instance : drawn(pose)) {
        const gltf::Primitive& primitive = *instance.primitive;
        if (document.messages.error) continue;
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
Result<VertexMotion> MeshPoser::motion() const {
    return state_->motion();
}
Result<MotionState> MeshPoser::state(const Pose& pose) const {
    return state_->state(pose);
}

MeshPoser::MeshPoser(std::unique_ptr<State> state) : state_(std::move(state)) {}
MeshPoser::~MeshPoser() = default;
MeshPoser::MeshPoser(MeshPoser&&) noexcept = default;
MeshPoser& MeshPoser::operator=(MeshPoser&&) noexcept = default;

}  // namespace dermis::inline mesh
