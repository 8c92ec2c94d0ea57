#pragma once
// A window's pictures. The window library stays outside: it makes the surface, this shows images of a pass
// list in it.
//
//     // GLFW: DeviceOptions::instance_extensions = glfwGetRequiredInstanceExtensions()
//     Result<Swapchain> swapchain = Swapchain::create(device, [&](void* instance) {
//         VkSurfaceKHR surface = VK_NULL_HANDLE;
//         glfwCreateWindowSurface(VkInstance(instance), window, nullptr, &surface);
//         return uint64_t(surface);
//     }, {.width = width, .height = height});
//     executor.run(list, inputs);
//     if (auto shown = swapchain->present(executor, "display"); shown && *shown == Presented::resize) ...

#include <functional>
#include <memory>

#include "dermis/gpu/executor.h"

namespace dermis::gpu {

/// Makes a VkSurfaceKHR for a VkInstance; 0 when the window library could not.
using SurfaceMaker = std::function<uint64_t(void* instance)>;

/// vsync waits for the display; immediate (where the driver has it) does not, and may tear.
enum class Pacing { vsync, immediate };

struct SwapchainOptions {
    int width = 0, height = 0;  ///< the window's framebuffer, in pixels
    Pacing pacing = Pacing::vsync;
};

/// resize: the window has changed, or freed no picture for 3 s; call Swapchain::resize with its size, then
/// present again.
enum class Presented { shown, resize };

/// Movable handle; must be destroyed before its device and before the window.
class Swapchain {
  public:
    /// Errors: no surface, a device that cannot show pictures on it, DeviceOptions without the window's
    /// extensions.
    [[nodiscard]] static Result<Swapchain> create(Device& device, const SurfaceMaker& make_surface,
                                                  const SwapchainOptions& options);
    ~Swapchain();
    Swapchain(Swapchain&&) noexcept;
    Swapchain& operator=(Swapchain&&) noexcept;

    [[nodiscard]] Result<void> resize(int width, int height);

    /// Shows an image of the executor's last list, scaled to the window. Its numbers are shown as they are,
    /// so the list's last pass must have encoded them as sRGB. Does not wait for
    /// it, only for the frame two before.
    [[nodiscard]] Result<Presented> present(Executor& executor, std::string_view image);

    struct State;

  private:
    explicit Swapchain(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::gpu
