#include "subjects/bust/head_mesh.h"

#include "subjects/bust/remesh.h"

namespace dermis::bust {
namespace {

constexpr double kCoarse = 3.0;
// Fine enough for the ears, 3 mm thin; the second try is for heads where the first grid makes a tunnel
// through an ear.
constexpr double kExtractionCells[] = {2.0, 1.5};

struct Focus {
    Point center, radii;
    double edge_mm;
};
constexpr Focus kFaceFocus[] = {{{0, -39, 112}, {27, 3.5, 24}, 0.5}, {{31.5, 18, 92}, {19, 5, 18}, 0.55},
                                {{31, 20, 90}, {22, 15, 22}, 0.75},  {{0, -10, 118}, {20, 15, 22}, 0.9},
                                {{0, -39, 108}, {31, 14, 26}, 0.8},  {{0, -5, 95}, {58, 62, 45}, 1.7}};

}  // namespace

double wished_edge_mm(const Ear& ear, Point p) {
    const Point q = {std::abs(p.x), p.y, p.z};
    double edge = kCoarse;
    // The fine size inside a focus, which grows to the coarse size over 1.2 times its radius.
    const auto focus = [&](Point offset, Point radii, double fine) {
        const double k = length({offset.x / radii.x, offset.y / radii.y, offset.z / radii.z});
        edge = std::min(edge, mix(fine, kCoarse, smooth_step(0.9, 2.2, k)));
    };
    for (const Focus& f : kFaceFocus) focus(q - f.center, f.radii, f.edge_mm);
    const Point e = ear.to_ear(q);
    focus(e - Point{9, 0, 1}, {24, 37, 16}, 0.85);
    return edge;
}

Surface make_head_surface(const BustField& field) {
    Surface rough;
    for (const double cell_mm : kExtractionCells) {
        rough =
            largest_piece(extract_surface([&](Point p) { return field.distance_mm(p); }, kBustBox, cell_mm));
        if (rough.points.size() == rough.triangles.size() / 2 + 2) break;  // Euler: no tunnels
    }
    return remesh(rough,
                  {.edge_mm = [&](Point p) { return wished_edge_mm(field.ear(), field.to_standard(p)); },
                   .project = [&](Point p) { return field.project(p, 1); },
                   .rounds = 5});
}

}  // namespace dermis::bust
