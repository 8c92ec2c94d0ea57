#include "dermis/reference/way_through_flesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dermis::inline reference {
namespace {

constexpr size_t kMostCrossings = 32;
constexpr float kNoWay = std::numeric_limits<float>::infinity();
// Cosine to a face up to which a direction runs along it, and sum of the normals of two walls below which
// they face each other so nearly that the direction of the bottom between them is not known.
constexpr float kGrazing = 0.02f, kParallel = 0.05f;
// How often the point at the bottom moves on from where it lies on one of the walls, and what part of the
// gap's width may then be left: at the bottom of a groove nothing is, between two bodies their distance.
constexpr int kMoves = 6;
constexpr float kClosed = 0.02f;

class FleshWays {
  public:
    FleshWays(const RayScene& rays, float longest_mm)
        : rays_(rays),
          boundary_(rays.has(RaySet::capped_cavities) ? RaySet::capped_cavities : RaySet::skin),
          longest_mm_(longest_mm),
          margin_mm_(10 * rays.epsilon_mm()) {}

    // `closed_mm`: the width below which a gap is crossed, 0 for the first one.
    [[nodiscard]] float length_mm(const SkinPoint& from, const SkinPoint& to, int moves,
                                  float closed_mm) const {
        const Vec3 offset_mm = to.p_mm - from.p_mm;
        const float distance_mm = length(offset_mm);
        if (distance_mm <= 2 * margin_mm_) return distance_mm;
        const Vec3 along = offset_mm * (1 / distance_mm);
        // Positive where it leaves and arrives through air; one that meets no face does both or neither.
        const float leaves = dot(along, from.n_face), arrives = -dot(along, to.n_face);
        if (std::abs(leaves) < kGrazing && std::abs(arrives) < kGrazing) return distance_mm;
        HitBuffer<kMostCrossings> buffer;
        const std::span<RayHit> crossed = crossings(from.p_mm, along, distance_mm, buffer.hits());
        const bool all_air = crossed.empty() && leaves + arrives > 2 * kGrazing;
        float way_mm = distance_mm;
        int bodies =
            all_air || (!crossed.empty() && leaves > 0) ? 0 : 1;  // around the segment; parts may overlap
        SkinPoint left = from;
        const auto enter = [&](const SkinPoint& at) {
            if (bodies++ > 0) return;
            const float width_mm = length(at.p_mm - left.p_mm);
            way_mm += around_mm(left, at, moves, closed_mm > 0 ? closed_mm : kClosed * width_mm) - width_mm;
        };
        for (const RayHit& hit : crossed) {
            const SkinPoint at = {from.p_mm + along * hit.distance_mm, hit.n_face};
            if (dot(hit.n_face, along) < 0)
                enter(at);
            else if (bodies > 0 && --bodies == 0)
                left = at;
        }
        if (all_air || (bodies == 0 && arrives > 0)) enter(to);
        return way_mm;
    }

  private:
    [[nodiscard]] std::span<RayHit> crossings(Vec3 from_mm, Vec3 along, float distance_mm,
                                              std::span<RayHit> hits) const {
        const Ray ray = {.origin_mm = from_mm,
                         .direction = along,
                         .min_mm = margin_mm_,
                         .max_mm = distance_mm - margin_mm_};
        const std::span<RayHit> found = hits.first(rays_.all_hits(boundary_, ray, hits));
        std::ranges::sort(found, {}, &RayHit::distance_mm);
        return found;
    }

    // Between two walls with air alone between them.
    [[nodiscard]] float around_mm(const SkinPoint& a, const SkinPoint& b, int moves, float closed_mm) const {
        const Vec3 out = a.n_face + b.n_face, middle_mm = (a.p_mm + b.p_mm) * 0.5f;
        const float width_mm = length(b.p_mm - a.p_mm), open = length(out);
        if (width_mm < closed_mm) return width_mm;
        if (moves == 0 || open < kParallel) return kNoWay;
        const Vec3 inward = out * (-1 / open);
        // A gap of rounding alone has its middle on a face.
        const Vec3 origin_mm = middle_mm - inward * margin_mm_;
        const auto bottom = rays_.closest_hit(
            boundary_, {.origin_mm = origin_mm, .direction = inward, .max_mm = longest_mm_});
        if (!bottom) return kNoWay;
        if (dot(bottom->n_face, inward) > 0) return width_mm;  // in flesh after all
        const SkinPoint at = {origin_mm + inward * bottom->distance_mm, bottom->n_face};
        const float first_mm = length_mm(a, at, moves - 1, closed_mm);
        return first_mm > longest_mm_ ? kNoWay : first_mm + length_mm(at, b, moves - 1, closed_mm);
    }

    const RayScene& rays_;
    RaySet boundary_;  // without cavities to close, all skin bounds the flesh
    float longest_mm_, margin_mm_;
};

}  // namespace

float way_through_flesh_mm(const RayScene& rays, const SkinPoint& from, const SkinPoint& to,
                           float longest_mm) {
    return FleshWays(rays, longest_mm).length_mm(from, to, kMoves, 0);
}

}  // namespace dermis::inline reference
