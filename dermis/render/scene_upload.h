#pragma once
// A scene on the device: geometry, maps, environment.

#include <map>
#include <memory>

#include "dermis/gpu/executor.h"
#include "dermis/render/seam_textures.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

/// Owns what was uploaded; draws() point into it.
class SceneOnDevice {
  public:
    /// Decodes maps on all cores. Errors name the file.
    [[nodiscard]] static Result<SceneOnDevice> upload(gpu::Device& device, const Scene& scene);

    /// After a change of the scene's environment; on an error the old one stays.
    [[nodiscard]] Result<void> replace_environment(gpu::Device& device, const Scene& scene);
    /// After a change of its skin (tint, roughness, ...) or of the values of its materials; maps stay.
    void update_materials(const Scene& scene);

    /// After the vertices of its objects have moved: what upload() made of them, but for the occlusion.
    [[nodiscard]] Result<void> replace_vertices(gpu::Device& device, const Scene& scene);
    /// Gives every geometry a stream "tension", 0 where the mesh has none, unless they have it.
    [[nodiscard]] Result<void> add_tensions(gpu::Device& device, const Scene& scene);
    /// Uploads the scene's objects again after they were replaced by objects with the same submeshes and
    /// materials. Textures stay, gains become 1. After an error, upload the whole scene.
    [[nodiscard]] Result<void> replace_objects(gpu::Device& device, const Scene& scene);

    /// After objects were posed on the device: the weights of their morph targets, one map an object.
    void replace_target_weights(const Scene& scene, std::vector<TargetWeights> weights);

    /// Gains of the vertices (dermis/rays/vertex_gain.h), one array an object; 1 before.
    [[nodiscard]] Result<void> replace_gains(gpu::Device& device, std::span<const std::vector<Vec3>> gains);

    [[nodiscard]] const std::vector<gpu::Draw>& draws() const { return draws_; }
    [[nodiscard]] std::vector<const gpu::Geometry*> geometries() const;
    [[nodiscard]] bool has(gpu::DrawClass draw_class) const;
    /// Warnings about its maps, one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    /// Whether alpha cuts any of what is drawn (cutoff_of_map).
    [[nodiscard]] bool has_cut_outs() const { return has_cut_outs_; }
    /// Whether the geometries have the stream "tension": some object was in a pose when it was uploaded.
    [[nodiscard]] bool has_tension() const { return has_tension_; }
    /// Specialisation constants "has_TEXTURE": whether any material has that map.
    [[nodiscard]] const std::vector<std::pair<std::string, int32_t>>& map_constants() const {
        return map_constants_;
    }
    [[nodiscard]] const gpu::Texture& environment_cube() const { return *environment_cube_; }
    [[nodiscard]] const gpu::Texture& environment_brdf() const { return *environment_brdf_; }
    [[nodiscard]] const gpu::Texture& no_image() const { return *no_image_; }
    [[nodiscard]] UvDensity uv_density() const { return uv_density_; }
    [[nodiscard]] int environment_mip_count() const { return environment_mip_count_; }
    [[nodiscard]] const std::array<Vec3, 9>& environment_sh() const { return environment_sh_; }

    std::string gains_key;  ///< what replace_gains() was called for; empty: not yet

  private:
    Result<void> upload_maps(gpu::Device& device, const Scene& scene);
    Result<void> upload_objects(gpu::Device& device, const Scene& scene);
    void put_target_weights(const Scene& scene);
    Result<void> upload_tensions(gpu::Device& device, const Scene& scene);
    Result<void> put_tensions(gpu::Device& device, const Scene& scene);
    Result<void> upload_environment(gpu::Device& device, const Scene& scene);

    // Pointers stay valid when the whole moves: textures and geometries live in node-based containers.
    std::map<std::string, gpu::Texture> textures_;
    std::vector<std::unique_ptr<gpu::Geometry>> geometries_;
    std::unique_ptr<gpu::Texture> environment_cube_, environment_brdf_, no_image_;
    int environment_mip_count_ = 1;
    UvDensity uv_density_;
    std::array<Vec3, 9> environment_sh_ = {};
    std::vector<gpu::Draw> draws_;
    std::vector<TargetWeights> target_weights_;  // of each object, in the pose that the draws show
    bool has_cut_outs_ = false, has_tension_ = false;
    std::vector<std::pair<std::string, int32_t>> map_constants_;
    std::vector<std::string> warnings_;
};

}  // namespace dermis::inline render
