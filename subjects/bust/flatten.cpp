// Springs between neighbours with the boundary held on a convex curve (Tutte 1963; weights by the cotangents
// of Pinkall & Polthier 1993, kept positive). As in Yoshizawa, Belyaev & Seidel 2004, the weights are then
// corrected by the stretch found, so that stretched triangles shrink; here edge by edge, which keeps the
// matrix symmetric.

#include "subjects/bust/flatten.h"

#include <Eigen/Sparse>
#include <numbers>

#include "subjects/bust/remesh.h"

namespace dermis::bust {
namespace {

// Points of a superellipse by the fraction of its length, counter-clockwise from its lower left corner.
class Rim {
  public:
    explicit Rim(const FlattenOptions& o) {
        constexpr int kSteps = 4096;
        double sum = 0;
        Point last;
        for (int i = 0; i <= kSteps; ++i) {
            const double angle = 2 * std::numbers::pi * i / kSteps - 0.75 * std::numbers::pi;
            const auto power = [&](double v) {
                return std::copysign(std::pow(std::abs(v), 2 / o.roundness), v);
            };
            const Point p = {o.width / 2 * (1 + power(std::cos(angle))),
                             o.height / 2 * (1 + power(std::sin(angle))), 0};
            if (i > 0) sum += length(p - last);
            points_.push_back(p);
            lengths_.push_back(sum);
            last = p;
        }
    }
    [[nodiscard]] Point at(double fraction) const {
        const double wanted = (fraction - std::floor(fraction)) * lengths_.back();
        const size_t i =
            size_t(std::upper_bound(lengths_.begin(), lengths_.end(), wanted) - lengths_.begin());
        const size_t k = std::clamp<size_t>(i, 1, lengths_.size() - 1);
        return mix(points_[k - 1], points_[k], (wanted - lengths_[k - 1]) / (lengths_[k] - lengths_[k - 1]));
    }

  private:
    std::vector<Point> points_;
    std::vector<double> lengths_;
};

struct Spring {
    int a, b;
    double weight, length_mm;
};

// Boundary vertices on the rim, by their distance along the boundary; the chart's corners at the foot's two
// ends.
void hold_boundary(const Chart& chart, const FlattenOptions& o, std::vector<int> loop,
                   std::vector<Point>& flat) {
    const auto& p = chart.mesh.points;
    const double foot = chart.corners.size() == 2 ? 0.5 * o.width / (o.width + o.height) : 1;
    std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), chart.corners[0]), loop.end());
    const size_t split = chart.corners.size() == 2
                             ? size_t(std::find(loop.begin(), loop.end(), chart.corners[1]) - loop.begin())
                             : loop.size();
    const Rim rim(o);
    const auto lay = [&](size_t begin, size_t end, double from, double to) {
        std::vector<double> along = {0};
        for (size_t i = begin; i < end; ++i)
            along.push_back(along.back() + length(p[loop[(i + 1) % loop.size()]] - p[loop[i]]));
        for (size_t i = begin; i < end; ++i)
            flat[loop[i]] = rim.at(mix(from, to, along[i - begin] / along.back()));
    };
    lay(0, split, 0, foot);
    if (split < loop.size()) lay(split, loop.size(), foot, 1);
}

double cotangent(Point at, Point a, Point b) {
    const Point u = a - at, v = b - at;
    return dot(u, v) / std::max(length(cross(u, v)), 1e-12);
}

std::vector<Spring> springs(const Surface& mesh, const std::function<double(Point)>& density) {
    std::vector<Spring> list;
    const HalfEdges edges(mesh);
    for (int h = 0; h < int(edges.twin.size()); ++h) {
        const int t = edges.twin[h];
        if (t > h) continue;  // once per edge
        const auto corner = [&](int e, int k) { return mesh.triangles[e / 3][(e % 3 + k) % 3]; };
        const int a = corner(h, 0), b = corner(h, 1);
        double w = cotangent(mesh.points[corner(h, 2)], mesh.points[a], mesh.points[b]);
        if (t >= 0) w += cotangent(mesh.points[corner(t, 2)], mesh.points[a], mesh.points[b]);
        const Point middle = (mesh.points[a] + mesh.points[b]) * 0.5;
        list.push_back({a, b, std::clamp(0.5 * w, 0.1, 4.0),
                        length(mesh.points[a] - mesh.points[b]) * (density ? density(middle) : 1.0)});
    }
    return list;
}

// A fan over every hole, so that its inside is held.
Surface with_holes_spanned(const Surface& mesh, const std::vector<std::vector<int>>& loops) {
    Surface closed = mesh;
    for (size_t k = 1; k < loops.size(); ++k) {
        Point center;
        for (const int i : loops[k]) center = center + mesh.points[i] * (1.0 / double(loops[k].size()));
        const int hub = int(closed.points.size());
        closed.points.push_back(center);
        for (size_t i = 0; i < loops[k].size(); ++i)
            closed.triangles.push_back({loops[k][(i + 1) % loops[k].size()], loops[k][i], hub});
    }
    return closed;
}

}  // namespace

std::vector<Point> flatten(const Chart& chart, const FlattenOptions& o) {
    const auto loops = boundary_loops(chart.mesh);
    const Surface mesh = with_holes_spanned(chart.mesh, loops);
    std::vector<Point> flat(mesh.points.size());
    std::vector<int> unknown(mesh.points.size(), 0);
    for (const int i : loops[0]) unknown[i] = -1;
    int count = 0;
    for (int& i : unknown)
        if (i == 0) i = count++;
    hold_boundary(chart, o, loops[0], flat);
    std::vector<Spring> net = springs(mesh, o.density);

    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    for (int round = 0; round < o.rounds; ++round) {
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 2);
        for (const Spring& s : net) {
            const int a = unknown[s.a], b = unknown[s.b];
            if (a >= 0) entries.emplace_back(a, a, s.weight);
            if (b >= 0) entries.emplace_back(b, b, s.weight);
            if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), -s.weight);
            if (a >= 0 && b < 0) right.row(a) += s.weight * Eigen::RowVector2d(flat[s.b].x, flat[s.b].y);
            if (b >= 0 && a < 0) right.row(b) += s.weight * Eigen::RowVector2d(flat[s.a].x, flat[s.a].y);
        }
        Eigen::SparseMatrix<double> matrix(count, count);
        matrix.setFromTriplets(entries.begin(), entries.end());
        if (round == 0) solver.analyzePattern(matrix);
        solver.factorize(matrix);
        const Eigen::MatrixXd solution = solver.solve(right);
        for (size_t i = 0; i < flat.size(); ++i)
            if (unknown[i] >= 0) flat[i] = {solution(unknown[i], 0), solution(unknown[i], 1), 0};
        double mean = 0;
        for (const Spring& s : net)
            mean +=
                std::log(std::max(length(flat[s.a] - flat[s.b]), 1e-9) / s.length_mm) / double(net.size());
        for (Spring& s : net) {
            const double stretch =
                std::max(length(flat[s.a] - flat[s.b]), 1e-9) / s.length_mm / std::exp(mean);
            s.weight *= std::clamp(std::pow(stretch, 0.8), 0.25, 4.0);
        }
    }
    flat.resize(chart.mesh.points.size());
    return flat;
}

std::vector<double> anisotropy(const Surface& mesh, const std::vector<Point>& flat) {
    std::vector<double> ratios;
    ratios.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        // Jacobian from the triangle's plane (x along its first edge) to the atlas; its singular values from
        // half the sum and difference of its conformal and anticonformal parts.
        const Point e = mesh.points[t[1]] - mesh.points[t[0]], f = mesh.points[t[2]] - mesh.points[t[0]];
        const double ex = length(e), fx = dot(e, f) / std::max(ex, 1e-12),
                     fy = length(cross(e, f)) / std::max(ex, 1e-12);
        const Point du = (flat[t[1]] - flat[t[0]]) * (1 / std::max(ex, 1e-12));
        const Point dv = (flat[t[2]] - flat[t[0]] - du * fx) * (1 / std::max(fy, 1e-12));
        const double conformal = std::hypot(du.x + dv.y, du.y - dv.x),
                     anti = std::hypot(du.x - dv.y, du.y + dv.x);
        ratios.push_back((conformal + anti) / std::max(std::abs(conformal - anti), 1e-12));
    }
    return ratios;
}

}  // namespace dermis::bust
