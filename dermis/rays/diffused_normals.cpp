// Each Gaussian is summed over points of the skin that lie a part of its width apart, at these points only:
// its result is smooth. From the points of the widest the sums are interpolated at those of the next, and so
// on down to the texels. Merging and interpolating blur too; the Gaussians are narrower by that.

#include "dermis/rays/diffused_normals.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/rays/diffused_normals_texel.h"
#include "dermis/rays/skin_points.h"
#include "dermis/scene/scene_hash.h"
#include "dermis/scene/wrinkles.h"

namespace dermis::inline rays {
namespace {

constexpr int kProfileSteps = 2048;
// Of the narrowest Gaussian's standard deviation: the side of the cubes over which points are merged, and how
// much wider the others of the same points may be.
constexpr float kSide = 0.6f, kWidest = 1.5f;
constexpr float kReach = 3.2f;        // of a Gaussian's standard deviation
constexpr float kKernel = 2.1f;       // radius of the interpolation, of the points' cubes
constexpr float kLeastCube = 4;       // in texels: to find a cube takes longer than to pass over some points
constexpr size_t kSampledCubes = 16;  // one in so many, to measure a mean
// Cosine of the normals of two walls that no way through air may join. The head scan's share under its key
// light, by the sum of the shadowed light over its texels with this kernel: without the rule .69, at 0 .83,
// at this .85.
constexpr float kSameWall = 0.7f;

using Float4 = float __attribute__((vector_size(16)));
Float4 float4(float first, Vec3 rest) {
    return Float4{first, rest.x, rest.y, rest.z};
}

// Of red and green the integral of the profile, and of the profile times the normal; of red the profile times
// the products of the normal's parts.
struct Sums {
    Float4 red = {}, green = {};      // weight, normal
    Float4 squares = {}, mixed = {};  // 0, xx, yy, zz; 0, yz, xz, xy

    void add(const Sums& other, float part) {
        red += other.red * part;
        green += other.green * part;
        squares += other.squares * part;
        mixed += other.mixed * part;
    }
};
// R of red and green over the squared distance.
using Steps = std::vector<std::array<float, 2>>;
struct PartOfProfile {
    const Steps* steps;
    float squared_reach_mm2, steps_per_mm2, scale;
};
// The Gaussians of one set of points.
struct SetOfGaussians {
    Steps steps;
    float variance_mm2 = 0;  // of the narrowest
    float squared_reach_mm2 = 0;

    [[nodiscard]] float reach_mm() const { return std::sqrt(squared_reach_mm2); }
    // The same curve, drawn together, so that the narrowest Gaussian's variance is less by blurred_mm2.
    [[nodiscard]] PartOfProfile narrowed_by(float blurred_mm2) const {
        const float part = std::max(1 - blurred_mm2 / variance_mm2, 0.25f);
        return {&steps, squared_reach_mm2 * part, kProfileSteps / (squared_reach_mm2 * part), 1 / part};
    }
};
// A point as a sum reads it.
struct Source {
    Vec3 p_mm, n_geometry;
    Float4 mass, squares, mixed;  // times its area; mass: 1, n

    explicit Source(const SkinPoint& point)
        : p_mm(point.p_mm),
          n_geometry(point.n_geometry),
          mass(float4(1, point.n) * point.area_mm2),
          squares(float4(0, point.squares) * point.area_mm2),
          mixed(float4(0, point.mixed) * point.area_mm2) {}
};

struct Reached {
    uint32_t number;
    float squared_mm2;
};

Rgb totals(const GaussianSum& profile) {
    Rgb total = total_weight(profile.terms);
    for (double& sum : total) sum = sum > 0 ? sum : 1;
    return total;
}

// Of red and green: what the Gaussians that the map does not hold have of the profile.
Vec2 narrow_weights(const GaussianSum& profile, float finest_mm2) {
    std::array<double, 2> narrow = {};
    const Rgb total = totals(profile);
    for (const GaussianTerm& term : profile.terms)
        if (term.variance_mm2 < double(finest_mm2))
            for (size_t c = 0; c < 2; ++c) narrow[c] += term.weight[c] / total[c];
    return {float(narrow[0]), float(narrow[1])};
}

// Sets of Gaussians of about one width, from narrow to wide.
std::vector<std::vector<GaussianTerm>> sets_of_gaussians(const GaussianSum& profile, float finest_mm2) {
    std::vector<GaussianTerm> terms;
    for (const GaussianTerm& term : profile.terms)
        if (term.variance_mm2 >= double(finest_mm2)) terms.push_back(term);
    std::ranges::sort(terms, {}, &GaussianTerm::variance_mm2);
    std::vector<std::vector<GaussianTerm>> sets;
    for (const GaussianTerm& term : terms) {
        if (sets.empty() || term.variance_mm2 > double(kWidest * kWidest) * sets.back()[0].variance_mm2)
            sets.emplace_back();
        sets.back().push_back(term);
    }
    return sets;
}

// That of a Gaussian which is cut off at the reach and has this one then.
double uncut_variance_mm2(double variance_mm2, double squared_reach_mm2) {
    double uncut = variance_mm2;
    for (int i = 0; i < 12; ++i) {
        const double x = 0.5 * squared_reach_mm2 / uncut;
        uncut = variance_mm2 / (1 - x / std::expm1(x));
    }
    return uncut;
}

// `blurred_mm2` is left out of each Gaussian's variance.
SetOfGaussians set_of_gaussians(const std::vector<GaussianTerm>& terms, const Rgb& total,
                                double blurred_mm2) {
    const auto left_mm2 = [&](const GaussianTerm& term) {
        return std::max(term.variance_mm2 - blurred_mm2, 0.25 * term.variance_mm2);
    };
    const double squared_reach_mm2 = double(kReach * kReach) * left_mm2(terms.back());
    SetOfGaussians made{.steps = {},
                        .variance_mm2 = float(left_mm2(terms.front())),
                        .squared_reach_mm2 = float(squared_reach_mm2)};
    for (int i = 0; i <= kProfileSteps + 1; ++i) {
        const double squared_mm2 = double(i) / kProfileSteps * squared_reach_mm2;
        std::array<float, 2> r = {};
        for (const GaussianTerm& term : terms) {
            const double variance_mm2 = uncut_variance_mm2(left_mm2(term), squared_reach_mm2);
            const double whole = -std::expm1(-0.5 * squared_reach_mm2 / variance_mm2);
            for (size_t c = 0; c < 2; ++c)
                r[c] += float(term.weight[c] / total[c] / (2 * std::numbers::pi * variance_mm2 * whole) *
                              std::exp(-0.5 * squared_mm2 / variance_mm2));
        }
        made.steps.push_back(r);
    }
    return made;
}

// Adds what the sources of one cube give. Those in reach are listed first, without a branch that the
// processor would guess wrong for every third.
void add(Sums& sums, std::span<const Source> cube, const SkinPoint& to, const PartOfProfile& profile,
         std::vector<Reached>& reached) {
    reached.resize(std::max(reached.size(), cube.size() + 1));
    size_t count = 0;
    for (size_t i = 0; i < cube.size(); ++i) {
        const Vec3 way_mm = cube[i].p_mm - to.p_mm;
        const float squared_mm2 = dot(way_mm, way_mm);
        reached[count] = {uint32_t(i), squared_mm2};
        count += size_t(squared_mm2 < profile.squared_reach_mm2);
    }
    for (const Reached& one : std::span(reached).first(count)) {
        const Source& from = cube[one.number];
        const Vec3 way_mm = from.p_mm - to.p_mm;
        const bool leaves = dot(way_mm, to.n_geometry) > 0, enters = dot(way_mm, from.n_geometry) < 0;
        const bool other_wall = dot(to.n_geometry, from.n_geometry) < kSameWall;
        if (int(leaves) & int(enters) & int(other_wall)) continue;
        const auto& [red, green] = (*profile.steps)[size_t(one.squared_mm2 * profile.steps_per_mm2 + 0.5f)];
        sums.red += from.mass * red;
        sums.green += from.mass * green;
        sums.squares += from.squares * red;
        sums.mixed += from.mixed * red;
    }
}

// Adds to the sums of each point what all points give.
void gather(const SkinPoints& skin, const SetOfGaussians& set, std::span<Sums> sums, Progress& progress) {
    const std::vector<Source> sources(skin.points().begin(), skin.points().end());
    skin.for_each_cube(skin, set.reach_mm(), 1, [&](const SkinCube& cube, SkinPoints::Near near) {
        std::vector<Reached> reached;
        float merged_mm2 = 0;
        for (const SkinPoint& point : cube.points) merged_mm2 += point.variance_mm2;
        const PartOfProfile profile = set.narrowed_by(merged_mm2 / float(cube.points.size()));
        for (size_t i = 0; i < cube.points.size(); ++i) {
            const SkinPoint& to = cube.points[i];
            Sums sum;
            for (const SkinCube* other : near)
                if (other->squared_distance_mm2(to.p_mm) < profile.squared_reach_mm2)
                    add(sum, std::span(sources).subspan(other->first, other->points.size()), to, profile,
                        reached);
            sums[cube.first + i].add(sum, profile.scale);
        }
        progress.advance(cube.points.size());
    });
}

struct Neighbour {
    size_t number;
    float weight, u, v;
    float squared_mm2;
};

// The points around `to`, with weights whose sum is 1: their weighted mean is exact for what changes evenly
// along the surface (moving least squares, first order).
void find_neighbours(const SkinPoints& points, std::span<const SkinCube* const> near, float radius_mm,
                     const SkinPoint& to, std::vector<Neighbour>& found) {
    const Vec3 n = to.n_geometry;
    const Vec3 u = normalize(std::abs(n.x) < 0.7f ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
    const Vec3 v = cross(n, u);
    const float squared_radius_mm2 = radius_mm * radius_mm;
    Vec2 mean;
    float total = 0, uu = 0, uv = 0, vv = 0;
    found.clear();
    for (const SkinCube* cube : near) {
        if (cube->squared_distance_mm2(to.p_mm) >= squared_radius_mm2) continue;
        for (const SkinPoint& point : cube->points) {
            const Vec3 way_mm = point.p_mm - to.p_mm;
            const float squared_mm2 = dot(way_mm, way_mm);
            if (squared_mm2 >= squared_radius_mm2 || dot(point.n_geometry, n) <= 0) continue;
            const float x = 1 - squared_mm2 / squared_radius_mm2;
            const Neighbour one{points.number_of(point), x * x, dot(way_mm, u), dot(way_mm, v), squared_mm2};
            found.push_back(one);
            total += one.weight;
            mean = mean + Vec2{one.u, one.v} * one.weight;
            uu += one.weight * one.u * one.u;
            uv += one.weight * one.u * one.v;
            vv += one.weight * one.v * one.v;
        }
    }
    const float area = uu * vv - uv * uv;
    Vec2 slope;
    if (area > 1e-3f * (uu + vv) * (uu + vv))
        slope = {(uv * mean.y - vv * mean.x) / area, (uv * mean.x - uu * mean.y) / area};
    // No weight below 0.
    const float steepest = length(slope) * radius_mm;
    if (steepest > 1) slope = slope * (1 / steepest);
    total += slope.x * mean.x + slope.y * mean.y;
    for (Neighbour& one : found) one.weight *= (1 + slope.x * one.u + slope.y * one.v) / total;
}

// Adds to the sums at `skin` those at coarser points.
void interpolate(const SkinPoints& coarse, std::span<const Sums> from, float radius_mm,
                 const SkinPoints& skin, std::span<Sums> sums) {
    skin.for_each_cube(coarse, radius_mm, 1, [&](const SkinCube& cube, SkinPoints::Near near) {
        std::vector<Neighbour> found;
        for (size_t i = 0; i < cube.points.size(); ++i) {
            find_neighbours(coarse, near, radius_mm, cube.points[i], found);
            for (const Neighbour& one : found) sums[cube.first + i].add(from[one.number], one.weight);
        }
    });
}

// The variance along an axis by which interpolate() blurs, from some of the points.
double interpolation_blur_mm2(const SkinPoints& coarse, float radius_mm, const SkinPoints& skin) {
    std::vector<std::array<double, 2>> of_cube(skin.cube_count());
    skin.for_each_cube(coarse, radius_mm, kSampledCubes, [&](const SkinCube& cube, SkinPoints::Near near) {
        std::vector<Neighbour> found;
        find_neighbours(coarse, near, radius_mm, cube.points[0], found);
        auto& [area, sum] = of_cube[skin.cube_number_of(cube)];
        for (const SkinPoint& point : cube.points) area += double(point.area_mm2);
        for (const Neighbour& one : found) sum += 0.5 * area * double(one.weight * one.squared_mm2);
    });
    double area = 0, sum = 0;
    for (const auto& [of_area, of_sum] : of_cube) area += of_area, sum += of_sum;
    return area > 0 ? sum / area : 0;
}

// Of each texel.
std::vector<Sums> summed(const SkinTexels& skin, const GaussianSum& profile, float finest_mm2) {
    const auto sets = sets_of_gaussians(profile, finest_mm2);
    std::vector<Sums> of_texel(skin.texels.size());
    if (sets.empty() || skin.texels.empty()) return of_texel;
    const auto side_mm = [&](size_t i) { return kSide * float(std::sqrt(sets[i][0].variance_mm2)); };
    const float least_cube_mm = kLeastCube * typical_texel_mm(skin);
    const SkinPoints texels(skin.texels, std::max(2 * side_mm(0), least_cube_mm));
    std::vector<SkinPoints> points;
    points.reserve(sets.size());
    std::vector<double> blurred_mm2;
    double interpolated_mm2 = 0;
    for (size_t i = 0; i < sets.size(); ++i) {
        const SkinPoints& finer = i == 0 ? texels : points[i - 1];
        const float reach_mm = kReach * float(std::sqrt(sets[i].back().variance_mm2));
        points.emplace_back(finer, side_mm(i), std::max(0.75f * reach_mm, least_cube_mm));
        interpolated_mm2 += interpolation_blur_mm2(points[i], kKernel * side_mm(i), finer);
        blurred_mm2.push_back(interpolated_mm2);
    }
    size_t total = 0;
    for (const SkinPoints& of_set : points) total += of_set.points().size();
    Progress progress("normals over the skin's atlas", total);
    std::vector<Sums> sums, finer_sums;
    for (size_t i = sets.size(); i-- > 0;) {
        sums.assign(points[i].points().size(), {});
        if (i + 1 < sets.size())
            interpolate(points[i + 1], finer_sums, kKernel * side_mm(i + 1), points[i], sums);
        gather(points[i], set_of_gaussians(sets[i], totals(profile), blurred_mm2[i]), sums, progress);
        finer_sums.swap(sums);
    }
    sums.assign(skin.texels.size(), {});
    interpolate(points[0], finer_sums, kKernel * side_mm(0), texels, sums);
    for (size_t i = 0; i < sums.size(); ++i) of_texel[texels.order()[i]] = sums[i];
    return of_texel;
}

// p and q of the spread around its mean.
Vec2 unevenness(const Sums& sums) {
    if (sums.red[0] <= 0) return {};
    const auto part = [&](Float4 of) { return Vec3{of[1], of[2], of[3]} * (1 / sums.red[0]); };
    const Vec3 mean = part(sums.red), s = part(sums.squares), m = part(sums.mixed);
    const SpreadFrame frame(normalize(mean));
    const auto spread = [&](Vec3 a, Vec3 b) {
        return s.x * a.x * b.x + s.y * a.y * b.y + s.z * a.z * b.z + m.x * (a.y * b.z + a.z * b.y) +
               m.y * (a.x * b.z + a.z * b.x) + m.z * (a.x * b.y + a.y * b.x) - dot(mean, a) * dot(mean, b);
    };
    const float xx = spread(frame.x, frame.x), zz = spread(frame.z, frame.z), xz = spread(frame.x, frame.z);
    const float half = std::max(0.5f * (xx + zz), 1e-7f);
    return {std::clamp(0.5f * (xx - zz) / half, -1.0f, 1.0f), std::clamp(xz / half, -1.0f, 1.0f)};
}

// Such that its mix with the pixel's own normal, by the weights that the profile has over a plane, is the
// mean over this surface: more of the wide Gaussians where there is more skin around the point.
Vec3 stored_mean(Float4 sums, Vec3 n_own, float narrow_weight) {
    if (narrow_weight > 1 - 1e-4f || sums[0] <= 0) return n_own;
    const Vec3 sum = n_own * narrow_weight + Vec3{sums[1], sums[2], sums[3]};
    return (sum * (1 / (narrow_weight + sums[0])) - n_own * narrow_weight) * (1 / (1 - narrow_weight));
}

DiffusedNormals bake(const SkinTexelReader& reader, const GaussianSum& profile,
                     const DiffusedNormalsRequest& request) {
    const SkinTexels skin = reader.read(request.size);
    const std::vector<Sums> sums_of = summed(skin, profile, request.finest_variance_mm2);
    const Vec2 narrow = narrow_weights(profile, request.finest_variance_mm2);
    Image red(request.size, request.size, 4), green(request.size, request.size, 4);
    parallel_for(skin.texels.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const SkinTexel& texel = skin.texels[i];
            const Sums& sums = sums_of[i];
            const Vec2 uneven = unevenness(sums);
            const Vec3 r = stored_mean(sums.red, texel.n, narrow.x),
                       g = stored_mean(sums.green, texel.n, narrow.y);
            const Vec4 values[] = {{r.x, r.y, r.z, uneven.x}, {g.x, g.y, g.z, uneven.y}};
            std::memcpy(&red.floats()[4 * size_t(texel.index)], &values[0], sizeof values[0]);
            std::memcpy(&green.floats()[4 * size_t(texel.index)], &values[1], sizeof values[1]);
        }
    });
    return encoded_normals(std::move(red), std::move(green), skin.coverage);
}

Result<std::string> content_hash(const Scene& scene, const GaussianSum& profile,
                                 const DiffusedNormalsRequest& request) {
    Hasher hasher;
    hasher.add("diffused normals 9").add(request.size).add(request.finest_variance_mm2);
    for (const GaussianTerm& term : profile.terms)
        hasher.add(std::as_bytes(std::span(&term.variance_mm2, 1)))
            .add(std::as_bytes(std::span(term.weight)));
    for (const SceneObject& object : scene.objects) {
        add_shape(hasher, object);
        hasher.add(object.mesh.tangents).add(object.mesh.uvs);
        if (!object.mesh.atlas_uvs.empty()) hasher.add(object.mesh.atlas_uvs);
        for (const Material& material : object.mesh.materials) {
            hasher.add(material.normal_space).add(material.normal_scale).add(material.dilate_texels);
            DERMIS_TRY(add_image(hasher, material.normal_map));
        }
        DERMIS_TRY(add_wrinkles(hasher, object));
    }
    return hasher.hex();
}

}  // namespace

Result<DiffusedNormals> bake_diffused_normals(const Scene& scene, const GaussianSum& profile,
                                              const DiffusedNormalsRequest& request) {
    DERMIS_TRY_ASSIGN(const std::string hash, content_hash(scene, profile, request));
    const std::vector<DiffusedNormals::Texel> texels(size_t(request.size) * size_t(request.size));
    return cached(
        "diffused_normals", hash, DiffusedNormals{.size = request.size, .red = texels, .green = texels},
        [&]() -> Result<DiffusedNormals> {
            DERMIS_TRY_ASSIGN(const SkinTexelReader reader, SkinTexelReader::create(scene));
            return bake(reader, profile, request);
        },
        [](auto& normals) { return std::tie(normals.red, normals.green); });
}

}  // namespace dermis::inline rays
