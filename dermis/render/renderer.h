#pragma once
// Scene + technique + device = picture.

#include <map>
#include <memory>

#include "dermis/gpu/executor.h"
#include "dermis/optics/gain_form.h"
#include "dermis/render/deformer.h"
#include "dermis/render/linked_light.h"
#include "dermis/render/scene_upload.h"
#include "dermis/render/seam_textures.h"
#include "dermis/render/shared_passes.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/technique.h"

namespace dermis::inline render {

struct DrawSettings {
    int width = 1024, height = 1024;
    int samples = 1;             ///< 1 or 4
    std::string view = "final";  ///< see view_names()
    bool gbuffer = false;        ///< keep its images for read()
    bool deep = false;           ///< radiance and display in float: for 16-bit files and for measuring
    int shadow_map_size = 2048;
    float penumbra_mm = 2;
};

/// What a renderer keeps for one diffusion profile.
struct ProfileState {
    SkinContext skin;
    std::string tables_key;
    std::map<std::string, gpu::Texture> tables;
    gpu::Values skin_values;
    std::optional<DiffusedNormalsRequest> diffused_normals_request;  ///< of the last frame
    std::map<std::string, gpu::Texture> diffused_normals;
    std::string diffused_normals_key;
    GainForm gain_form;
    Rgb slab_gain = {1, 1, 1};
    bool has_gain_form = false;
};

class Renderer {
  public:
    /// `device` and `scene` must outlive it. Camera, lights, exposure and the like may change between draws;
    /// after changes of environment or materials call the functions below; objects and maps may not change.
    [[nodiscard]] static Result<Renderer> create(gpu::Device& device, gpu::ShaderSource shaders,
                                                 const Scene& scene);
    static Result<Renderer> create(gpu::Device&, gpu::ShaderSource,
                                   const Scene&&) = delete;  // it keeps a pointer

    /// Another renderer of the same scene, so that two pictures exist at once: its own images and tables,
    /// the same geometry and maps. The first must outlive it.
    [[nodiscard]] Result<Renderer> sibling(gpu::ShaderSource shaders);

    /// The scene's environment, or its skin and the values of its materials, have changed. For siblings too.
    /// If an environment cannot be read, the old one stays.
    [[nodiscard]] Result<void> environment_changed();
    void materials_changed() { uploaded_->update_materials(*scene_); }

    /// Vertices of the scene's objects have moved (scene/pose_scene.h): uploads positions, normals, tangents
    /// and curvature. What is baked from the shape (occlusion, diffused normals, gains of walks) stays. The
    /// history of this renderer starts again; call drop_history() of siblings.
    [[nodiscard]] Result<void> vertices_moved();
    /// The same on the device, in the pose that follows next: the scene's own vertices stay as they are.
    /// False where only the CPU can (Deformer::create); then call poser.pose() and vertices_moved(). `poser`
    /// is of the scene and the same until objects_replaced(). The CPU does not wait for the device.
    [[nodiscard]] Result<bool> pose_on_device(const ScenePoser& poser, const Pose& pose);
    /// The meshes on the device, one an object.
    [[nodiscard]] std::vector<const gpu::Geometry*> geometries() const { return uploaded_->geometries(); }
    [[nodiscard]] Deformer* deformer() { return deformer_ && *deformer_ ? &**deformer_ : nullptr; }
    /// The scene has other objects with the same materials, maps and submeshes: uploads them, and bakes again
    /// what is made of the shape. Call forget_shape() of siblings.
    [[nodiscard]] Result<void> objects_replaced();
    void drop_history() { history_key_.clear(); }
    void forget_shape();

    /// One frame. Errors name the pass, or what the technique lacks.
    [[nodiscard]] Result<gpu::FrameResult> draw(const Technique& technique, const ParameterValues& values,
                                                const DrawSettings& settings);

    /// The same without waiting for it, and the times of such frames (executor.h).
    [[nodiscard]] Result<uint64_t> submit(const Technique& technique, const ParameterValues& values,
                                          const DrawSettings& settings);
    [[nodiscard]] Result<std::vector<gpu::FrameResult>> finished() { return executor_.finished(); }

    /// Images of the last frame: linear radiance (f16, RGBA; alpha is coverage), the tone-mapped picture
    /// (sRGB-encoded, u8, or f32 when deep), any image of its list by name.
    [[nodiscard]] Result<Image> radiance();
    [[nodiscard]] Result<Image> display();
    [[nodiscard]] Result<Image> read(std::string_view image);

    /// Whether the scene's meshes are in a pose, so that their vertices have a tension.
    [[nodiscard]] bool has_tension() const { return uploaded_->has_tension(); }

    /// Warnings about wrong pictures, found when a technique first asked for it; one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    gpu::Executor& executor() { return executor_; }

    /// Passes of the last frame, and its other inputs().
    [[nodiscard]] const PassList& list() const { return list_; }
    [[nodiscard]] gpu::FrameInputs inputs(const ParameterValues& values, const DrawSettings& settings) const;

  private:
    Renderer(gpu::Device& device, gpu::ShaderSource shaders, gpu::Executor executor, const Scene& scene);
    [[nodiscard]] Result<void> prepare(const Technique& technique, const ParameterValues& values,
                                       const DrawSettings& settings);
    Result<void> prepare_profiles();
    Result<void> prepare_tables(const Technique& technique, const ParameterValues& values,
                                ProfileState& state);
    [[nodiscard]] Result<PassList> passes_of_profiles(const Technique& technique,
                                                      const ParameterValues& values, FrameContext frame);
    Result<void> prepare_legend(const std::string& view);
    [[nodiscard]] Result<PassList> passes_of(const Technique& technique, const ParameterValues& values,
                                             FrameContext frame);
    void warn(std::string warning);
    Result<void> check_atlas();
    void check_maps();
    Result<void> prepare_seams();
    Result<void> prepare_diffused_normals(ProfileState& state);
    Result<void> prepare_gains(const SharedPassSettings& shared);
    Result<void> prepare_walked_gains();
    Result<void> prepare_linked_light(const SharedPassSettings& shared);

    gpu::Device* device_;
    gpu::ShaderSource shaders_;
    gpu::Executor executor_;
    std::optional<std::optional<Deformer>> deformer_;  ///< absent: not asked for yet
    std::unique_ptr<SceneOnDevice> owned_;             ///< empty in a sibling
    SceneOnDevice* uploaded_ = nullptr;
    const Scene* scene_;
    PassList list_;
    std::string radiance_name_;
    std::string history_key_;  ///< of the light in the persistent images; empty: none
    float history_distance_mm_ = 0;
    std::vector<ProfileState> profiles_;  ///< in the order of skin_profiles()
    std::string legend_view_;             ///< that legend_ is of
    std::unique_ptr<gpu::Texture> legend_;
    std::vector<std::string> warnings_;
    bool atlas_checked_ = false;
    std::optional<std::string> atlas_fault_;  ///< FrameContext::atlas_fault; absent: not asked yet
    bool skin_outside_atlas_ = true;
    std::optional<SeamTextures> seams_;
    std::optional<LinkedLight> linked_light_;
    std::string linked_light_key_;     ///< empty: of another shape
    bool draws_linked_light_ = false;  ///< list_ has its passes
};

}  // namespace dermis::inline render
