#include "dermis/view/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>

#include "dermis/view/window_surface.h"

namespace dermis::view {

static_assert(kKeyF1.code == GLFW_KEY_F1 && kKeyEnd.code == GLFW_KEY_END &&
              kKeyEscape.code == GLFW_KEY_ESCAPE);

struct Window::State {
    GLFWwindow* handle = nullptr;
    std::vector<Event> events;
    Vec2 mouse_px;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (handle) glfwDestroyWindow(handle);
        glfwTerminate();
    }
};

namespace {

Window::State& state_of(GLFWwindow* handle) {
    return *static_cast<Window::State*>(glfwGetWindowUserPointer(handle));
}

Modifiers modifiers_of(int mods) {
    return {.shift = (mods & GLFW_MOD_SHIFT) != 0,
            .ctrl = (mods & GLFW_MOD_CONTROL) != 0,
            .alt = (mods & GLFW_MOD_ALT) != 0};
}

// GLFW counts the cursor in screen units, which HiDPI desktops make larger than pixels.
void on_move(GLFWwindow* handle, double x, double y) {
    int units_wide = 0, units_high = 0, width = 0, height = 0;
    glfwGetWindowSize(handle, &units_wide, &units_high);
    glfwGetFramebufferSize(handle, &width, &height);
    Window::State& state = state_of(handle);
    state.mouse_px = {float(x * width / std::max(units_wide, 1)),
                      float(y * height / std::max(units_high, 1))};
    state.events.push_back({.kind = EventKind::mouse_move, .position_px = state.mouse_px});
}

void on_button(GLFWwindow* handle, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    Window::State& state = state_of(handle);
    state.events.push_back({.kind = EventKind::mouse_button,
                            .position_px = state.mouse_px,
                            .button = MouseButton(button),
                            .pressed = action == GLFW_PRESS,
                            .modifiers = modifiers_of(mods)});
}

void on_scroll(GLFWwindow* handle, double, double y) {
    Window::State& state = state_of(handle);
    state.events.push_back({.kind = EventKind::scroll, .position_px = state.mouse_px, .scroll = float(y)});
}

void on_key(GLFWwindow* handle, int key, int, int action, int mods) {
    if (key == GLFW_KEY_UNKNOWN) return;
    state_of(handle).events.push_back({.kind = EventKind::key,
                                       .pressed = action != GLFW_RELEASE,
                                       .key = Key{key},
                                       .modifiers = modifiers_of(mods)});
}

void on_text(GLFWwindow* handle, unsigned character) {
    state_of(handle).events.push_back({.kind = EventKind::text, .character = character});
}

// The window was uncovered: its picture must be presented again.
void on_refresh(GLFWwindow* handle) {
    Window::State& state = state_of(handle);
    state.events.push_back({.kind = EventKind::mouse_move, .position_px = state.mouse_px});
}

void on_drop(GLFWwindow* handle, int count, const char** paths) {
    state_of(handle).events.push_back(
        {.kind = EventKind::drop, .paths = std::vector<std::filesystem::path>(paths, paths + count)});
}

std::string last_error() {
    const char* said = nullptr;
    glfwGetError(&said);
    return said ? said : "the window library does not say why";
}

// GLFW 3.4 tries Wayland first. Where no Wayland display is named, Wayland's library writes to the error
// stream.
void choose_platform() {
#ifdef GLFW_PLATFORM
    if (!std::getenv("WAYLAND_DISPLAY") && !std::getenv("WAYLAND_SOCKET"))
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

}  // namespace

Result<Window> Window::open(const std::string& title, WindowSize size) {
    choose_platform();
    if (!glfwInit())
        return Error{"no display to open a window on (" + last_error() +
                     "); start it in a desktop session, through ssh -X, or with: xvfb-run dermis view"};
    auto state = std::make_unique<State>();  // its destructor terminates GLFW
    if (!glfwVulkanSupported())
        return Error{"this display shows no Vulkan (" + last_error() + "); install mesa-vulkan-drivers"};
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    state->handle = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (!state->handle) return Error{"no window (" + last_error() + ")"};
    glfwSetWindowUserPointer(state->handle, state.get());
    glfwSetWindowSizeLimits(state->handle, 160, 120, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetCursorPosCallback(state->handle, on_move);
    glfwSetMouseButtonCallback(state->handle, on_button);
    glfwSetScrollCallback(state->handle, on_scroll);
    glfwSetKeyCallback(state->handle, on_key);
    glfwSetCharCallback(state->handle, on_text);
    glfwSetDropCallback(state->handle, on_drop);
    glfwSetWindowRefreshCallback(state->handle, on_refresh);
    return Window(std::move(state));
}

std::vector<std::string> Window::instance_extensions() const {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return names ? std::vector<std::string>(names, names + count) : std::vector<std::string>();
}

gpu::SurfaceMaker Window::surface_maker() const {
    return [handle = state_->handle](void* instance) { return make_surface(instance, handle); };
}

std::vector<Event> Window::poll(double wait_s) {
    if (wait_s > 0)
        glfwWaitEventsTimeout(wait_s);
    else
        glfwPollEvents();
    return std::exchange(state_->events, {});
}

WindowSize Window::framebuffer() const {
    WindowSize size;
    if (glfwGetWindowAttrib(state_->handle, GLFW_ICONIFIED)) return size;
    glfwGetFramebufferSize(state_->handle, &size.width, &size.height);
    return size;
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(state_->handle, &x, &y);
    return std::max(x, y);
}

bool Window::should_close() const {
    return glfwWindowShouldClose(state_->handle);
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(state_->handle);
    return text ? text : "";
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(state_->handle, text.c_str());
}
void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->handle, title.c_str());
}
void Window::resize(WindowSize size) {
    glfwSetWindowSize(state_->handle, size.width, size.height);
}
void Window::minimise() {
    glfwIconifyWindow(state_->handle);
}
void Window::restore() {
    glfwRestoreWindow(state_->handle);
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;

}  // namespace dermis::view
