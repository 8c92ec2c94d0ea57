#pragma once
// The pictures of both sides: drawn when one is due, with shaders that follow their files.

#include <string>

#include "dermis/view/hot_shaders.h"
#include "dermis/view/picture_times.h"
#include "dermis/view/presenter.h"
#include "dermis/view/shown_scene.h"

namespace dermis::view {

/// Ends the notice of a file that changed and cannot be used.
inline constexpr const char* kLastGood = "  (the last version without an error stays in use)";

class Pictures {
  public:
    /// As HotShaders.
    Pictures(gpu::ShaderSource embedded, const std::string& shader_root)
        : shaders_(std::move(embedded), shader_root) {}

    [[nodiscard]] ShownScene& scene() { return scene_; }
    [[nodiscard]] const ShownScene& scene() const { return scene_; }
    /// For renderers; this must outlive them.
    [[nodiscard]] gpu::ShaderSource shaders() { return shaders_.source(); }

    /// Looks at the shaders' files. True if the pictures must be drawn again.
    [[nodiscard]] bool follow_shaders();
    /// Present errors of shaders.
    void report_shaders(Notices& notices) const;

    /// Takes the times of drawings that are done by now.
    void take_times(Notices& notices);
    /// Draws what is due; what cannot be drawn is a notice. `reference`: the right side, when it is a
    /// picture.
    void refresh(Model& model, const gpu::Texture* reference, PictureSize size, double now_s);
    [[nodiscard]] ShownPictures shown(const Model& model, const gpu::Texture* reference) const;

    /// Walks are on their way to a picture, or to an earlier one.
    [[nodiscard]] bool are_walking() const { return scene_.is_there() && scene_.stage().is_walking(); }

    /// True if the pictures have their full quality and the last refresh drew nothing.
    [[nodiscard]] bool are_final(const Model& model, const gpu::Texture* reference) const;
    /// The next refresh is awaited before they count as final.
    void await_refresh() { drew_ = true; }
    /// No refresh comes, the window being minimised.
    void skip_refresh() { drew_ = false; }

    /// Size, samples and times of the left picture, for the panels.
    void describe(PanelFacts& facts) const;

  private:
    void report_walks(size_t sides, Notices& notices, double now_s) const;

    HotShaders shaders_;  // outlives the scene's renderers
    ShownScene scene_;
    PictureTimes times_;
    bool shaders_unproven_ = false;
    bool drew_ = false;
};

}  // namespace dermis::view
