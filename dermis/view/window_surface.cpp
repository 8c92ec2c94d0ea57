// The only file outside dermis/gpu that includes Vulkan: GLFW declares its surface functions only after
// Vulkan's types. No Vulkan function is called here.

#include "dermis/view/window_surface.h"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

namespace dermis::view {

uint64_t make_surface(void* instance, GLFWwindow* window) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(VkInstance(instance), window, nullptr, &surface) != VK_SUCCESS) return 0;
    return uint64_t(surface);
}

}  // namespace dermis::view
