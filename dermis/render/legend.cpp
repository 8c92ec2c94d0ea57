#include "dermis/render/legend.h"

#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/label.h"
#include "shaders/renderer/constants.h"

namespace dermis::inline render {
namespace {

constexpr int kTickTop = kLegendBarBottom, kTickBottom = kTickTop + 6;
constexpr float kTextPx = 11;

struct Scale {
    std::string_view view;
    double full;  // at the ends of the bar
    const char* unit;
};
const Scale kScales[] = {
    {"curvature", kFullCurvaturePerMm, "1/mm"}, {"n_dot_l", 1, "N·L"}, {"tension", kFullTension, "ln A/A0"}};

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
    DERMIS_TRY_ASSIGN(const Font font, Font::load());
    const TextStyle style = {.size_px = kTextPx, .color = {1, 1, 1}};
    for (int i = 0; i < 5; ++i) {
        const int x = kLegendBarLeft + (kLegendBarRight - kLegendBarLeft) * i / 4;
        const std::string label = to_text(scale->full * (i - 2) / 2);
        for (int y = kTickTop; y < kTickBottom; ++y) ink.set(x, y, 0, 1);
        font.draw(ink, x - font.width_px(label, kTextPx) / 2, kTickBottom + 2, label, style);
    }
    font.draw(ink, kLegendBarRight + 12, 3, scale->unit, style);
    return ink;
}

}  // namespace dermis::inline render
