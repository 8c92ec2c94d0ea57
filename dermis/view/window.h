#pragma once
// The window: size, input, clipboard. GLFW stays behind it.

#include <memory>
#include <string>
#include <vector>

#include "dermis/gpu/swapchain.h"
#include "dermis/view/event.h"

namespace dermis::view {

struct WindowSize {
    int width = 0, height = 0;
    friend bool operator==(const WindowSize&, const WindowSize&) = default;
};

/// Movable handle; one at a time, on the main thread.
class Window {
  public:
    /// Errors: no display (says how to get one), or a display that cannot show Vulkan.
    [[nodiscard]] static Result<Window> open(const std::string& title, WindowSize size);
    ~Window();
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;

    /// Arguments for DeviceOptions and Swapchain.
    [[nodiscard]] std::vector<std::string> instance_extensions() const;
    [[nodiscard]] gpu::SurfaceMaker surface_maker() const;

    /// Events since the last call. `wait_s` > 0: sleeps until one comes, at most so long.
    [[nodiscard]] std::vector<Event> poll(double wait_s);

    /// In pixels; zero while minimised.
    [[nodiscard]] WindowSize framebuffer() const;
    /// The desktop's scale: 1, 2 on many HiDPI displays.
    [[nodiscard]] float content_scale() const;
    [[nodiscard]] bool should_close() const;
    [[nodiscard]] std::string clipboard() const;
    void set_clipboard(const std::string& text);
    void set_title(const std::string& title);
    void resize(WindowSize size);
    void minimise();
    void restore();

    struct State;

  private:
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::view
