// Each chart is a bitmap of the cells that it touches, grown by half of the gap. Charts, the largest first,
// go where their top is lowest; the scale is found by bisection. For one y, a chart's runs of cells give all
// x that are blocked, 64 at a time.

#include "dermis/mesh/pack_charts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

#include "dermis/mesh/uv_texels.h"

namespace dermis::inline mesh {
namespace {

using Triangles = std::vector<std::array<Vec2, 3>>;

struct Bits {
    int width = 0, height = 0;
    std::vector<uint64_t> words = {};

    Bits(int w, int h) : width(w), height(h), words(size_t((w + 63) / 64) * size_t(h), 0) {}
    [[nodiscard]] size_t words_a_row() const { return size_t(width + 63) / 64; }
    [[nodiscard]] const uint64_t* row(int y) const { return &words[size_t(y) * words_a_row()]; }
    [[nodiscard]] bool at(int x, int y) const { return (row(y)[x / 64] >> (x % 64) & 1) != 0; }
    void set(int x, int y) { words[size_t(y) * words_a_row() + size_t(x) / 64] |= uint64_t(1) << (x % 64); }
    friend auto operator<=>(const Bits&, const Bits&) = default;
};

struct Run {
    int y, first, count;  // cells of a row
};

struct Shape {
    Bits bits;
    std::vector<Run> runs;
};

struct Place {
    int x = 0, y = 0, turns = 0, width = 0, height = 0;
};

struct Scratch {
    std::vector<uint64_t> blocked, smeared;
};

// to |= from >> shift; both may be one, as words are read before they are written.
void or_shifted(std::vector<uint64_t>& to, const std::vector<uint64_t>& from, int shift) {
    const auto skip = size_t(shift) / 64, bit = size_t(shift) % 64;
    for (size_t i = 0; i + skip < from.size(); ++i) {
        uint64_t word = from[i + skip] >> bit;
        if (bit > 0 && i + skip + 1 < from.size()) word |= from[i + skip + 1] << (64 - bit);
        to[i] |= word;
    }
}

// The lowest x of `side` at which the runs meet no taken cell when their first row is y; -1: none.
int free_x(const Bits& taken, const Shape& shape, int y, Scratch& scratch) {
    const size_t words = taken.words_a_row();
    scratch.blocked.assign(words, 0);
    for (const Run& run : shape.runs) {
        const uint64_t* row = taken.row(y + run.y);
        if (std::all_of(row, row + words, [](uint64_t word) { return word == 0; })) continue;
        scratch.smeared.assign(row, row + words);
        for (int have = 1; have < run.count;) {
            const int step = std::min(have, run.count - have);
            or_shifted(scratch.smeared, scratch.smeared, step);
            have += step;
        }
        or_shifted(scratch.blocked, scratch.smeared, run.first);
    }
    const std::vector<uint64_t>& blocked = scratch.blocked;
    for (int x = 0; x + shape.bits.width <= taken.width; ++x)
        if ((blocked[size_t(x) / 64] >> (x % 64) & 1) == 0) return x;
    return -1;
}

Bits grown(const Bits& bits, int by) {
    Bits result(bits.width, bits.height);
    for (int y = 0; y < bits.height; ++y)
        for (int x = 0; x < bits.width; ++x) {
            if (!bits.at(x, y)) continue;
            for (int to_y = std::max(y - by, 0); to_y <= std::min(y + by, bits.height - 1); ++to_y)
                for (int to_x = std::max(x - by, 0); to_x <= std::min(x + by, bits.width - 1); ++to_x)
                    result.set(to_x, to_y);
        }
    return result;
}

// The cells that the triangles touch, grown by `margin`; cell 0 begins `margin` before `low`.
Bits bits_of(const Triangles& triangles, Vec2 low, Vec2 high, float cells, int margin) {
    const Vec2 size = (high - low) * cells;
    Bits bits(int(std::floor(size.x)) + 1 + 2 * margin, int(std::floor(size.y)) + 1 + 2 * margin);
    for (const std::array<Vec2, 3>& triangle : triangles) {
        std::array<std::array<double, 2>, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 at = (triangle[k] - low) * cells + Vec2{float(margin), float(margin)};
            corners[k] = {double(at.x), double(at.y)};
        }
        visit_texels_of(corners, {bits.width, bits.height},
                        [&](int x, int y, double, double) { bits.set(x, y); });
        for (size_t k = 0; k < 3; ++k) {
            const auto &a = corners[k], &b = corners[(k + 1) % 3];
            const int steps = int(2 * std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]))) + 1;
            for (int i = 0; i <= steps; ++i) {
                const double t = double(i) / steps;
                bits.set(std::clamp(int(a[0] + t * (b[0] - a[0])), 0, bits.width - 1),
                         std::clamp(int(a[1] + t * (b[1] - a[1])), 0, bits.height - 1));
            }
        }
    }
    return margin > 0 ? grown(bits, margin) : bits;
}

// By 90 degrees: (x, y) becomes (y, width - 1 - x).
Bits turned(const Bits& bits) {
    Bits result(bits.height, bits.width);
    for (int y = 0; y < bits.height; ++y)
        for (int x = 0; x < bits.width; ++x)
            if (bits.at(x, y)) result.set(y, bits.width - 1 - x);
    return result;
}

std::vector<Run> runs_of(const Bits& bits) {
    std::vector<Run> runs;
    for (int y = 0; y < bits.height; ++y)
        for (int x = 0; x < bits.width;) {
            if (!bits.at(x, y)) {
                ++x;
                continue;
            }
            const int first = x;
            while (x < bits.width && bits.at(x, y)) ++x;
            runs.push_back({y, first, x - first});
        }
    return runs;
}

class Square {
  public:
    explicit Square(int side) : taken_(side, side) {}

    // False where it does not fit.
    bool place(Bits bits, Place& best) {
        int lowest_top = std::numeric_limits<int>::max();
        std::vector<Run> runs;
        for (int turns = 0; turns < 4; ++turns) {
            if (turns > 0) bits = turned(bits);
            Shape shape{bits, runs_of(bits)};
            // Equal shapes found no place below this one.
            int& y = first_y_[bits];
            for (int x = -1; y + bits.height <= std::min(taken_.height, lowest_top - 1); ++y) {
                x = free_x(taken_, shape, y, scratch_);
                if (x < 0) continue;
                best = {x, y, turns, bits.width, bits.height};
                lowest_top = y + bits.height, runs = std::move(shape.runs);
                break;
            }
        }
        for (const Run& run : runs)
            for (int x = run.first; x < run.first + run.count; ++x) taken_.set(best.x + x, best.y + run.y);
        return !runs.empty();
    }

  private:
    Bits taken_;
    Scratch scratch_;
    std::map<Bits, int> first_y_;
};

struct Chart {
    const Triangles* triangles;
    Vec2 low, high;
};

// Empty where they do not fit.
std::vector<Place> placed(std::span<const Chart> charts, std::span<const size_t> order, int side, float cells,
                          int margin) {
    Square square(side);
    std::vector<Place> places(charts.size());
    for (const size_t i : order) {
        const Chart& chart = charts[i];
        const Vec2 size = (chart.high - chart.low) * cells;
        if (!(std::max(size.x, size.y) + 1 + 2 * float(margin) <= float(side))) return {};
        if (!square.place(bits_of(*chart.triangles, chart.low, chart.high, cells, margin), places[i]))
            return {};
    }
    return places;
}

PackedChart packed(const Chart& chart, const Place& place, int side, float cells, int margin) {
    const float cell = 1 / float(side);
    // In cells; undone turn by turn.
    PackedChart result{Vec2{float(margin), float(margin)} - chart.low * cells, {cells, 0}, {0, cells}};
    int width = place.turns % 2 == 0 ? place.width : place.height;
    int height = place.turns % 2 == 0 ? place.height : place.width;
    for (int turn = 0; turn < place.turns; ++turn) {
        const auto direction = [](Vec2 v) { return Vec2{v.y, -v.x}; };
        result = {{result.origin.y, float(width) - result.origin.x},
                  direction(result.x_axis),
                  direction(result.y_axis)};
        std::swap(width, height);
    }
    return {(result.origin + Vec2{float(place.x), float(place.y)}) * cell, result.x_axis * cell,
            result.y_axis * cell};
}

}  // namespace

std::vector<PackedChart> pack_charts(std::span<const std::vector<std::array<Vec2, 3>>> charts, float gap) {
    constexpr float kPrecision = 1.01f;
    std::vector<Chart> all;
    std::vector<double> areas;
    for (const Triangles& triangles : charts) {
        Chart chart{&triangles, triangles[0][0], triangles[0][0]};
        double area = 0;
        for (const std::array<Vec2, 3>& triangle : triangles) {
            for (const Vec2 p : triangle) {
                chart.low = {std::min(chart.low.x, p.x), std::min(chart.low.y, p.y)};
                chart.high = {std::max(chart.high.x, p.x), std::max(chart.high.y, p.y)};
            }
            area += std::abs(double(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]))) / 2;
        }
        all.push_back(chart), areas.push_back(area);
    }
    std::vector<size_t> order(charts.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, std::greater<>(), [&](size_t i) { return areas[i]; });
    int side = 256;
    while (charts.size() * 64 > size_t(side) * size_t(side)) side *= 2;
    // Margins alone take a quarter of the square at most.
    const double most = side / std::sqrt(4.0 * double(std::max(charts.size(), size_t(1))));
    const int margin = std::min(int(std::lround(gap * float(side) / 2)), int((most - 1) / 2));
    const double area = std::max(std::accumulate(areas.begin(), areas.end(), 0.0), 1e-12);
    float high = float(double(side) / std::sqrt(area)), low = 0;
    std::vector<Place> best;
    for (low = high * 0.8f; low > high * 1e-6f; low *= 0.8f) {
        best = placed(all, order, side, low, margin);
        if (!best.empty()) break;
        high = low;
    }
    while (high > low * kPrecision) {
        const float cells = std::sqrt(low * high);
        std::vector<Place> places = placed(all, order, side, cells, margin);
        (places.empty() ? high : low) = cells;
        if (!places.empty()) best = std::move(places);
    }
    std::vector<PackedChart> result;
    for (size_t i = 0; i < best.size(); ++i) result.push_back(packed(all[i], best[i], side, low, margin));
    return result;
}

}  // namespace dermis::inline mesh
