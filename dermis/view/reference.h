#pragma once
// The right side when it is a picture: a file, or the reference, which is rendered in the background and
// shown while it is refined.

#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <string>

#include "dermis/gpu/executor.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/view/model.h"
#include "dermis/view/stage.h"

namespace dermis::view {

class Reference {
  public:
    Reference() = default;
    /// Stops what is being made and waits for it.
    ~Reference() { stop_ = true; }
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// Any picture; a notice when it cannot be read.
    void open(const std::string& path, Model& model);
    /// Begins to make the reference of what is seen, or stops making it.
    void ask(const Model& model, PictureSize size);
    /// True when one has come, finer or the last, or failed to.
    [[nodiscard]] bool take(Model& model, double now_s);
    [[nodiscard]] bool is_making() const { return making_.valid(); }

    /// The texture follows the picture, exposure and tone map.
    [[nodiscard]] Result<void> refresh(gpu::Device& device, Model& model);
    /// Null if the right side is not a picture.
    [[nodiscard]] const gpu::Texture* texture() const { return texture_ ? &*texture_ : nullptr; }

    /// For another window: the picture, and of which view it is (hash_of_views(); empty for a file).
    [[nodiscard]] const Image& picture() const { return picture_; }
    [[nodiscard]] const std::string& view() const { return view_; }
    void take_over(const Image& picture, const std::string& view) { picture_ = picture, view_ = view; }

  private:
    void put(Image picture, std::string view, const std::string& name, Model& model);
    /// The reference so far, or the last one.
    void show(Image radiance, Model& model);
    [[nodiscard]] bool take_preview(Model& model);
    /// Something else was put on the right while the reference was shown.
    [[nodiscard]] bool is_replaced(const Model& model) const;

    Image picture_;
    std::string view_, asked_view_;
    std::optional<gpu::Texture> texture_;
    std::string texture_key_;
    std::atomic<bool> stop_ = false;
    std::atomic<float> done_ = 0;  ///< 0..1
    bool shows_preview_ = false;
    std::mutex preview_mutex_;
    Image preview_;                                ///< empty when the latest is shown
    std::future<Result<CachedReference>> making_;  // last: waits for its task before the rest goes
};

}  // namespace dermis::view
