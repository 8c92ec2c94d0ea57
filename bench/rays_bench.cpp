// Rays per second of the reference's queries against Embree alone: the same rays in the same order, once
// by RayScene, once by rtcIntersect1 and rtcOccluded1 on a scene built with the same flags. One thread.
//
//     build/bench/rays_bench [SCENE] [RAYS]
//
// The rays: from the camera through random points of the picture (closest hit), then from what they hit to
// the key light and into the hemisphere (occlusion), then probes through the skin (all hits of a segment).

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>

#include "catalog/catalog.h"
#include "dermis/rays/embree.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

int fail(const std::string& message) {
    std::fprintf(stderr, "rays_bench: %s\n", message.c_str());
    return 1;
}

// All meshes of the scene as one Embree scene, with RayScene's flags.
class EmbreeScene {
  public:
    explicit EmbreeScene(const Scene& scene) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | kEmbreeQueryFilters);
        for (const SceneObject& object : scene.objects) attach(object.mesh);
        rtcCommitScene(scene_);
    }
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    [[nodiscard]] RTCScene get() const { return scene_; }

  private:
    void attach(const Mesh& mesh) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(Vec3), mesh.positions_mm.size()),
                    mesh.positions_mm.data(), mesh.positions_mm.size() * sizeof(Vec3));
        std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(uint32_t), mesh.triangle_count()),
                    mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }
    RTCDevice device_;
    RTCScene scene_;
};

RTCRay embree_ray(const Ray& ray) {
    RTCRay query{};
    query.org_x = ray.origin_mm.x, query.org_y = ray.origin_mm.y, query.org_z = ray.origin_mm.z;
    query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
    query.tnear = ray.min_mm, query.tfar = ray.max_mm;
    query.mask = ~0u;
    return query;
}

double processor_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

struct Rates {
    double dermis_per_s = 0, embree_per_s = 0;
    size_t dermis_hits = 0, embree_hits = 0;
};

// Both ways in turn; the best of five of each counts.
Rates measure(std::span<const Ray> rays, const auto& by_dermis, const auto& by_embree) {
    Rates rates;
    for (int round = 0; round < 5; ++round) {
        double start = processor_s();
        rates.dermis_hits = 0;
        for (const Ray& ray : rays) rates.dermis_hits += by_dermis(ray);
        rates.dermis_per_s = std::max(rates.dermis_per_s, double(rays.size()) / (processor_s() - start));
        start = processor_s();
        rates.embree_hits = 0;
        for (const Ray& ray : rays) rates.embree_hits += by_embree(ray);
        rates.embree_per_s = std::max(rates.embree_per_s, double(rays.size()) / (processor_s() - start));
    }
    return rates;
}

void print(const char* name, size_t rays, const Rates& rates) {
    std::printf("%-22s %9zu rays %8.2f M/s dermis %8.2f M/s Embree  %.2f   hits %zu, %zu\n", name, rays,
                rates.dermis_per_s * 1e-6, rates.embree_per_s * 1e-6, rates.dermis_per_s / rates.embree_per_s,
                rates.dermis_hits, rates.embree_hits);
}

struct Rays {
    std::vector<Ray> camera, to_light, hemisphere, probes;
};

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return normalize(Vec3{normal(random), normal(random), normal(random)});
}

// From a sphere around the scene to points near its middle, as a camera's rays are; then from what they hit.
Rays make_rays(const RayScene& scene, Vec3 to_light_world, size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const RayScene::Bounds box = scene.bounds(RaySet::opaque);
    const Vec3 middle = 0.5f * (box.min_mm + box.max_mm), half = 0.5f * (box.max_mm - box.min_mm);
    const Vec3 eye = middle + Vec3{0, 0, 3 * length(half)};
    Rays rays;
    for (size_t i = 0; i < count; ++i) {
        const Vec3 target =
            middle + Vec3{half.x * (2 * unit(random) - 1), half.y * (2 * unit(random) - 1), 0};
        rays.camera.push_back({.origin_mm = eye, .direction = normalize(target - eye)});
        const auto hit = scene.closest_hit(RaySet::opaque, rays.camera.back());
        if (!hit) continue;
        const SurfaceAttributes at = scene.surface_at(*hit);
        const Vec3 start = at.p_smooth_mm + 4 * scene.epsilon_mm() * at.n_face_world;
        rays.to_light.push_back({.origin_mm = start, .direction = to_light_world});
        rays.hemisphere.push_back(
            {.origin_mm = start, .direction = normalize(at.n_geometry_world + random_direction(random))});
        constexpr float kProbeMm = 10;
        const Vec3 along = random_direction(random);
        rays.probes.push_back(
            {.origin_mm = at.p_world_mm - kProbeMm * along, .direction = along, .max_mm = 2 * kProbeMm});
    }
    return rays;
}

// Embree's filter that all_hits() needs, and no more: it counts.
struct CountContext {
    EmbreeContext embree;
    size_t count;
};

void count_hit(const RTCFilterFunctionNArguments* arguments) {
    ++reinterpret_cast<CountContext*>(arguments->context)->count;
    arguments->valid[0] = 0;
}

void run(const RayScene& scene, const EmbreeScene& embree, const Rays& rays) {
    const auto closest = [&](const Ray& ray) -> size_t {
        return scene.closest_hit(RaySet::opaque, ray).has_value();
    };
    const auto closest_embree = [&](const Ray& ray) -> size_t {
        EmbreeContext context;
        init_embree_context(&context);
        RTCRayHit query{.ray = embree_ray(ray), .hit = {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        embree_intersect(embree.get(), &context, &query);
        return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    };
    const auto occluded = [&](const Ray& ray) -> size_t { return scene.occluded(RaySet::opaque, ray); };
    const auto occluded_embree = [&](const Ray& ray) -> size_t {
        EmbreeContext context;
        init_embree_context(&context);
        RTCRay query = embree_ray(ray);
        embree_occluded(embree.get(), &context, &query);
        return query.tfar < 0;
    };
    std::vector<RayHit> hits(64);
    const auto all = [&](const Ray& ray) { return scene.all_hits(RaySet::opaque, ray, hits); };
    const auto all_embree = [&](const Ray& ray) {
        CountContext context{};
        init_embree_context(&context.embree);
        RTCRayHit query{.ray = embree_ray(ray), .hit = {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        embree_intersect(embree.get(), &context.embree, &query, count_hit);
        return context.count;
    };
    print("closest, camera", rays.camera.size(), measure(rays.camera, closest, closest_embree));
    print("occluded, light", rays.to_light.size(), measure(rays.to_light, occluded, occluded_embree));
    print("occluded, hemisphere", rays.hemisphere.size(),
          measure(rays.hemisphere, occluded, occluded_embree));
    print("all hits, probes", rays.probes.size(), measure(rays.probes, all, all_embree));
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "bust";
    const long count = argc > 2 ? std::atol(argv[2]) : 200'000;
    if (count < 1 || count > 100'000'000) return fail("1 to 100000000 rays");
    Result<Scene> scene = load_scene(name, {.subjects = built_in_catalog().subjects});
    if (!scene) return fail(scene.error().message);
    if (Result<void> complete = complete_scene(*scene); !complete) return fail(complete.error().message);
    Result<RayScene> rays = RayScene::build(scene->objects);
    if (!rays) return fail(rays.error().message);
    const EmbreeScene embree(*scene);
    std::printf("%s, one thread, processor time, best of five rounds in turn\n", scene->name.c_str());
    run(*rays, embree, make_rays(*rays, normalize(Vec3{-0.6f, 0.5f, 0.6f}), size_t(count)));
}
