#pragma once
// A window's Vulkan surface.

#include <cstdint>

struct GLFWwindow;

namespace dermis::view {

/// `instance` is a VkInstance, the result a VkSurfaceKHR; 0 when the window has none.
[[nodiscard]] uint64_t make_surface(void* instance, GLFWwindow* window);

}  // namespace dermis::view
