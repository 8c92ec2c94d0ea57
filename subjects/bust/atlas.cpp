#include "subjects/bust/atlas.h"

#include "dermis/base/parallel.h"
#include "subjects/bust/flatten.h"

namespace dermis::bust {
namespace {

struct Slot {
    double x, y, width, height;  // texels of the 2048 atlas, y down
    double roundness;
    int rounds;
};
constexpr double kHeadHeight = 1724;
constexpr double kStripTop = kHeadHeight + 2 * kGutter, kStrip = kAtlasSide - kStripTop - kGutter;
constexpr Slot kSlots[kChartCount] = {
    {kGutter, kGutter, kAtlasSide - 2.0 * kGutter, kHeadHeight, 5, 3},
    {kGutter, kStripTop, 520, kStrip, 2.6, 3},
    {540, kStripTop, 520, kStrip, 2.6, 3},
    {1070, kStripTop, 480, kStrip, 2.6, 2},
};

// The face gets more texels than the back of the head and the chest.
double face_density(Point p) {
    const double front = smooth_step(-20, 70, p.z), head = smooth_step(-150, -95, p.y);
    return mix(0.75, 1.0, front * head);
}

}  // namespace

Atlas make_atlas(const Surface& surface, const BustField& field) {
    const std::vector<Chart> charts = cut_charts(surface, field);
    std::vector<std::vector<Point>> flats(charts.size());
    parallel_for(charts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            const Slot& s = kSlots[k];
            flats[k] =
                flatten(charts[k], {.width = s.width,
                                    .height = s.height,
                                    .roundness = s.roundness,
                                    .rounds = s.rounds,
                                    .density = charts[k].kind == ChartKind::head ? face_density : nullptr});
        }
    });
    Atlas atlas;
    for (size_t k = 0; k < charts.size(); ++k) {
        const int base = int(atlas.mesh.points.size());
        const Slot& s = kSlots[k];
        for (size_t i = 0; i < flats[k].size(); ++i) {
            atlas.mesh.points.push_back(charts[k].mesh.points[i]);
            atlas.uvs.push_back(
                {(s.x + flats[k][i].x) / kAtlasSide, (s.y + s.height - flats[k][i].y) / kAtlasSide, 0});
        }
        for (const auto& t : charts[k].mesh.triangles) {
            atlas.mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
            atlas.kind.push_back(charts[k].kind);
        }
    }
    return atlas;
}

}  // namespace dermis::bust
