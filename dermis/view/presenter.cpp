#include "dermis/view/presenter.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/io.h"
#include "dermis/view/window_frame.h"

namespace dermis::view {

Result<Presenter> Presenter::create(gpu::Device& device, const Window& window, gpu::ShaderSource shaders) {
    Presenter presenter(device, window);
    presenter.size_ = window.framebuffer();
    DERMIS_TRY(presenter.make_swapchain());
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(device, std::move(shaders)));
    presenter.executor_.emplace(std::move(executor));
    return presenter;
}

Result<void> Presenter::make_swapchain() {
    DERMIS_TRY_ASSIGN(
        gpu::Swapchain swapchain,
        gpu::Swapchain::create(*device_, window_->surface_maker(),
                               {.width = size_.width,
                                .height = size_.height,
                                .pacing = vsync_ ? gpu::Pacing::vsync : gpu::Pacing::immediate}));
    swapchain_.emplace(std::move(swapchain));
    return {};
}

Result<void> Presenter::resize(WindowSize size) {
    if (size == size_) return {};
    size_ = size;
    return swapchain_->resize(size.width, size.height);
}

Result<bool> Presenter::show(const InterfaceDraws& draws, const ShownPictures& pictures, const Model& model,
                             float scale) {
    if (model.vsync != vsync_) {
        vsync_ = model.vsync;
        swapchain_.reset();
        DERMIS_TRY(make_swapchain());
    }
    const bool two = model.compares() && (pictures.b || pictures.reference);
    gpu::FrameInputs inputs = {.width = size_.width, .height = size_.height, .draws = draws.draws};
    Arrangement arrangement = Arrangement::none;
    if (pictures.a) {
        arrangement = Arrangement::one;
        if (two && model.compare == Compare::wipe) arrangement = Arrangement::wipe;
        if (two && model.compare == Compare::side_by_side) arrangement = Arrangement::side_by_side;
        inputs.images["picture_a"] = *pictures.a;
        if (pictures.reference)
            inputs.textures["picture_b"] = pictures.reference;
        else
            inputs.images["picture_b"] = pictures.b ? *pictures.b : *pictures.a;
    }
    const PassList list = window_passes({.width = size_.width,
                                         .height = size_.height,
                                         .region = picture_region(model, size_.width, size_.height, scale),
                                         .arrangement = arrangement,
                                         .split = model.split,
                                         .line_px = std::max(1.0f, std::round(scale)),
                                         .has_interface = !draws.draws.empty()});
    DERMIS_TRY(executor_->submit(list, inputs));
    DERMIS_TRY_ASSIGN(const gpu::Presented presented, swapchain_->present(*executor_, "window"));
    if (presented != gpu::Presented::resize) return true;
    DERMIS_TRY(swapchain_->resize(size_.width, size_.height));
    return false;
}

Result<void> Presenter::capture(const std::string& path) {
    DERMIS_TRY_ASSIGN(Image shown, executor_->read("window"));
    shown.encoding = Encoding::srgb;
    return write_image(path, shown);
}

}  // namespace dermis::view
