#pragma once
// Poses meshes on the device, by compute passes before the frames that draw them: morph targets and skin,
// normals, tangents, curvature, dP/du and tension. ScenePoser does the same on the CPU.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dermis/gpu/executor.h"
#include "dermis/render/deformed_mesh.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

class Deformer {
  public:
    /// What its largest pass binds. Vulkan requires 4 of every device.
    static constexpr int kStorageBuffers = 18;

    /// `geometries`: one an object, with all streams of a mesh in a pose. The poser, the device and they must
    /// outlive it. Nothing where only the CPU poses: subjects, bakes carried from the rest pose, colours that
    /// follow the pose, a device that binds fewer than kStorageBuffers. Errors: the device, a mesh file.
    [[nodiscard]] static Result<std::optional<Deformer>> create(
        gpu::Device& device, gpu::ShaderSource shaders, const Scene& scene, const ScenePoser& poser,
        std::span<const gpu::Geometry* const> geometries);

    /// Fills the geometries' streams as ScenePoser::pose() and an upload would, without waiting, and returns
    /// the weights of the morph targets of each object of the scene, which stays as it is. Each frame only
    /// weights and matrices go to the device.
    ///
    /// Largest differences from the CPU, which blends matrices in double, on clips of ICT's face: positions
    /// 1e-4 mm, normals and tangents 1e-3, curvature 5e-3 / mm (mean 2.5e-5), tension 2e-4, dP/du and dP/dv
    /// 0.2 mm. Vertices share normal and tension if they move together in every pose, not if they happen to
    /// meet in one. Where a sum of normals cancels, a vertex has that of its last triangle.
    [[nodiscard]] Result<std::vector<TargetWeights>> pose(const Pose& pose);

    /// Times of poses that are done, each once, oldest first.
    [[nodiscard]] Result<std::vector<gpu::FrameResult>> finished() { return executor_.finished(); }

  private:
    struct DeformedMesh {
        const MeshPoser* poser = nullptr;
        size_t object = 0;
        Placement placement;
        const gpu::Geometry* geometry = nullptr;
        std::string name;                  ///< precedes the names of its buffers
        std::vector<uint8_t> has_normals;  ///< VertexMotion::has_normals
        ChangedBlocks of_places, of_vertices;
        std::map<std::string, gpu::Array> arrays;
    };

    explicit Deformer(gpu::Executor executor) : executor_(std::move(executor)) {}
    Result<void> add(gpu::Device& device, const ScenePoser::Posed& posed, const Placement& placement,
                     const gpu::Geometry& geometry, DeformArrays made, std::vector<uint8_t> has_normals);

    gpu::Executor executor_;
    std::vector<TargetWeights> still_;  // of each object as loaded, for those that no pose moves
    std::vector<DeformedMesh> meshes_;
    PassList list_;
};

}  // namespace dermis::inline render
