#include "dermis/rays/vertex_links.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/rays/flesh_boundary.h"
#include "dermis/rays/gaussian_probe.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/rays/linked_object.h"
#include "dermis/rays/random.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/sampling.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline rays {
namespace {

constexpr int kFlatLinkWalks = 3 << 17;
constexpr size_t kRowsPerTask = 64;
constexpr int kSmoothings = 2, kFarSmoothings = 2;
// Farther, or on skin that faces away, light comes through the body: few walks bring it, and it changes
// slowly.
constexpr float kNearMm = 8;
constexpr float kLeastCosine = 0.1f;  // of a surface to the ray that finds it
// Beyond the least number, links of a row may be merged into others while the sum of their absolute weights,
// over the channels, is within these.
constexpr float kMergedNear = 0.3f, kMergedFar = 0.08f;
constexpr size_t kLeastNear = 20, kLeastFar = 12;

struct LinkTask {
    const RayScene* rays;
    std::span<const LinkedObject> objects;
    std::span<const uint32_t> coarse;  // of each vertex: the one of its cell
    WalkMedium medium;
    WalkGuide guide;
    Vec3 per_flat;  // one over what flat skin returns
    const GaussianSum* profile;
    VertexLinkSettings settings;
};

// Sums of weights by vertex.
class Row {
  public:
    explicit Row(size_t vertices) : slots_(vertices, kNone) {}
    void add(uint32_t vertex, Vec3 weight) {
        uint32_t& slot = slots_[vertex];
        if (slot == kNone) {
            slot = uint32_t(links_.size());
            links_.push_back({vertex, weight});
        } else {
            links_[slot].weight += weight;
        }
    }
    void add(const LinkedObject& object, uint32_t triangle, const std::array<float, 3>& weights, Vec3 value) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t id = object.weld.ids[object.mesh->indices[3 * triangle + k]];
            add(object.first_vertex + object.weld.first[id], value * weights[k]);
        }
    }
    void add(std::span<const VertexLink> links, Vec3 factor) {
        for (const VertexLink& link : links) add(link.vertex, link.weight * factor);
    }
    /// All of it, as long as it needs to be: there is one for each vertex. Leaves nothing behind.
    [[nodiscard]] std::vector<VertexLink> take() {
        for (const VertexLink& link : links_) slots_[link.vertex] = kNone;
        std::vector<VertexLink> taken(links_.begin(), links_.end());
        links_.clear();
        return taken;
    }

  private:
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> slots_;  // of each vertex: its place among the links
    std::vector<VertexLink> links_;
};

// Where a line along n through q_mm, a point of the tangent plane, meets skin that faces n; the nearest to
// q_mm.
std::optional<RayHit> nearest_on_surface(const RayScene& rays, Vec3 q_mm, Vec3 n, float reach_mm) {
    HitBuffer<16> buffer;
    const size_t count = rays.all_hits(
        RaySet::skin, {.origin_mm = q_mm + n * reach_mm, .direction = -n, .max_mm = 2 * reach_mm},
        buffer.hits());
    std::optional<RayHit> best;
    for (const RayHit& hit : buffer.hits().first(count)) {
        if (dot(hit.n_face, n) <= 0) continue;
        if (!best || std::abs(hit.distance_mm - reach_mm) < std::abs(best->distance_mm - reach_mm))
            best = hit;
    }
    return best;
}

float inverse(float x) {
    return x > 0 ? 1 / x : 0.0f;
}

// Adds what the profile brings from one point; returns its weights, by which the row is normalised.
Vec3 probe(const LinkTask& task, const LinkStart& start, Pcg32& random, Row& row) {
    const float r_mm = sample_probe_radius_mm(*task.profile, random),
                angle = 2 * std::numbers::pi_v<float> * random.next_1d();
    const LocalFrame frame = frame_of(start.n);
    const Vec3 q_mm =
        start.p_mm + frame.tangent * (r_mm * std::cos(angle)) + frame.bitangent * (r_mm * std::sin(angle));
    const auto hit = nearest_on_surface(*task.rays, q_mm, start.n, 1 + 2 * r_mm);
    if (!hit) return {};
    const Vec3 y_mm = q_mm + start.n * (1 + 2 * r_mm - hit->distance_mm);
    const float density = probe_at(*task.profile, double(r_mm)).density;
    const Vec3 value = probe_at(*task.profile, double(length(y_mm - start.p_mm))).reflectance *
                       (1 / (density * std::max(dot(hit->n_face, start.n), kLeastCosine)));
    row.add(task.objects[hit->object], hit->triangle, {1 - hit->u - hit->v, hit->u, hit->v}, value);
    return value;
}

void add_end(const LinkTask& task, const RayHit& last, Vec3 value, Row& row) {
    if (value != Vec3{} && last.object != kCapObject)
        row.add(task.objects[last.object], last.triangle, {1 - last.u - last.v, last.u, last.v}, value);
}

void walk_from(const LinkTask& task, const LinkedObject& object, const LinkStart& start, float lead,
               float share, Pcg32& random, Row& row) {
    FleshBoundary boundary(*task.rays);
    const Vec3 direction = sample_entry_direction(start.n, task.medium.eta, random);
    const auto [end, flat] =
        guided_walk_and_flat(task.medium, task.guide, boundary, start.p_mm, start.n, direction, lead, random);
    add_end(task, boundary.last(), end.throughput * task.per_flat * share, row);
    row.add(object, start.triangle, start.weights, flat.throughput * task.per_flat * -share);
}

float size_of(const VertexLink& link) {
    return std::abs(link.weight.x) + std::abs(link.weight.y) + std::abs(link.weight.z);
}

struct Kept {
    size_t least, most;
    float merged;  // the largest sum of absolute weights that is merged into other links
};

// The largest links; the others are added to the nearest of them.
void keep_largest(std::span<const LinkedObject> objects, const Kept& kept, std::vector<VertexLink>& links) {
    std::ranges::sort(links, std::ranges::greater{}, size_of);
    size_t count = links.size();
    for (float merged = 0; count > kept.least && (merged += size_of(links[count - 1])) <= kept.merged;)
        --count;
    count = std::min(count, kept.most);
    std::vector<Vec3> places_mm;
    for (const VertexLink& link : std::span(links).first(count))
        places_mm.push_back(place_mm(objects, link.vertex));
    for (const VertexLink& link : std::span(links).subspan(count)) {
        const Vec3 p_mm = place_mm(objects, link.vertex);
        const auto far_mm2 = [&](Vec3 q_mm) { return dot(q_mm - p_mm, q_mm - p_mm); };
        links[size_t(std::ranges::min_element(places_mm, {}, far_mm2) - places_mm.begin())].weight +=
            link.weight;
    }
    links.resize(count);
}

// Moves the links out of a row that end far from its vertex.
std::vector<VertexLink> split_far(const LinkTask& task, const LinkedObject& object, uint32_t position,
                                  std::vector<VertexLink>& row, Row& far) {
    const uint32_t v = object.weld.first[position];
    const Vec3 p_mm = object.mesh->positions_mm[v], n = object.mesh->normals[v];
    const auto is_near = [&](const VertexLink& link) {
        const auto [mesh, u] = vertex_of(task.objects, link.vertex);
        return length(mesh->positions_mm[u] - p_mm) <= kNearMm && dot(mesh->normals[u], n) > 0;
    };
    const auto middle = std::partition(row.begin(), row.end(), is_near);
    for (const VertexLink& link : std::span(middle, row.end()))
        far.add(task.coarse[link.vertex], link.weight);
    row.erase(middle, row.end());
    return far.take();
}

// Walks and, in place of the light where they start, what the profile brings there; a colour that the profile
// does not have stays.
std::vector<VertexLink> links_of(const LinkTask& task, const LinkedObject& object, uint32_t position,
                                 uint32_t seed, Row& walked, Row& blurred) {
    const Star star(object, position);
    if (star.empty()) return {};
    const int walks =
        std::max(task.settings.least_walks, int(star.area_mm2() / 3 * task.settings.walks_per_mm2));
    const float share = 1 / float(walks);
    std::vector<LinkStart> starts;
    Vec3 total;
    for (int i = 0; i < walks; ++i) {
        Pcg32 random(seed, uint32_t(i));
        const float u = (float(i) + random.next_1d()) * share;
        const LinkStart start = star.draw(u, random);
        walk_from(task, object, start, golden_1d(hash_u32(seed, 1), uint32_t(i)), share, random, walked);
        total += probe(task, start, random, blurred);
        starts.push_back(start);
    }
    const Vec3 per_total = {inverse(total.x), inverse(total.y), inverse(total.z)};
    walked.add(blurred.take(), per_total * -1.0f);
    for (const LinkStart& start : starts)
        walked.add(object, start.triangle, start.weights, total * per_total * share);
    return walked.take();
}

using Rows = std::vector<std::vector<VertexLink>>;

// Calls change(position, row a, row b), in parallel, with rows that are empty.
void for_rows(const LinkTask& task, size_t rows, const auto& change) {
    parallel_for(rows, kRowsPerTask, [&](size_t begin, size_t end) {
        Row a(task.coarse.size()), b(task.coarse.size());
        for (size_t r = begin; r < end; ++r) change(uint32_t(r), a, b);
    });
}

// Half of each row becomes the mean of those around it, by area.
Rows smoothed(const LinkTask& task, const LinkedObject& object, const Rows& rows) {
    Rows made(rows.size());
    for_rows(task, rows.size(), [&](uint32_t r, Row& row, Row&) {
        if (object.around(r).empty()) return;
        row.add(rows[r], Vec3{0.5f, 0.5f, 0.5f});
        // What is not skin has no walks.
        for (const auto& [beside, share] : shares_around(object, r))
            row.add(rows[object.around(beside).empty() ? r : beside], Vec3{0.5f, 0.5f, 0.5f} * share);
        made[r] = row.take();
    });
    return made;
}

Rows rows_of(const LinkTask& task, const LinkedObject& object, uint32_t seed, Progress& progress) {
    Rows rows(object.weld.count()), far(rows.size());
    for_rows(task, rows.size(), [&](uint32_t r, Row& walked, Row& blurred) {
        rows[r] = links_of(task, object, r, hash_u32(seed, r), walked, blurred);
        progress.advance();
    });
    for (int i = 0; i < kSmoothings; ++i) rows = smoothed(task, object, rows);
    for_rows(task, rows.size(),
             [&](uint32_t r, Row& own, Row&) { far[r] = split_far(task, object, r, rows[r], own); });
    for (int i = 0; i < kFarSmoothings; ++i) far = smoothed(task, object, far);
    // Apart, or the light through thick parts, of many small links, would be taken to come from nearby.
    parallel_for(rows.size(), kRowsPerTask, [&](size_t begin, size_t end) {
        for (size_t r = begin; r < end; ++r) {
            const auto most = size_t(task.settings.most_links),
                       most_near = std::max(most * 5 / 12, size_t(1));
            keep_largest(task.objects, {kLeastNear, most_near, kMergedNear}, rows[r]);
            keep_largest(task.objects, {kLeastFar, most - most_near, kMergedFar}, far[r]);
            rows[r].insert(rows[r].end(), far[r].begin(), far[r].end());
        }
    });
    return rows;
}

void append(const LinkedObject& object, const Rows& rows, VertexLinks& links) {
    std::vector<uint32_t> numbers;
    for (const std::vector<VertexLink>& row : rows) {
        numbers.push_back(row.empty() ? 0 : uint32_t(links.first.size() - 1));
        if (row.empty()) continue;
        links.links.insert(links.links.end(), row.begin(), row.end());
        links.first.push_back(uint32_t(links.links.size()));
    }
    std::vector<uint32_t>& of_vertices = links.rows.emplace_back();
    for (const uint32_t id : object.weld.ids) of_vertices.push_back(numbers[id]);
}

Result<VertexLinks> walk_links(std::span<const SceneObject> objects, const ScatteringMedium& medium,
                               const GaussianSum& profile, const VertexLinkSettings& settings) {
    DERMIS_TRY_ASSIGN(const std::vector<Flesh> flesh, find_flesh(objects));
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(objects, flesh));
    std::vector<LinkedObject> all;
    uint32_t vertices = 0;
    size_t total = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        all.push_back(linked_object(objects[i], flesh[i], vertices));
        vertices += uint32_t(objects[i].mesh.positions_mm.size());
        total += all.back().weld.count();
    }
    const std::vector<uint32_t> coarse = coarse_vertices(all, vertices);
    const Vec3 flat = guided_half_space_albedo(medium, kFlatLinkWalks, 1).mean;
    const LinkTask task = {.rays = &rays,
                           .objects = all,
                           .coarse = coarse,
                           .medium = walk_medium(medium),
                           .guide = walk_guide_of_pairs(medium),
                           .per_flat = {inverse(flat.x), inverse(flat.y), inverse(flat.z)},
                           .profile = &profile,
                           .settings = settings};
    VertexLinks made{.rows = {}, .first = {0, 0}, .links = {}};
    Progress progress("links by walks", total);
    for (size_t i = 0; i < all.size(); ++i)
        append(all[i], rows_of(task, all[i], hash_u32(uint32_t(i), 9), progress), made);
    if (made.links.empty()) return Error{kNoWalkedSkin};
    return made;
}

Result<void> check_link_settings(const VertexLinkSettings& s) {
    if (!(s.walks_per_mm2 >= 0.1f && s.walks_per_mm2 <= 10000))
        return Error{"walks per mm^2 are " + to_text(s.walks_per_mm2) + ", not within 0.1..10000"};
    if (s.least_walks < 1 || s.least_walks > 1'000'000)
        return Error{"the least walks of a vertex are " + std::to_string(s.least_walks) +
                     ", not within 1..1000000"};
    if (s.most_links < 2 || s.most_links > 1024)
        return Error{"the most links of a vertex are " + std::to_string(s.most_links) +
                     ", not within 2..1024"};
    return {};
}

}  // namespace

Result<VertexLinks> walk_vertex_links(std::span<const SceneObject> objects, const ScatteringMedium& medium,
                                      const GaussianSum& profile, const VertexLinkSettings& settings) {
    DERMIS_TRY(check_link_settings(settings));
    Hasher hasher;
    hasher.add(std::string_view("links 14"));
    hasher.add(rays_version()).add(medium.g).add(medium.eta);
    for (size_t c = 0; c < 3; ++c) hasher.add(medium.sigma_s_per_mm[c]).add(medium.sigma_a_per_mm[c]);
    for (const GaussianTerm& term : profile.terms)
        hasher.add(term.variance_mm2).add(term.weight[0]).add(term.weight[1]).add(term.weight[2]);
    hasher.add(settings.walks_per_mm2).add(settings.least_walks).add(settings.most_links);
    for (const SceneObject& object : objects) add_shape(hasher, object);
    const std::string key = hasher.hex();
    VertexLinks links;
    std::vector<uint32_t> counts, rows;
    const auto parts = [&] { return std::tie(counts, rows, links.first, links.links); };
    if (cache_load("vertex_links", key, parts())) {
        auto row = rows.begin();
        for (const uint32_t count : counts) {
            links.rows.emplace_back(row, row + count);
            row += count;
        }
        return links;
    }
    DERMIS_TRY_ASSIGN(links, walk_links(objects, medium, profile, settings));
    for (const std::vector<uint32_t>& of_object : links.rows) {
        counts.push_back(uint32_t(of_object.size()));
        rows.insert(rows.end(), of_object.begin(), of_object.end());
    }
    cache_store("vertex_links", key, parts());
    return links;
}

}  // namespace dermis::inline rays
