#pragma once
// Dear ImGui between events and draws. Its types stay in .cpp files; panels include it there.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/gpu/executor.h"
#include "dermis/view/event.h"

namespace dermis::view {

/// Triangles of one frame of the interface, for the shaders view/interface.*; the draws point into the
/// geometry.
struct InterfaceDraws {
    std::unique_ptr<gpu::Geometry> geometry;  ///< empty when nothing is shown
    std::vector<gpu::Draw> draws;
};

struct Clipboard {
    std::function<std::string()> get;
    std::function<void(const std::string&)> set;
};

/// One at a time: the library keeps its context in a global.
class Interface {
  public:
    /// Uses find_font() (dermis/image/label.h), else the library's own small font.
    [[nodiscard]] static Result<Interface> create(gpu::Device& device, Clipboard clipboard);
    ~Interface();
    Interface(Interface&&) noexcept;
    Interface& operator=(Interface&&) noexcept;

    /// Letters, spaces and lines all grow with it; makes the font's texture again. 1 suits 1280 x 800.
    [[nodiscard]] Result<void> set_scale(float scale);
    [[nodiscard]] float scale() const;

    /// A frame: begin, panels, end.
    void begin(std::span<const Event> events, int width, int height, double elapsed_s);
    [[nodiscard]] Result<InterfaceDraws> end();

    /// Whether the mouse or the keyboard is with a panel just now.
    [[nodiscard]] bool wants_mouse() const;
    [[nodiscard]] bool wants_keyboard() const;
    /// Whether a widget is held: its value may still change.
    [[nodiscard]] bool holds_widget() const { return holds_widget_; }

  private:
    struct State;
    explicit Interface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
    bool holds_widget_ = false;
};

}  // namespace dermis::view
