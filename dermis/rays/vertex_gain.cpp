#include "dermis/rays/vertex_gain.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/mesh/blur_vertices.h"
#include "dermis/mesh/curvature.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/flesh_boundary.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/rays/vertex_occlusion.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline rays {
namespace {

constexpr int kFlatWalks = 3 << 17;
constexpr size_t kTrianglesPerTask = 64;
constexpr double kMostWalksPerTriangle = 1 << 20;

struct WalkTask {
    const RayScene* rays;
    WalkMedium medium;
    WalkGuide guide;
    Vec3 per_flat;                                  // one over what flat skin returns
    std::span<const std::vector<float>> occlusion;  // one array an object, one value a vertex
};

// Of one object: what its walks need, and what they gave.
struct ObjectWalks {
    const Mesh* mesh;
    size_t number;                        // in the scene
    std::vector<uint32_t> walks;          // of each triangle
    std::vector<Vec3> prior;              // gain by curvature at the vertices
    std::vector<SurfaceSamples> samples;  // returned light less the prior
};

// Less than this share of a uniform sky arrives at places that are hidden: behind lids, in nostrils. They are
// darker than the rest by any light.
constexpr float kHiddenShare = 0.3f;

// What is more curved is an edge rather than a ball. There the prior is wrong, and the blur keeps a part of
// its error.
constexpr double kMostPriorCurvaturePerMm = 0.12;

std::vector<CurvatureTensor> curvatures_of(const Mesh& mesh) {
    return mesh.curvatures_per_mm.size() == mesh.positions_mm.size()
               ? mesh.curvatures_per_mm
               : compute_curvature_tensors(mesh, kCurvatureSmoothingMm);
}

std::vector<Vec3> gains_by_curvature(std::span<const CurvatureTensor> tensors, const GainForm& form) {
    std::vector<Vec3> gains;
    gains.reserve(tensors.size());
    for (const CurvatureTensor& tensor : tensors) {
        const double h =
            std::clamp(double(mean_curvature(tensor)), -kMostPriorCurvaturePerMm, kMostPriorCurvaturePerMm);
        gains.push_back(to_vec3({gain(form, 0, h), gain(form, 1, h), gain(form, 2, h)}));
    }
    return gains;
}

double walked_area_mm2(const Mesh& mesh, const std::vector<bool>& walked) {
    double area = 0;
    for (size_t t = 0; t < walked.size(); ++t)
        if (walked[t]) area += double(triangle_area_mm2(mesh, uint32_t(t)));
    return area;
}

// One walk at least on each triangle, so that no part of the skin is without samples.
std::vector<uint32_t> walks_of(const Mesh& mesh, const std::vector<bool>& walked, double per_mm2) {
    std::vector<uint32_t> walks(walked.size());
    for (size_t t = 0; t < walked.size(); ++t) {
        if (!walked[t]) continue;
        const double wanted = double(triangle_area_mm2(mesh, uint32_t(t))) * per_mm2;
        walks[t] = uint32_t(std::clamp(std::ceil(wanted), 1.0, kMostWalksPerTriangle));
    }
    return walks;
}

// Barycentric weights of a point that is uniform on the triangle.
std::array<float, 3> uniform_weights(Vec2 place) {
    const float root = std::sqrt(place.x);
    return {1 - root, root * (1 - place.y), root * place.y};
}

// Light at a place of a triangle: 1, or less where it is hidden.
float light_at(std::span<const float> occlusion, const Mesh& mesh, size_t triangle,
               const std::array<float, 3>& weights) {
    float share = 0;
    for (size_t k = 0; k < 3; ++k) share += weights[k] * occlusion[mesh.indices[3 * triangle + k]];
    return std::clamp(share / kHiddenShare, 1e-3f, 1.0f);
}

// The light where a walk ends over the light where it starts. More does not count: a technique blurs that.
float light_at_end(const WalkTask& task, const RayHit& end, float at_start) {
    if (end.object == kCapObject) return 1;
    const float at_end = light_at(task.occlusion[end.object], task.rays->mesh(end.object), end.triangle,
                                  {1 - end.u - end.v, end.u, end.v});
    return std::min(1.0f, at_end / at_start);
}

void walk_triangle(const WalkTask& task, size_t t, uint32_t seed, ObjectWalks& object) {
    const std::vector<float>& occlusion = task.occlusion[object.number];
    const auto [a, b, c] = corners_mm(*object.mesh, uint32_t(t));
    const uint32_t* corner = &object.mesh->indices[3 * t];
    const Vec3 n = face_normal(*object.mesh, uint32_t(t));
    const float share_mm2 = triangle_area_mm2(*object.mesh, uint32_t(t)) / float(object.walks[t]);
    const uint32_t first = hash_u32(seed, 1);
    for (uint32_t i = 0; i < object.walks[t]; ++i) {
        Pcg32 random(seed, i);
        const auto weights = uniform_weights(random.next_2d());
        const Vec3 p_mm = a * weights[0] + b * weights[1] + c * weights[2];
        const Vec3 start = sample_entry_direction(n, task.medium.eta, random);
        // Flat skin is the control variate.
        FleshBoundary boundary(*task.rays);
        auto [end, flat] = guided_walk_and_flat(task.medium, task.guide, boundary, p_mm, n, start,
                                                golden_1d(first, i), random);
        const float light = light_at(occlusion, *object.mesh, t, weights);
        if (end.throughput != Vec3{})
            end.throughput = end.throughput * light_at_end(task, boundary.last(), light);
        Vec3 value = Vec3{1, 1, 1} + (end.throughput - flat.throughput) * task.per_flat;
        for (size_t k = 0; k < 3; ++k) value -= object.prior[corner[k]] * weights[k];
        // Hidden skin has no light to multiply, so its gain may follow that of the skin around it.
        object.samples[t].add(weights, share_mm2 * light, value, (first / 3 + i) % 2 != 0);
    }
}

void walk_object(const WalkTask& task, uint32_t seed, ObjectWalks& object, Progress& progress) {
    object.samples.resize(object.walks.size());
    parallel_for(object.walks.size(), kTrianglesPerTask, [&](size_t begin, size_t end) {
        size_t walked = 0;
        for (size_t t = begin; t < end; ++t) {
            if (object.walks[t] > 0) walk_triangle(task, t, hash_u32(seed, uint32_t(t)), object);
            walked += object.walks[t];
        }
        progress.advance(walked);
    });
}

// Adds to the sums over the skin of area * noise^2 and of area.
void add_squares(const ObjectWalks& object, std::span<const Vec3> noise, Vec3& squares, double& area) {
    for (size_t t = 0; t < object.walks.size(); ++t) {
        if (object.walks[t] == 0) continue;
        const float a = triangle_area_mm2(*object.mesh, uint32_t(t));
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 d = noise[object.mesh->indices[3 * t + k]];
            squares += d * d * (a / 3);
        }
        area += double(a);
    }
}

std::vector<Vec3> gains_of(const ObjectWalks& object, std::vector<Vec3> gains) {
    std::vector<bool> has_skin(gains.size());
    for (size_t i = 0; i < object.mesh->indices.size(); ++i)
        if (object.walks[i / 3] > 0) has_skin[object.mesh->indices[i]] = true;
    for (size_t i = 0; i < gains.size(); ++i) {
        const Vec3 sum = gains[i] + object.prior[i];
        gains[i] = has_skin[i] ? Vec3{std::max(sum.x, 0.0f), std::max(sum.y, 0.0f), std::max(sum.z, 0.0f)}
                               : Vec3{1, 1, 1};
    }
    return gains;
}

using Curvatures = std::vector<std::vector<CurvatureTensor>>;  // one array an object

Result<std::vector<ObjectWalks>> planned(std::span<const SceneObject> objects, const Curvatures& curvatures,
                                         std::span<const Flesh> flesh, const GainForm& form,
                                         const VertexGainSettings& settings) {
    std::vector<std::vector<bool>> walked;
    double area = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        walked.push_back(walked_triangles(objects[i], flesh[i]));
        area += walked_area_mm2(objects[i].mesh, walked.back());
    }
    if (!(area > 0)) return Error{kNoWalkedSkin};
    const double per_mm2 = std::max(double(settings.walks_per_mm2), settings.least_walks / area);
    std::vector<ObjectWalks> planned;
    for (size_t i = 0; i < objects.size(); ++i) {
        const Mesh& mesh = objects[i].mesh;
        planned.push_back({.mesh = &mesh,
                           .number = i,
                           .walks = walks_of(mesh, walked[i], per_mm2),
                           .prior = gains_by_curvature(curvatures[i], form),
                           .samples = {}});
    }
    return planned;
}

Result<VertexGains> walk(std::span<const SceneObject> objects, const Curvatures& curvatures,
                         const ScatteringMedium& medium, const VertexGainSettings& settings) {
    DERMIS_TRY_ASSIGN(const std::vector<Flesh> flesh, find_flesh(objects));
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(objects, flesh));
    DERMIS_TRY_ASSIGN(std::vector<ObjectWalks> all,
                      planned(objects, curvatures, flesh, walked_gain_form(medium), settings));
    DERMIS_TRY_ASSIGN(const std::vector<std::vector<float>> occlusion, compute_vertex_occlusion(objects));
    const Vec3 flat = guided_half_space_albedo(medium, kFlatWalks, 1).mean;
    const auto inverse = [](float x) { return x > 0 ? 1 / x : 0.0f; };
    const WalkTask task = {.rays = &rays,
                           .medium = walk_medium(medium),
                           .guide = walk_guide_of_pairs(medium),
                           .per_flat = {inverse(flat.x), inverse(flat.y), inverse(flat.z)},
                           .occlusion = occlusion};
    size_t total = 0;
    for (const ObjectWalks& object : all)
        for (const uint32_t walks : object.walks) total += walks;
    Progress progress("gain by walks", total);
    VertexGains made;
    Vec3 squares;
    double area = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        walk_object(task, hash_u32(uint32_t(i), 7), all[i], progress);
        DERMIS_TRY_ASSIGN(FitWithoutNoise fit, fit_without_noise(*all[i].mesh, all[i].samples));
        made.gains.push_back(gains_of(all[i], std::move(fit.values)));
        add_squares(all[i], fit.noise, squares, area);
    }
    const auto noise = [&](float square) { return float(std::sqrt(double(square) / area)); };
    made.noise = {noise(squares.x), noise(squares.y), noise(squares.z)};
    return made;
}

Result<void> check_settings(const VertexGainSettings& s) {
    if (!(s.walks_per_mm2 >= 0.1f && s.walks_per_mm2 <= 10000))
        return Error{"walks per mm^2 are " + to_text(s.walks_per_mm2) + ", not within 0.1..10000"};
    return {};
}

}  // namespace

Result<VertexGains> walk_vertex_gains(std::span<const SceneObject> objects, const ScatteringMedium& medium,
                                      const VertexGainSettings& settings) {
    DERMIS_TRY(check_settings(settings));
    Hasher hasher;
    hasher.add(std::string_view("fit without noise"));  // another way to fit is another word here
    hasher.add(rays_version()).add(medium.g).add(medium.eta);
    for (size_t c = 0; c < 3; ++c) hasher.add(medium.sigma_s_per_mm[c]).add(medium.sigma_a_per_mm[c]);
    hasher.add(settings.walks_per_mm2).add(settings.least_walks);
    VertexGains blank;
    Curvatures curvatures;
    for (const SceneObject& object : objects) {
        curvatures.push_back(curvatures_of(object.mesh));
        add_shape(hasher, object);
        hasher.add(curvatures.back());
        blank.gains.emplace_back(object.mesh.positions_mm.size());
    }
    return cached(
        "vertex_gain", hasher.hex(), std::move(blank),
        [&] { return walk(objects, curvatures, medium, settings); },
        [](VertexGains& gains) { return std::tie(gains.gains, gains.noise); });
}

}  // namespace dermis::inline rays
