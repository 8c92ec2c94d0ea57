// The sculptor's strokes of the face, on the left half (x > 0) unless they run along the midline.

#include "dermis/bust/parts.h"

namespace dermis::bust {
namespace {

class Brush {
  public:
    Brush(StrokeLayer& layer, const StrokeLayer::Snap& snap) : layer_(layer), snap_(snap) {}
    void both(std::initializer_list<StrokePoint> curve) {
        layer_.add(std::span(curve.begin(), curve.size()), Mirror::yes, snap_);
    }
    void middle(std::initializer_list<StrokePoint> curve) {
        layer_.add(std::span(curve.begin(), curve.size()), Mirror::no, snap_);
    }

  private:
    StrokeLayer& layer_;
    const StrokeLayer::Snap& snap_;
};

}  // namespace

void add_form_strokes(StrokeLayer& layer, const StrokeLayer::Snap& snap) {
    Brush brush(layer, snap);
    // Brow: superciliary arches, the rim of the orbit above the tail, the glabella between.
    brush.both({{{5, 44, 106}, 13, 1.2},
                {{16, 44, 104}, 13, 2.6},
                {{30, 46, 98}, 13, 2.4},
                {{43, 44, 88}, 12, 1.8},
                {{51, 36, 77}, 11, 1.2}});
    brush.both({{{30, 75, 98}, 22, 1.2}});  // frontal eminence
    // Orbit: deep at the nose, shallow at the temple; trough under the lower lid.
    brush.both({{{15.5, 27, 97}, 10, -5.5},
                {{21, 32, 96}, 10, -4.5},
                {{31, 33, 95}, 9.5, -3.4},
                {{41, 31, 89}, 9, -2.5},
                {{47, 26, 85}, 9, -1.6}});
    brush.both({{{16, 20, 95}, 8, -2.5}, {{23, 13, 95}, 8, -2.0}, {{33, 10, 93}, 8, -1.2}});
    // Cheekbone from beside the nose to the arch before the ear; hollow under it; temple.
    brush.both({{{30, 0, 94}, 18, 0.8},
                {{45, 2, 84}, 20, 2.0},
                {{57, 5, 68}, 20, 2.0},
                {{66, 7, 48}, 18, 1.2},
                {{72, 7, 28}, 15, 0.5}});
    brush.both({{{62, -22, 48}, 24, -2.0}, {{54, -32, 62}, 20, -1.2}});
    brush.both({{{66, 42, 52}, 22, -2.0}, {{71, 30, 42}, 16, -0.8}});
    // Muzzle beside the nose and mouth, the fold between it and the cheek.
    brush.both({{{18, -14, 105}, 9, -0.8},
                {{24, -22, 102}, 9, -1.2},
                {{31, -34, 96}, 12, -1.0},
                {{34, -46, 90}, 10, -0.8}});
    brush.both({{{30, -12, 99}, 15, 1.2}, {{40, -24, 91}, 16, 1.0}});
    // Jaw: angle, edge, and chin with its pads.
    brush.both({{{57, -48, 18}, 15, 2.4},
                {{53, -62, 36}, 12, 1.8},
                {{43, -76, 60}, 11, 1.2},
                {{30, -85, 80}, 11, 0.8}});
    brush.both({{{9, -77, 107}, 12, 2.2}});
    brush.middle({{{-7, -77, 107}, 16, 2.4}, {{7, -77, 107}, 16, 2.4}});
    brush.middle({{{-16, -60, 103}, 9, -1.2}, {{0, -61, 106}, 9, -3.2}, {{16, -60, 103}, 9, -1.2}});
    brush.both({{{26, -58, 95}, 14, -1.0}});
}

void add_detail_strokes(StrokeLayer& layer, const StrokeLayer::Snap& snap) {
    Brush brush(layer, snap);
    // Slit of the closed lids; the upper lid's edge stands over it.
    std::vector<StrokePoint> slit, upper_edge, lower_edge;
    for (int i = 0; i <= 8; ++i) {
        const double x = 15.5 + 32.5 * i / 8, y = lid_slit_y(x), middle = std::sin(3.14159 * i / 8);
        slit.push_back({{x, y, 92}, 1.25, -0.45 - 0.6 * middle});
        upper_edge.push_back({{x, y + 2.3, 93}, 2.7, 0.15 + 0.65 * middle});
        lower_edge.push_back({{x, y - 2.4, 92}, 2.4, 0.1 + 0.3 * middle});
    }
    layer.add(slit, Mirror::yes, snap);
    layer.add(upper_edge, Mirror::yes, snap);
    layer.add(lower_edge, Mirror::yes, snap);
    // Fold of the upper lid and the fullness above it; folds under the lower lid.
    brush.both({{{17, 26, 92}, 2.4, -0.2},
                {{22, 29, 94}, 2.2, -0.6},
                {{31, 30.5, 95}, 2.1, -0.9},
                {{40, 28.6, 91}, 2.2, -0.8},
                {{47, 24.0, 84}, 2.4, -0.2}});
    brush.both(
        {{{24, 36, 96}, 7, 0.3}, {{34, 36, 95}, 7.5, 0.9}, {{44, 32, 89}, 7.5, 1.3}, {{50, 26, 83}, 7, 0.6}});
    brush.both({{{17, 14.5, 94}, 4.5, -0.35},
                {{24, 9.5, 95}, 5, -0.5},
                {{34, 7.5, 93}, 5, -0.35},
                {{43, 10, 88}, 4.5, -0.1}});
    brush.both({{{14.8, 20.6, 92}, 3.2, -0.5}});
    // Groove around the wing of the nose.
    brush.both({{{11.8, -3.6, 118}, 3.4, -0.3},
                {{15.4, -4.6, 114}, 3.2, -0.8},
                {{18.6, -9.5, 108}, 3.0, -1.2},
                {{18.8, -16, 106}, 3.0, -1.3},
                {{16, -20.5, 108}, 2.8, -0.7}});
    brush.both({{{20.5, -16, 105}, 7, -0.8}, {{26, -24, 101}, 8, -0.9}, {{31, -33, 96}, 8, -0.5}});
    // Philtrum: groove with a column on either side.
    brush.middle({{{0, -21.5, 114}, 4.0, -0.7}, {{0, -26, 115}, 4.6, -1.1}, {{0, -29.5, 116}, 4.8, -0.7}});
    brush.both({{{4.4, -21, 114}, 3.6, 0.3}, {{5.4, -25.5, 115}, 3.6, 0.55}, {{6.2, -28.6, 116}, 3.4, 0.35}});
    // White roll along the upper lip, corners of the mouth.
    brush.both({{{2.5, -30.8, 116}, 2.0, 0.15},
                {{6, -29.2, 116}, 2.0, 0.3},
                {{12, -30.6, 114}, 2.0, 0.25},
                {{19, -34.6, 108}, 2.0, 0.1}});
    brush.both({{{25.5, -39.8, 99}, 4.0, -0.9}, {{28, -41, 97}, 5, -0.4}});
    brush.both({{{31, -38, 96}, 9, 0.6}, {{31, -46, 94}, 9, 0.4}});
    // Notch over the breastbone.
    brush.middle({{{0, -166, 34}, 14, -2.0}});
}

}  // namespace dermis::bust
