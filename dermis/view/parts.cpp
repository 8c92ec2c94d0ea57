#include "dermis/view/parts.h"

#include <algorithm>

namespace dermis::view {
namespace {

// Two techniques side by side use some 25 pipelines, so a user can go back and forth between techniques
// without waiting. More would fill the memory of drivers for the CPU, which take 4 to 5 MB for a technique's
// pipeline.
constexpr size_t kMostPipelines = 48;

}  // namespace

Parts::Parts(const ViewerOptions& o, const Clock& running, Window opened, gpu::Device created,
             std::future<Result<Start>> first)
    : options(o),
      clock(running),
      window(std::move(opened)),
      device(std::move(created)),
      model{.catalog = o.catalog,
            .choices = {TechniqueChoice(o.catalog.techniques.front()),
                        TechniqueChoice(o.catalog.techniques.front())}},
      pictures(gpu::embedded_shaders(o.catalog.shaders),
               o.shader_root.empty() ? std::string(DERMIS_SOURCE_DIR) : o.shader_root),
      opener(
          o, std::move(first),
          {.device = device, .clock = clock, .model = model, .pictures = pictures, .reference = reference}),
      input(!o.script.empty()),
      player(o.script, o.script_name) {}

Result<std::unique_ptr<Parts>> Parts::open(const ViewerOptions& options) {
    const Clock clock(!options.script.empty());
    std::future<Result<Start>> loading = std::async(std::launch::async, options.load);
    Result<Window> window = Window::open("Dermis", options.size);
    if (!window) return window.error();
    Result<gpu::Device> device = gpu::Device::create({.validation = options.validation,
                                                      .on_message = options.on_message,
                                                      .name_contains = options.device,
                                                      .instance_extensions = window->instance_extensions(),
                                                      .most_pipelines = kMostPipelines});
    if (!device) return device.error();
    auto parts =
        std::make_unique<Parts>(options, clock, std::move(*window), std::move(*device), std::move(loading));

    Result<Presenter> presenter =
        Presenter::create(parts->device, parts->window, gpu::embedded_shaders(options.catalog.shaders));
    if (!presenter) return presenter.error();
    parts->presenter.emplace(std::move(*presenter));
    Window& shown = parts->window;
    Result<Interface> interface = Interface::create(
        parts->device, {.get = [&shown] { return shown.clipboard(); },
                        .set = [&shown](const std::string& text) { shown.set_clipboard(text); }});
    if (!interface) return interface.error();
    parts->interface.emplace(std::move(*interface));
    return parts;
}

Region Parts::picture_area() const {
    const WindowSize size = presenter->size();
    return picture_region(model, size.width, size.height, interface->scale());
}

PictureSize Parts::picture_size() const {
    const Region area = picture_area();
    const float share = model.compare == Compare::side_by_side ? 0.5f : 1;
    return {std::max(1, int(area.width * share)), std::max(1, int(area.height))};
}

bool Parts::is_settled() const {
    return has_final_pictures() && !opener.is_loading() && !opener.has_new_words() && !is_working() &&
           !model.playing && !resting_pose.is_due(pictures.scene());
}

}  // namespace dermis::view
