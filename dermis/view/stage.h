#pragma once
// The loaded scene on the device, and a picture for each side of the comparison. A picture is drawn again
// when its inputs change, or to improve its quality.

#include <array>
#include <memory>
#include <optional>

#include "dermis/render/output.h"
#include "dermis/render/renderer.h"
#include "dermis/view/background_walks.h"
#include "dermis/view/model.h"
#include "dermis/view/quality.h"

namespace dermis::view {

struct PictureSize {
    int width = 1, height = 1;
};

/// One side of the window.
struct Picture {
    gpu::FrameResult timings;  ///< of the last drawing that is done
    Quality quality;
    int width = 0, height = 0;  ///< as drawn
    size_t passes = 0;
};

class Stage {
  public:
    /// `samples`: of the finished picture, 1 or 4; fewer where the device has fewer.
    [[nodiscard]] static Result<Stage> create(gpu::Device& device, const gpu::ShaderSource& shaders,
                                              std::unique_ptr<Scene> scene, int samples);

    [[nodiscard]] Scene& scene() { return *scene_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    /// Samples per pixel of the finished picture.
    [[nodiscard]] int samples() const { return limits_.samples; }

    /// Until the next replace_objects() the pictures are of `baseline`, which needs no bakes, no tables and
    /// few shaders, with one sample a pixel.
    void await_bakes(const Technique& baseline) { baseline_ = &baseline; }
    [[nodiscard]] bool lacks_bakes() const { return baseline_ != nullptr; }

    /// Takes what was walked in the background for gain=map and gain=links: the next refresh draws with it;
    /// before, pictures have gain=curvature.
    void take_walks();
    [[nodiscard]] bool is_walking() const { return walks_.are_walking(); }
    /// Whether the side's picture lacks what is walked.
    [[nodiscard]] bool lacks_walks(size_t choice) const { return sides_[choice].lacks_walks; }

    /// Draws the side `choice` if it is due. True when it drew. An error leaves the last picture standing,
    /// and comes once: the next attempt waits for a change.
    [[nodiscard]] Result<bool> refresh(Model& model, size_t choice, PictureSize size, double now_s);

    /// Takes the times of the side's drawings that are done by now. True when there are new ones.
    [[nodiscard]] Result<bool> take_times(size_t choice);

    /// The side's picture for the window; absent before the first drawing.
    [[nodiscard]] std::optional<gpu::ForeignImage> image(size_t choice) const;
    [[nodiscard]] const Picture& picture(size_t choice) const { return sides_[choice].picture; }
    [[nodiscard]] bool is_final(size_t choice) const;

    /// Draws once more, whole, with all samples and what is walked, and writes it (.png or .exr).
    [[nodiscard]] Result<void> write(Model& model, size_t choice, PictureSize size,
                                     const std::filesystem::path& path);

    /// Those of the scene and of the techniques that drew it.
    void add_warnings(Warnings& warnings) const;

    /// The scene's skin or its environment were changed. An error leaves the environment as it was drawn.
    void skin_changed();
    [[nodiscard]] Result<void> environment_changed();

    /// The pose that the next pictures show (Renderer::pose_on_device).
    [[nodiscard]] Result<bool> pose_on_device(const ScenePoser& poser, const Pose& pose);
    /// The vertices of the scene's objects have moved (Renderer::vertices_moved).
    [[nodiscard]] Result<void> vertices_moved();
    /// Takes objects, bounds and warnings of the same scene in another pose or with its bakes.
    [[nodiscard]] Result<void> replace_objects(Scene loaded);

    /// Marks the picture stale; the next refresh redraws.
    void invalidate();
    /// Reads all shaders again.
    void forget_shaders();

  private:
    /// A drawing whose time is not known yet.
    struct Drawing {
        uint64_t frame = 0;
        Quality quality;
        double megapixels = 0;
    };
    struct Side {
        std::optional<Renderer> renderer;
        std::optional<QualityLadder> ladder;
        std::string key;
        double changed_s = 0;
        Picture picture;
        std::vector<Drawing> in_flight;  ///< oldest first
        bool failed = false;             ///< with this key
        bool lacks_walks = false;
    };

    Stage() = default;
    [[nodiscard]] Result<Renderer*> renderer(size_t choice);
    [[nodiscard]] QualityLimits limits() const;
    [[nodiscard]] DrawSettings settings(const Model& model, PictureSize size, Quality quality) const;

    gpu::Device* device_ = nullptr;
    gpu::ShaderSource shaders_;
    std::unique_ptr<Scene> scene_;
    std::array<Side, 2> sides_;
    QualityLimits limits_;
    const Technique* baseline_ = nullptr;  ///< drawn while the bakes are missing
    BackgroundWalks walks_;
};

}  // namespace dermis::view
