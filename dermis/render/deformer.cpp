#include "dermis/render/deformer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dermis/scene/place_mesh.h"

namespace dermis::inline render {
namespace {

// No buffer is empty: an array without elements has one of zeros.
std::vector<std::byte> bytes_of(const auto& values) {
    const auto view = std::as_bytes(std::span(values));
    std::vector<std::byte> bytes(view.begin(), view.end());
    constexpr size_t kElement = 24;  // of any of them, at least
    if (bytes.empty()) bytes.resize(kElement);
    return bytes;
}

Pass pose_pass(const std::string& mesh, const std::string& what, uint32_t threads,
               std::vector<std::pair<std::string, std::string>> buffers) {
    Pass pass = {.name = "pose " + mesh + what,
                 .kind = PassKind::compute,
                 .shader = "renderer/pose_" + what + ".comp",
                 .threads = threads};
    for (auto& [binding, buffer] : buffers) pass.buffers.emplace_back(std::move(binding), mesh + buffer);
    return pass;
}

// `mesh` precedes the names of its buffers.
std::vector<Pass> passes_of(const std::string& mesh, const DeformArrays& made) {
    std::vector<Pass> passes = {pose_pass(mesh, "places", made.places,
                                          {{"Places", "places"},
                                           {"Changes", "changes"},
                                           {"Influences", "influences"},
                                           {"Targets", "targets"},
                                           {"Matrices", "matrices"},
                                           {"Positions", "positions"},
                                           {"Unmorphed", "unmorphed"}}),
                                pose_pass(mesh, "vertices", made.vertices,
                                          {{"NormalChanges", "normal changes"},
                                           {"Targets", "normal targets"},
                                           {"Vertices", "vertices"},
                                           {"Rings", "rings"},
                                           {"Directions", "directions"},
                                           {"Stencils", "stencils"},
                                           {"Influences", "influences"},
                                           {"Matrices", "matrices"},
                                           {"Positions", "positions"},
                                           {"Unmorphed", "unmorphed"},
                                           {"PositionStream", "position_mm"},
                                           {"NormalStream", "normal"},
                                           {"TangentStream", "tangent"},
                                           {"DiagonalStream", "curvature_diagonal_per_mm"},
                                           {"MixedStream", "curvature_mixed_per_mm"},
                                           {"DuStream", "du_mm"},
                                           {"DvStream", "dv_mm"},
                                           {"TensionStream", "tension"}})};
    passes.back().constants = {{"has_normal_changes", int32_t(made.has_normal_changes)}};
    return passes;
}

// 12 numbers each, after the placement.
std::vector<float> placed_matrices(const MotionState& state, const Placement& placement) {
    Placement turn = placement;
    turn.translation_mm = {};
    Mesh axes{.positions_mm = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    place_mesh(axes, turn);
    const auto part = [](Vec3 v, size_t i) { return double(i == 0 ? v.x : i == 1 ? v.y : v.z); };
    std::vector<float> numbers;
    for (const std::array<double, 12>& matrix : state.matrices)
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column) {
                double sum = column == 3 ? part(placement.translation_mm, row) : 0;
                for (size_t k = 0; k < 3; ++k)
                    sum += part(axes.positions_mm[k], row) * matrix[4 * k + column];
                numbers.push_back(float(sum));
            }
    return numbers;
}

}  // namespace

Result<std::optional<Deformer>> Deformer::create(gpu::Device& device, gpu::ShaderSource shaders,
                                                 const Scene& scene, const ScenePoser& poser,
                                                 std::span<const gpu::Geometry* const> geometries) {
    constexpr std::nullopt_t kOnCpu = std::nullopt;
    if (poser.moves_colors() || scene.rest_bakes.any() || device.info().storage_buffers < kStorageBuffers)
        return std::optional<Deformer>(kOnCpu);
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(device, std::move(shaders)));
    Deformer deformer(std::move(executor));
    for (const SceneObject& object : scene.objects) deformer.still_.push_back(object.target_weights);
    for (const ScenePoser::Posed& posed : poser.all()) {
        if (!posed.file) return std::optional<Deformer>(kOnCpu);
        DERMIS_TRY_ASSIGN(VertexMotion motion, posed.file->motion());
        const SceneObject& object = scene.objects[posed.object];
        DERMIS_TRY_ASSIGN(PosedVertices at_rest, posed.file->pose({}));
        Mesh placed{.positions_mm = std::move(at_rest.positions_mm)};
        place_mesh(placed, object.placement);
        DeformArrays made = deform_arrays(motion, object.mesh, posed.rest, placed.positions_mm);
        DERMIS_TRY(deformer.add(device, posed, object.placement, *geometries[posed.object], std::move(made),
                                std::move(motion.has_normals)));
    }
    return std::optional<Deformer>(std::move(deformer));
}

Result<void> Deformer::add(gpu::Device& device, const ScenePoser::Posed& posed, const Placement& placement,
                           const gpu::Geometry& geometry, DeformArrays made,
                           std::vector<uint8_t> has_normals) {
    DeformedMesh mesh{.poser = &*posed.file,
                      .object = posed.object,
                      .placement = placement,
                      .geometry = &geometry,
                      .name = std::to_string(meshes_.size()) + " ",
                      .has_normals = std::move(has_normals)};
    const auto put = [&](const std::string& name, const auto& values) -> Result<void> {
        DERMIS_TRY_ASSIGN(gpu::Array array, gpu::Array::upload(device, name, bytes_of(values)));
        mesh.arrays.emplace(name, std::move(array));
        return {};
    };
    for (const DeformArray& array : made.constant) DERMIS_TRY(put(array.name, array.words));
    // What one pass writes for the next.
    for (const char* name : {"positions", "unmorphed"}) DERMIS_TRY(put(name, std::vector<Vec3>(made.places)));
    std::ranges::move(passes_of(mesh.name, made), std::back_inserter(list_.passes));
    mesh.of_places = std::move(made.of_places), mesh.of_vertices = std::move(made.of_vertices);
    meshes_.push_back(std::move(mesh));
    return {};
}

Result<std::vector<TargetWeights>> Deformer::pose(const Pose& pose) {
    std::vector<TargetWeights> weights = still_;
    gpu::FrameInputs inputs = {.width = 1, .height = 1};
    std::vector<gpu::Array> streamed;
    streamed.reserve(3 * meshes_.size());
    for (const DeformedMesh& mesh : meshes_) {
        for (const auto& [name, array] : mesh.arrays) inputs.buffers[mesh.name + name] = {.array = &array};
        for (const char* stream : {"position_mm", "normal", "tangent", "curvature_diagonal_per_mm",
                                   "curvature_mixed_per_mm", "du_mm", "dv_mm", "tension"})
            inputs.buffers[mesh.name + stream] = {.geometry = mesh.geometry, .stream = stream};
        DERMIS_TRY_ASSIGN(MotionState state, mesh.poser->state(pose));
        const auto stream = [&](const std::string& name, const auto& values) {
            streamed.push_back(gpu::Array::streamed(bytes_of(values)));
            inputs.buffers[mesh.name + name] = {.array = &streamed.back()};
        };
        stream("targets", active_targets(mesh.of_places, state.weights, mesh.has_normals));
        stream("normal targets", active_targets(mesh.of_vertices, state.weights, mesh.has_normals));
        stream("matrices", placed_matrices(state, mesh.placement));
        weights[mesh.object] = std::move(state.target_weights);
    }
    const Result<uint64_t> submitted = executor_.submit(list_, inputs);
    return submitted ? Result(std::move(weights)) : submitted.error();
}

}  // namespace dermis::inline render
