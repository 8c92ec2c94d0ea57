// Pictures in a window, where there is a display (under Xvfb, say).

#include "dermis/gpu/swapchain.h"

#include <volk.h>
// After Vulkan, whose types switch GLFW's surface functions on.
#include <GLFW/glfw3.h>

#include "dermis/gpu/device_state.h"
#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SwapchainTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!glfwInit()) GTEST_SKIP() << "no display";
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
        window_ = glfwCreateWindow(64, 48, "dermis test", nullptr, nullptr);
        ASSERT_TRUE(window_);
        uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        if (!names) GTEST_SKIP() << "this display shows no Vulkan";
        Result<Device> device =
            Device::create({.validation = true, .instance_extensions = {names, names + count}});
        ASSERT_TRUE(device) << device.error().message;
        device_ = std::make_unique<Device>(std::move(*device));
    }
    void TearDown() override {
        if (device_) {
            EXPECT_THAT(device_->messages(), IsEmpty());
        }
        device_.reset();
        if (window_) glfwDestroyWindow(window_);
        glfwTerminate();
    }
    [[nodiscard]] SurfaceMaker surface_maker() const {
        return [this](void* instance) {
            VkSurfaceKHR surface = VK_NULL_HANDLE;
            glfwCreateWindowSurface(VkInstance(instance), window_, nullptr, &surface);
            return uint64_t(surface);
        };
    }

    static PassList shown_list() {
        return {.images = {{.name = "display", .format = ImageFormat::rgba8}},
                .passes = {clear_pass("display", {1, 0.5f, 0, 1})}};
    }

    static constexpr SwapchainOptions kWindow = {.width = 64, .height = 48};
    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Device> device_;
};

TEST_F(SwapchainTest, pictures_of_a_list_are_shown_through_a_change_of_size) {
    Result<Executor> executor = Executor::create(*device_, basic_shaders());
    ASSERT_TRUE(executor);
    Result<Swapchain> swapchain = Swapchain::create(*device_, surface_maker(), kWindow);
    ASSERT_TRUE(swapchain) << swapchain.error().message;
    int shown = 0;
    for (int frame = 0; frame < 12; ++frame) {
        if (frame == 6) glfwSetWindowSize(window_, 100, 80);
        glfwPollEvents();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        ASSERT_TRUE(executor->run(shown_list(), {.width = width, .height = height}));
        const Result<Presented> presented = swapchain->present(*executor, "display");
        ASSERT_TRUE(presented) << presented.error().message;
        shown += *presented == Presented::shown;
        if (*presented == Presented::resize) {
            ASSERT_TRUE(swapchain->resize(width, height));
        }
    }
    EXPECT_GE(shown, 8);
    const Result<Presented> missing = swapchain->present(*executor, "nothing");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("'nothing'"));
}

TEST_F(SwapchainTest, a_window_that_frees_no_picture_ends_no_program) {
    Result<Executor> executor = Executor::create(*device_, basic_shaders());
    ASSERT_TRUE(executor);
    Result<Swapchain> swapchain = Swapchain::create(*device_, surface_maker(), kWindow);
    ASSERT_TRUE(swapchain) << swapchain.error().message;
    ASSERT_TRUE(executor->run(shown_list(), {.width = 64, .height = 48}));
    auto& acquire = device_->state().context.vk.vkAcquireNextImageKHR;
    const auto of_the_driver = acquire;
    static uint64_t asked_ns = 0;
    acquire = [](VkDevice, VkSwapchainKHR, uint64_t timeout_ns, VkSemaphore, VkFence, uint32_t*) {
        asked_ns = timeout_ns;
        return VK_TIMEOUT;
    };
    const Result<Presented> none = swapchain->present(*executor, "display");
    acquire = of_the_driver;
    ASSERT_TRUE(none) << none.error().message;
    EXPECT_EQ(*none, Presented::resize);
    EXPECT_LT(asked_ns, UINT64_MAX);
    ASSERT_TRUE(swapchain->resize(64, 48));
    const Result<Presented> next = swapchain->present(*executor, "display");
    ASSERT_TRUE(next) << next.error().message;
    EXPECT_EQ(*next, Presented::shown);
}

TEST_F(SwapchainTest, a_window_without_surface_is_an_error) {
    const Result<Swapchain> swapchain =
        Swapchain::create(*device_, [](void*) { return uint64_t{0}; }, {.width = 1, .height = 1});
    ASSERT_FALSE(swapchain);
    EXPECT_THAT(swapchain.error().message, HasSubstr("no Vulkan surface"));
}

}  // namespace
}  // namespace dermis::gpu
