#include "dermis/view/window_frame.h"

namespace dermis::view {
namespace {

// Around the pictures: darker than the panels, so that the picture's own black stays readable.
constexpr Vec4 kFrameColor = {0.075f, 0.075f, 0.075f, 1};

}  // namespace

PassList window_passes(const WindowFrame& frame) {
    const Vec2 window_px = {float(frame.width), float(frame.height)};
    const Region& region = frame.region;
    PassList list;
    list.images = {{.name = "window", .format = ImageFormat::rgba8, .size = {frame.width, frame.height}}};
    Pass compose = {.name = "compose",
                    .kind = PassKind::fullscreen,
                    .colors = {{.image = "window",
                                .clear = {kFrameColor.x, kFrameColor.y, kFrameColor.z, kFrameColor.w}}}};
    if (frame.arrangement != Arrangement::none) {  // otherwise the pass only clears
        compose.shader = "renderer/compose.frag";
        compose.values = {{"region_px", Vec4{region.x, region.y, region.width, region.height}},
                          {"frame_color", kFrameColor},
                          {"window_px", window_px},
                          {"split", frame.split},
                          {"line_px", frame.line_px},
                          {"mode", int32_t(frame.arrangement)}};
    }
    list.passes = {std::move(compose)};
    if (frame.has_interface)
        list.passes.push_back({.name = "interface",
                               .kind = PassKind::geometry_screen,
                               .shader = "renderer/interface.frag",
                               .vertex_shader = "renderer/interface.vert",
                               .colors = {{.image = "window", .load = LoadOp::load, .blend = Blend::alpha}},
                               .geometry = GeometryFilter::all,
                               .values = {{"window_px", window_px}}});
    return list;
}

}  // namespace dermis::view
