// The skyline is the upper border of what is placed, as steps from left to right. Each rectangle, the tallest
// first, goes where its top is lowest; the scale is found by bisection.

#include "dermis/mesh/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace dermis::inline mesh {
namespace {

struct Step {
    float x, width, y;
};

// The lowest y at which a rectangle of this width can lie with its left side at step `first`.
float height_at(const std::vector<Step>& skyline, size_t first, float width) {
    if (skyline[first].x + width > 1) return std::numeric_limits<float>::infinity();
    float y = 0, left = width;
    for (size_t i = first; left > 0 && i < skyline.size(); ++i) {
        y = std::max(y, skyline[i].y);
        left -= skyline[i].width;
    }
    return y;
}

void raise(std::vector<Step>& skyline, size_t first, float width, float y) {
    const float x = skyline[first].x, right = x + width;
    std::vector<Step> raised(skyline.begin(), skyline.begin() + std::ptrdiff_t(first));
    raised.push_back({x, width, y});
    for (size_t i = first; i < skyline.size(); ++i) {
        const float end = skyline[i].x + skyline[i].width;
        if (end <= right) continue;
        const float begin = std::max(skyline[i].x, right);
        raised.push_back({begin, end - begin, skyline[i].y});
    }
    skyline = std::move(raised);
}

// Empty where they do not fit.
std::vector<PackedRectangle> placed(std::span<const Vec2> sides, std::span<const size_t> order, float scale,
                                    float gap) {
    std::vector<Step> skyline = {{0, 1, 0}};
    std::vector<PackedRectangle> rectangles(sides.size());
    for (const size_t i : order) {
        struct {
            float top = std::numeric_limits<float>::infinity(), width = 0;
            size_t step = 0;
            bool is_turned = false;
        } best;
        for (const bool is_turned : {false, true}) {
            const Vec2 side = is_turned ? Vec2{sides[i].y, sides[i].x} : sides[i];
            const float width = side.x * scale + gap, height = side.y * scale + gap;
            for (size_t step = 0; step < skyline.size(); ++step) {
                const float top = height_at(skyline, step, width) + height;
                if (top < best.top) best = {top, width, step, is_turned};
            }
        }
        if (best.top > 1) return {};
        const float height = (best.is_turned ? sides[i].x : sides[i].y) * scale + gap;
        rectangles[i] = {{skyline[best.step].x + gap / 2, best.top - height + gap / 2}, best.is_turned};
        raise(skyline, best.step, best.width, best.top);
    }
    return rectangles;
}

}  // namespace

Packing pack_rectangles(std::span<const Vec2> sides, float gap) {
    constexpr float kPrecision = 1.01f;
    std::vector<size_t> order(sides.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](size_t i) { return std::max(sides[i].x, sides[i].y); });
    float area = 0, longest = 0;
    for (const Vec2 side : sides) area += side.x * side.y, longest = std::max({longest, side.x, side.y});
    if (!(area > 0)) return {};
    float high = std::min(1 / std::sqrt(area), (1 - gap) / longest), low = 0;
    Packing best;
    // The gap alone fits where it is small against the count; half of the bound is then near.
    for (float scale = high; scale > high * 1e-4f; scale *= 0.7f) {
        best = {scale, placed(sides, order, scale, gap)};
        if (!best.rectangles.empty()) break;
        high = scale;
    }
    for (low = best.scale; high > low * kPrecision;) {
        const float scale = std::sqrt(low * high);
        std::vector<PackedRectangle> rectangles = placed(sides, order, scale, gap);
        if (rectangles.empty()) {
            high = scale;
            continue;
        }
        low = scale, best = {scale, std::move(rectangles)};
    }
    return best;
}

}  // namespace dermis::inline mesh
