#include "dermis/render/legend.h"

#include <cmath>

#include "dermis/image/label.h"

namespace dermis {
namespace {

// view.frag knows the bar's place: these columns, above row kTickTop.
constexpr int kBarLeft = 24, kBarRight = 264, kTickTop = 18, kTickBottom = 24;
constexpr float kTextPx = 11;

struct Scale {
    std::string_view view;
    const char* labels[5];
    const char* unit;
};
constexpr Scale kScales[] = {{"curvature", {"-0.125", "-0.0625", "0", "0.0625", "0.125"}, "1/mm"},
                             {"n_dot_l", {"-1", "-0.5", "0", "0.5", "1"}, "N·L"}};

const Scale* scale_of(std::string_view view) {
    for (const Scale& scale : kScales)
        if (scale.view == view) return &scale;
    return nullptr;
}

}  // namespace

bool has_legend(std::string_view view) {
    return scale_of(view) != nullptr;
}

Result<Image> make_legend(std::string_view view) {
    Image ink(kLegendWidth, kLegendHeight, 1, PixelFormat::u8);
    const Scale* scale = scale_of(view);
    if (!scale) return ink;
    const Result<Font> font = Font::load();
    if (!font) return font.error();
    const TextStyle style = {.size_px = kTextPx, .color = {1, 1, 1}};
    for (int i = 0; i < 5; ++i) {
        const int x = kBarLeft + (kBarRight - kBarLeft) * i / 4;
        for (int y = kTickTop; y < kTickBottom; ++y) ink.set(x, y, 0, 1);
        font->draw(ink, x - font->width_px(scale->labels[i], kTextPx) / 2, kTickBottom + 2, scale->labels[i],
                   style);
    }
    font->draw(ink, kBarRight + 12, 3, scale->unit, style);
    return ink;
}

}  // namespace dermis
