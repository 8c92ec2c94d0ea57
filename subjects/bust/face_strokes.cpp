// The sculptor's strokes of the face, on the left half (x > 0) unless they run along the midline.

#include "subjects/bust/parts.h"

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
    // Brow: superciliary arches, the rim of the orbit down to its tail, the glabella between.
    brush.both({{{6, 43, 106}, 13, 0.8},
                {{16, 40, 104}, 13, 2.6},
                {{29, 41, 99}, 14, 3.0},
                {{42, 39, 90}, 13.5, 2.9},
                {{50, 33, 80}, 12, 2.3},
                {{54, 23, 74}, 12, 1.0}});
    brush.both({{{30, 74, 98}, 20, 1.2}});  // frontal eminence
    // Temporal line, where the forehead turns to the side; the temple behind it.
    brush.both(
        {{{52, 38, 80}, 13, 0.6}, {{55, 58, 74}, 19, 1.0}, {{52, 80, 66}, 21, 0.8}, {{46, 98, 52}, 22, 0.4}});
    brush.both({{{66, 46, 52}, 22, -1.8}, {{67, 30, 46}, 16, -1.0}});
    // Orbit: deep under the brow beside the nose, running out over the lid; trough under the lower lid.
    brush.both({{{13, 27, 99}, 8, -3.6},
                {{16.5, 31, 98}, 9, -6.2},
                {{24, 33.0, 97}, 8.5, -3.8},
                {{33, 32.5, 95}, 8, -1.9},
                {{42, 29, 89}, 7, -0.6}});
    brush.both(
        {{{15, 19, 96}, 7, -2.2}, {{19, 12, 96}, 8, -2.0}, {{26, 7, 95}, 9, -1.0}, {{33, 5, 93}, 9, -0.3}});
    // Cheekbone from beside the nose to the arch before the ear; the cavity under it.
    brush.both({{{33, 0, 93}, 16, 0.6},
                {{44, 3, 86}, 20, 1.7},
                {{55, 5, 73}, 20, 2.4},
                {{64, 8, 54}, 18, 1.8},
                {{72, 9, 30}, 15, 0.8}});
    brush.both({{{67, -18, 38}, 20, -1.2}, {{59, -24, 60}, 24, -2.0}, {{48, -34, 76}, 20, -0.8}});
    // Muzzle beside the nose and mouth, the fold between it and the cheek.
    brush.both({{{18, -10, 105}, 10, -1.0},
                {{24, -18, 102}, 10, -1.2},
                {{31, -30, 96}, 12, -1.1},
                {{35, -42, 90}, 13, -0.8}});
    brush.both({{{30, -7, 98}, 16, 1.6}, {{38, -17, 92}, 15, 1.2}});
    // Jaw: angle, edge, and chin with its pads.
    brush.both({{{57, -49, 16}, 17, 3.2},
                {{54, -60, 34}, 16, 2.0},
                {{44, -74, 58}, 15, 1.4},
                {{30, -83, 80}, 14, 0.8}});
    brush.middle({{{-19, -78, 103}, 15, 1.8}, {{0, -77, 108}, 16, 2.2}, {{19, -78, 103}, 15, 1.8}});
    brush.middle({{{-22, -56, 99}, 11, -0.7}, {{0, -58.5, 106}, 10, -2.8}, {{22, -56, 99}, 11, -0.7}});
    // Back: the occiput with its bump over the muscles' line, the furrow of the nape between two cords of
    // muscle, the seventh neck vertebra, and the groove of the spine below it between the trapezius' halves.
    brush.middle({{{-16, 12, -86}, 26, 1.0}, {{0, 8, -87}, 26, 2.2}, {{16, 12, -86}, 26, 1.0}});
    brush.middle({{{0, -14, -84}, 13, 1.1}});
    brush.both({{{14, -22, -80}, 14, -0.7}, {{34, -20, -70}, 16, -0.9}, {{50, -14, -50}, 16, -0.8}});
    brush.middle({{{0, -36, -70}, 15, -1.6},
                  {{0, -58, -62}, 14, -2.0},
                  {{0, -84, -62}, 14, -1.6},
                  {{0, -108, -66}, 14, -0.8}});
    brush.both({{{17, -34, -68}, 17, 1.1},
                {{19, -62, -62}, 17, 1.5},
                {{21, -92, -64}, 18, 1.3},
                {{26, -118, -68}, 20, 0.8}});
    brush.middle({{{0, -129, -70}, 13, 2.0}, {{0, -134, -72}, 22, 1.2}});
    brush.middle({{{0, -150, -76}, 16, -1.2}, {{0, -176, -80}, 18, -2.0}, {{0, -200, -82}, 18, -2.0}});
    brush.both({{{30, -160, -76}, 30, 1.6}, {{44, -190, -78}, 32, 2.0}});
}

void add_detail_strokes(StrokeLayer& layer, const StrokeLayer::Snap& snap) {
    Brush brush(layer, snap);
    // The fullness above the upper lid's outer half, the trough under the lower lid.
    brush.both({{{36, 34, 95}, 9, 0.4}, {{44, 30, 89}, 9, 0.9}, {{50, 23, 82}, 9, 0.5}});
    brush.both({{{17, 14.5, 94}, 5, -0.3}, {{24, 8.5, 95}, 6, -0.4}, {{33, 6.5, 93}, 6, -0.15}});
    brush.both({{{14.2, 19.6, 94}, 3.2, -0.3}});
    // Groove around the wing of the nose, and the fold that runs down from it.
    brush.both({{{13.0, -4.0, 112}, 4.0, -0.2},
                {{16.6, -7.5, 107}, 3.6, -0.8},
                {{18.4, -13, 104}, 3.2, -1.2},
                {{17.0, -18, 105}, 3.0, -0.9},
                {{13.5, -20.5, 107}, 2.8, -0.3}});
    brush.both({{{20.0, -14, 105}, 7, -0.9}, {{26, -23, 101}, 10, -1.0}, {{33, -36, 95}, 11, -0.5}});
    // Philtrum: groove with a column on either side.
    brush.middle({{{0, -21.5, 114}, 4.0, -0.7}, {{0, -26, 115}, 4.6, -1.1}, {{0, -29.5, 116}, 4.8, -0.7}});
    brush.both({{{4.4, -21, 114}, 3.6, 0.3}, {{5.4, -25.5, 115}, 3.6, 0.55}, {{6.2, -28.6, 116}, 3.4, 0.35}});
    // Corners of the mouth.
    brush.both({{{24, -39.4, 102}, 5.0, -0.8}, {{27, -40.0, 99}, 7, -0.8}});
    // Creases of the nape.
    brush.middle({{{-26, -50, -58}, 6, -0.3}, {{0, -53, -63}, 6.5, -1.0}, {{24, -49, -59}, 6, -0.4}});
    brush.middle({{{-20, -67, -60}, 6, -0.3}, {{-4, -69, -62}, 6, -0.7}, {{20, -65, -60}, 6, -0.2}});
    // Notch over the breastbone.
    brush.middle({{{0, -166, 34}, 14, -2.0}});
}

}  // namespace dermis::bust
