#pragma once
// The window's side of the device: composes the pictures and the interface, and hands the result to the
// display.

#include <optional>

#include "dermis/gpu/swapchain.h"
#include "dermis/view/interface.h"
#include "dermis/view/model.h"
#include "dermis/view/panels.h"
#include "dermis/view/window.h"

namespace dermis::view {

/// Content of the window: one picture, or two with a technique's (`b`) or any other (`reference`) on the
/// right.
struct ShownPictures {
    std::optional<gpu::ForeignImage> a, b;
    const gpu::Texture* reference = nullptr;
};

class Presenter {
  public:
    /// The device and the window must outlive it.
    [[nodiscard]] static Result<Presenter> create(gpu::Device& device, const Window& window,
                                                  gpu::ShaderSource shaders);

    /// In pixels, as last presented or resized.
    [[nodiscard]] WindowSize size() const { return size_; }
    [[nodiscard]] Result<void> resize(WindowSize size);

    /// Shows a frame. False when the display wanted another size first: nothing was shown.
    [[nodiscard]] Result<bool> show(const InterfaceDraws& draws, const ShownPictures& pictures,
                                    const Model& model, float scale);

    /// Writes the window as a picture.
    [[nodiscard]] Result<void> capture(const std::string& path);
    [[nodiscard]] gpu::Footprint footprint() const { return executor_->footprint(); }

  private:
    Presenter(gpu::Device& device, const Window& window) : device_(&device), window_(&window) {}
    [[nodiscard]] Result<void> make_swapchain();

    gpu::Device* device_;
    const Window* window_;
    bool vsync_ = true;
    WindowSize size_;
    std::optional<gpu::Swapchain> swapchain_;
    std::optional<gpu::Executor> executor_;
};

}  // namespace dermis::view
