#include "dermis/rays/flesh.h"

#include <algorithm>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/mesh/hole_caps.h"
#include "dermis/mesh/topology.h"
#include "dermis/rays/random.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/sampling.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline rays {
namespace {

constexpr int kRays = 256;
// Counts of kRays that leave the mesh: hidden parts grow up to 2 %; a part that they enclose may have 5 %.
constexpr int kGrowRays = 5, kEnclosedRays = 12;
// A majority of them decides whether a hidden face is buried.
constexpr int kBuriedRays = 31;
// A hidden patch smaller than this share of the skin is the bottom of a crease, not a cavity.
constexpr double kLeastCavityShare = 1e-4;

// The triangles of a mesh with their neighbours across edges; UV seams do not separate neighbours.
class Neighbours {
  public:
    explicit Neighbours(const Mesh& mesh) {
        const Weld weld = weld_positions(mesh.positions_mm);
        for (uint32_t corner = 0; corner < mesh.indices.size(); ++corner) {
            const uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
            const auto [a, b] = std::minmax(weld.ids[mesh.indices[corner]], weld.ids[mesh.indices[next]]);
            sides_.push_back({a, b, corner / 3});
        }
        std::ranges::sort(sides_);
    }
    // Calls visit(t, u) for the triangles of every edge that several share.
    template <class Visit>
    void each_pair(const Visit& visit) const {
        for (size_t i = 1; i < sides_.size(); ++i)
            if (sides_[i - 1].a == sides_[i].a && sides_[i - 1].b == sides_[i].b)
                visit(sides_[i - 1].triangle, sides_[i].triangle);
    }

  private:
    struct Side {
        uint32_t a, b, triangle;
        friend auto operator<=>(const Side&, const Side&) = default;
    };
    std::vector<Side> sides_;
};

// Sums over patches of connected triangles; a patch has the number of its lowest triangle.
struct Patches {
    std::vector<uint32_t> leader;
    std::vector<double> area_mm2;
    std::vector<int> most_rays;
};

struct Triangles {
    std::vector<uint8_t> skin, hidden;
    std::vector<int> open;
    std::vector<double> area_mm2;
    [[nodiscard]] size_t count() const { return skin.size(); }
};

// Patches whose triangles are all hidden or all visible.
Patches patches_of(const Triangles& triangles, const Neighbours& neighbours) {
    Patches patches{std::vector<uint32_t>(triangles.count()), std::vector<double>(triangles.count()),
                    std::vector<int>(triangles.count())};
    DisjointSets sets(triangles.count());
    neighbours.each_pair([&](uint32_t t, uint32_t u) {
        if (triangles.skin[t] && triangles.skin[u] && triangles.hidden[t] == triangles.hidden[u])
            sets.join(t, u);
    });
    for (uint32_t t = 0; t < triangles.count(); ++t) {
        const uint32_t leader = patches.leader[t] = sets.find(t);
        patches.area_mm2[leader] += triangles.area_mm2[t];
        patches.most_rays[leader] = std::max(patches.most_rays[leader], triangles.open[t]);
    }
    return patches;
}

void grow(Triangles& triangles, const Neighbours& neighbours) {
    for (bool grown = true; grown;) {
        grown = false;
        neighbours.each_pair([&](uint32_t t, uint32_t u) {
            if (!triangles.skin[t] || !triangles.skin[u] || triangles.hidden[t] == triangles.hidden[u])
                return;
            const uint32_t candidate = triangles.hidden[t] ? u : t;
            if (triangles.open[candidate] > kGrowRays) return;
            triangles.hidden[candidate] = 1;
            grown = true;
        });
    }
}

// Rays from points spread over a triangle, with cosine-weighted directions.
class FaceRays {
  public:
    FaceRays(const RayScene& scene, uint32_t triangle) : seed_(triangle), lift_mm_(2 * scene.epsilon_mm()) {
        const Mesh& mesh = scene.mesh(0);
        const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
        origin_mm_ = mesh.positions_mm[corner[0]];
        first_mm_ = mesh.positions_mm[corner[1]] - origin_mm_;
        second_mm_ = mesh.positions_mm[corner[2]] - origin_mm_;
        const Vec3 facing = cross(first_mm_, second_mm_);
        has_area_ = dot(facing, facing) > 0;
        frame_ = frame_of(has_area_ ? normalize(facing) : Vec3{0, 0, 1});
    }
    [[nodiscard]] bool has_area() const { return has_area_; }
    [[nodiscard]] Ray operator[](int index) const {
        OwenSequence random(seed_, uint32_t(index));
        const Vec2 place = random.next_2d();
        const Vec3 direction = frame_.to_world(sample_cosine_hemisphere(random.next_2d()));
        const float root = std::sqrt(place.x);
        return {.origin_mm = origin_mm_ + first_mm_ * (root * (1 - place.y)) + second_mm_ * (root * place.y) +
                             frame_.normal * lift_mm_,
                .direction = direction};
    }

  private:
    uint32_t seed_;
    float lift_mm_;
    bool has_area_;
    Vec3 origin_mm_, first_mm_, second_mm_;
    LocalFrame frame_;
};

// How many of kRays rays reach the outside. Stops when more than kEnclosedRays have, because the exact number
// is not needed.
int open_rays(const RayScene& scene, uint32_t triangle) {
    const FaceRays rays(scene, triangle);
    int open = 0;
    for (int i = 0; i < kRays && open <= kEnclosedRays && rays.has_area(); ++i)
        open += !scene.occluded(RaySet::opaque, rays[i]);
    return open;
}

// Whether most rays meet a face from its back, which means that they run inside flesh.
bool is_buried(const RayScene& scene, uint32_t triangle) {
    const FaceRays rays(scene, triangle);
    int backs = 0;
    for (int i = 0; i < kBuriedRays && rays.has_area(); ++i) {
        const Ray ray = rays[i];
        const std::optional<RayHit> hit = scene.closest_hit(RaySet::opaque, ray);
        backs += hit && dot(hit->n_face, ray.direction) > 0;
    }
    return 2 * backs > kBuriedRays;
}

Triangles measure(const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    const size_t count = mesh.triangle_count();
    Triangles triangles{std::vector<uint8_t>(count), std::vector<uint8_t>(count), std::vector<int>(count),
                        std::vector<double>(count)};
    for (uint32_t t = 0; t < count; ++t) {
        const uint32_t material = material_of_triangle(mesh, t);
        triangles.skin[t] =
            material >= object.classes.size() || object.classes[material] == MaterialClass::skin;
        triangles.area_mm2[t] = double(triangle_area_mm2(mesh, t));
    }
    return triangles;
}

using Caps = std::vector<std::array<Vec3, 3>>;

// The area of the skin as a vector: where its front looks.
Vec3 front_of(const Mesh& mesh, const std::vector<uint32_t>& skin) {
    Vec3 sum;
    for (const uint32_t t : skin) {
        const auto [a, b, c] = corners_mm(mesh, t);
        sum += cross(b - a, c - a);
    }
    return normalize(sum);
}

// Volume between the skin and its caps; the tetrahedra start at a point of it, so that little cancels.
double enclosed_mm3(const Mesh& mesh, const std::vector<uint32_t>& skin, const Caps& caps) {
    const Vec3 from = mesh.positions_mm[mesh.indices[3 * skin.front()]];
    double sum = 0;
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
        sum += double(dot(a - from, cross(b - from, c - from))) / 6;
    };
    for (const uint32_t t : skin) {
        const auto [a, b, c] = corners_mm(mesh, t);
        add(a, b, c);
    }
    for (const auto& [a, b, c] : caps) add(a, b, c);
    return sum;
}

// Walls from the border backwards, and its cap as their floor. The border turns as the skin does, so the body
// is to its left.
void set_back(const std::vector<BorderLoop>& loops, Vec3 front, Caps& caps) {
    const Vec3 back = front * -float(kSheetDepthMm);
    for (auto& cap : caps)
        for (Vec3& corner : cap) corner += back;
    for (const BorderLoop& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i) {
            const Vec3 a = loop[i], b = loop[(i + 1) % loop.size()];
            caps.push_back({a, a + back, b});
            caps.push_back({b, a + back, b + back});
        }
}

// Makes caps for the openings that `flesh.faces` leave, and sums the areas.
void finish(const Mesh& mesh, const Triangles& triangles, Flesh& flesh) {
    std::vector<uint32_t> skin, boundary;
    for (uint32_t t = 0; t < triangles.count(); ++t) {
        if (!triangles.skin[t]) continue;
        flesh.skin_area_mm2 += triangles.area_mm2[t];
        skin.push_back(t);
        if (flesh.faces[t] != SkinFace::cavity) boundary.push_back(t);
        if (flesh.faces[t] == SkinFace::visible) continue;
        ++flesh.hidden_triangles;
        flesh.hidden_area_mm2 += triangles.area_mm2[t];
    }
    std::vector<BorderLoop> openings = border_loops(mesh.positions_mm, mesh.indices, skin);
    flesh.mesh_openings = openings.size();
    std::vector<BorderLoop> loops = border_loops(mesh.positions_mm, mesh.indices, boundary);
    const size_t largest_exact = affordable_exact(loops);
    const size_t of_cavities = put_last(loops, std::move(openings));
    Progress progress("closing openings", loops.size());
    for (size_t i = 0; i < loops.size(); ++i, progress.advance()) {
        const std::vector<std::array<Vec3, 3>> cap = cap_of(loops[i], largest_exact);
        flesh.caps.insert(flesh.caps.end(), cap.begin(), cap.end());
        if (i < of_cavities) flesh.cavity_caps = flesh.caps.size();
    }
    if (loops.empty() || flesh.hidden_triangles > 0) return;
    // Below 0 where the cap of a saddle lies in front of it.
    flesh.is_sheet = enclosed_mm3(mesh, skin, flesh.caps) < kSheetMm * flesh.skin_area_mm2;
    if (flesh.is_sheet) set_back(loops, front_of(mesh, skin), flesh.caps);
}

// Hides what cannot be seen from outside: the steps of flesh.h, in their order.
void hide(const Mesh& mesh, Triangles& triangles, const RayScene& rays) {
    Progress progress("looking for cavities", triangles.count());
    parallel_for(triangles.count(), 64, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t)
            if (triangles.skin[t]) {
                triangles.open[t] = open_rays(rays, uint32_t(t));
                triangles.hidden[t] = triangles.open[t] == 0;
            }
        progress.advance(end - begin);
    });
    const Neighbours neighbours(mesh);
    grow(triangles, neighbours);
    const Patches patches = patches_of(triangles, neighbours);
    for (size_t t = 0; t < triangles.count(); ++t)
        if (triangles.skin[t] && !triangles.hidden[t])
            triangles.hidden[t] = patches.most_rays[patches.leader[t]] <= kEnclosedRays;
    double skin_mm2 = 0;
    for (size_t t = 0; t < triangles.count(); ++t) skin_mm2 += triangles.skin[t] * triangles.area_mm2[t];
    const Patches closed = patches_of(triangles, neighbours);
    for (size_t t = 0; t < triangles.count(); ++t)
        if (triangles.hidden[t])
            triangles.hidden[t] = closed.area_mm2[closed.leader[t]] >= kLeastCavityShare * skin_mm2;
    // All skin hidden: not a cavity, but triangles that wind the wrong way.
    if (triangles.hidden == triangles.skin) std::ranges::fill(triangles.hidden, 0);
}

std::vector<SkinFace> faces_of(const Triangles& triangles, const RayScene& rays) {
    std::vector<SkinFace> faces(triangles.count(), SkinFace::visible);
    parallel_for(triangles.count(), 64, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t)
            if (triangles.hidden[t])
                faces[t] = is_buried(rays, uint32_t(t)) ? SkinFace::buried : SkinFace::cavity;
    });
    return faces;
}

Result<Flesh> make_flesh(const SceneObject& object, Cavities cavities) {
    Triangles triangles = measure(object);
    Flesh flesh{.faces = std::vector<SkinFace>(triangles.count(), SkinFace::visible)};
    if (cavities == Cavities::flesh && std::ranges::count(triangles.skin, 1) > 0) {
        DERMIS_TRY_ASSIGN(RayScene rays, RayScene::build(std::span(&object, 1)));
        hide(object.mesh, triangles, rays);
        flesh.faces = faces_of(triangles, rays);
    }
    finish(object.mesh, triangles, flesh);
    return flesh;
}

}  // namespace

Result<std::vector<Flesh>> find_flesh(std::span<const SceneObject> objects, Cavities cavities) {
    std::vector<Flesh> all;
    for (const SceneObject& object : objects) {
        Hasher hasher;
        add_shape(hasher.add(rays_version()).add(cavities), object);
        DERMIS_TRY_ASSIGN(
            Flesh flesh,
            cached(
                "flesh", hasher.hex(), Flesh{.faces = std::vector<SkinFace>(object.mesh.triangle_count())},
                [&] { return make_flesh(object, cavities); },
                [](auto& f) {
                    return std::tie(f.faces, f.caps, f.cavity_caps, f.hidden_triangles, f.hidden_area_mm2,
                                    f.skin_area_mm2, f.mesh_openings, f.is_sheet);
                }));
        all.push_back(std::move(flesh));
    }
    return all;
}

std::vector<bool> walked_triangles(const SceneObject& object, const Flesh& flesh) {
    std::vector<bool> walked(object.mesh.triangle_count());
    for (uint32_t t = 0; t < walked.size(); ++t)
        walked[t] = flesh.faces[t] == SkinFace::visible &&
                    is_skin(object, material_of_triangle(object.mesh, t)) &&
                    triangle_area_mm2(object.mesh, t) > 0;
    return walked;
}

}  // namespace dermis::inline rays
