#include "dermis/rays/ray_scene.h"
#include "dermis/base/parallel.h"
#include "dermis/rays/embree.h"
#include "dermis/rays/texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <numeric>

namespace dermis::inline rays {
namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using ScenePointer = std::unique_ptr<RTCSceneTy, SceneRelease>;

// One mesh's triangles of one set; Embree numbers them from 0.
struct Part {
    uint32_t object = 0;
    std::vector<uint32_t> triangles;     // their numbers in the mesh
    const CutOutMap* cut_out = nullptr;  // null: every hit counts
};

struct TriangleSet {
    ScenePointer scene;
    std::vector<Part> parts;  // by Embree's geometry number
};

bool bounds_flesh(RaySet set) {
    return set == RaySet::flesh || set == RaySet::capped_cavities;
}

bool belongs(RaySet set, MaterialClass material_class) {
    if (set == RaySet::translucent) return material_class == MaterialClass::translucent;
    if (set == RaySet::skin || bounds_flesh(set)) return material_class == MaterialClass::skin;
    return material_class != MaterialClass::translucent;
}

// The set of drawn surfaces keeps all faces.
bool left_out(RaySet set, SkinFace face) {
    return (set == RaySet::skin && face != SkinFace::visible) ||
           (bounds_flesh(set) && face == SkinFace::cavity);
}

MaterialClass class_of(std::span<const MaterialClass> classes, uint32_t material) {
    return material < classes.size() ? classes[material] : MaterialClass::skin;
}

// Triangles of the materials for which `wanted` is true.
Part select_triangles(const Mesh& mesh, std::span<const MaterialClass> classes, RaySet set,
                      const auto& wanted) {
    Part part;
    for (const Submesh& submesh : mesh.submeshes) {
        if (!belongs(set, class_of(classes, submesh.material)) || !wanted(submesh.material)) continue;
        for (uint32_t i = 0; i < submesh.index_count / 3; ++i)
            part.triangles.push_back(submesh.first_index / 3 + i);
    }
    if (mesh.submeshes.empty() && belongs(set, class_of(classes, 0)) && wanted(0))
        for (uint32_t i = 0; i < mesh.triangle_count(); ++i) part.triangles.push_back(i);
    return part;
}

struct Context {
    EmbreeContext embree;
    bool blends;  // the ray stops wherever a blended material shows
};

Context make_context(bool blends) {
    Context context{.embree = {}, .blends = blends};
    init_embree_context(&context.embree);
    return context;
}

// A filter's answer: 0 lets the ray go on.
void pass_cut_outs(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    const auto* part = static_cast<const Part*>(arguments->geometryUserPtr);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    const uint32_t triangle = part->triangles[hit->primID];
    const bool goes_on = reinterpret_cast<const Context*>(arguments->context)->blends
                             ? part->cut_out->shows_nothing(triangle, hit->u, hit->v)
                             : part->cut_out->passes(triangle, hit->u, hit->v);
    if (goes_on) arguments->valid[0] = 0;
}

// False when Embree has no memory for it.
bool attach(RTCDevice device, RTCScene scene, std::span<const Vec3> positions_mm,
            std::span<const uint32_t> corners, const Part* cut_out = nullptr) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              sizeof(Vec3), positions_mm.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(uint32_t), corners.size() / 3);
    const bool allocated = positions && indices;
    if (allocated) {
        std::memcpy(positions, positions_mm.data(), positions_mm.size_bytes());
        std::memcpy(indices, corners.data(), corners.size_bytes());
        if (cut_out) {
            rtcSetGeometryUserData(geometry, const_cast<Part*>(cut_out));
            rtcSetGeometryIntersectFilterFunction(geometry, pass_cut_outs);
            rtcSetGeometryOccludedFilterFunction(geometry, pass_cut_outs);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
    return allocated;
}

std::vector<uint32_t> corners_of(const Mesh& mesh, const Part& part) {
    std::vector<uint32_t> corners;
    for (const uint32_t triangle : part.triangles)
        for (int corner = 0; corner < 3; ++corner) corners.push_back(mesh.indices[3 * triangle + corner]);
    return corners;
}

std::vector<Vec3> cap_corners(RaySet which, std::span<const Flesh> flesh) {
    std::vector<Vec3> corners;
    for (const Flesh& one : flesh)
        for (const std::array<Vec3, 3>& cap :
             std::span(one.caps).first(which == RaySet::capped_cavities ? one.cavity_caps : one.caps.size()))
            corners.insert(corners.end(), cap.begin(), cap.end());
    return corners;
}

RTCRayHit embree_ray(const Ray& ray) {
    RTCRayHit query{};
    query.ray = {ray.origin_mm.x,
                 ray.origin_mm.y,
                 ray.origin_mm.z,
                 ray.min_mm,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 ray.max_mm,
                 ~0u,
                 0,
                 0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

RayHit make_hit(const TriangleSet& set, float distance_mm, uint32_t geometry, uint32_t primitive, float u,
                float v, Vec3 normal) {
    const Part& part = set.parts[geometry];
    return {.distance_mm = distance_mm,
            .object = part.object,
            .triangle = part.triangles[primitive],
            .u = u,
            .v = v,
            .n_face = normalize(normal)};
}

// Embree calls the filter for every triangle the ray crosses; rejecting each one makes it go on to the next.
struct CollectContext {
    Context context;
    const TriangleSet* set;
    std::span<RayHit> hits;
    size_t count;
};

void collect(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    auto* context = reinterpret_cast<CollectContext*>(arguments->context);
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    if (context->count < context->hits.size())
        context->hits[context->count++] = make_hit(*context->set, ray->tfar, hit->geomID, hit->primID, hit->u,
                                                   hit->v, {hit->Ng_x, hit->Ng_y, hit->Ng_z});
    arguments->valid[0] = 0;
}

}  // namespace

bool has_cut_outs(std::span<const SceneObject> objects) {
    return std::ranges::any_of(objects, [](const SceneObject& object) {
        return std::ranges::any_of(object.mesh.materials,
                                   [](const Material& m) { return cutoff_of_map(m) > 0; });
    });
}

struct RayScene::Impl {
    DevicePointer device;
    std::array<TriangleSet, 5> sets;
    std::vector<const Mesh*> meshes;
    std::vector<std::vector<std::unique_ptr<CutOutMap>>> cut_outs;  // by mesh and material; null: it is whole
    float epsilon_mm = 1e-6f;

    [[nodiscard]] const TriangleSet& set(RaySet which) const { return sets[size_t(which)]; }

    [[nodiscard]] const CutOutMap* cut_out_of(uint32_t object, uint32_t material) const {
        const bool known = object < cut_outs.size() && material < cut_outs[object].size();
        return known ? cut_outs[object][material].get() : nullptr;
    }

    Result<void> load_cut_outs(std::span<const SceneObject> objects) {
        for (const SceneObject& object : objects) {
            auto& of_object = cut_outs.emplace_back();
            for (uint32_t i = 0; i < object.mesh.materials.size(); ++i) {
                DERMIS_TRY_ASSIGN(std::unique_ptr<CutOutMap> loaded, CutOutMap::load(object, i));
                of_object.push_back(std::move(loaded));
            }
        }
        return {};
    }

    // False when the ray library failed.
    bool add_set(RaySet which, std::span<const std::span<const MaterialClass>> classes,
                 std::span<const Flesh> flesh) {
        TriangleSet& set = sets[size_t(which)];
        for (uint32_t object = 0; object < meshes.size(); ++object) {
            const auto add_part = [&](const CutOutMap* cut_out, const auto& wanted) {
                Part part = select_triangles(*meshes[object], classes[object], which, wanted);
                part.object = object, part.cut_out = cut_out;
                if (!flesh.empty())
                    std::erase_if(part.triangles,
                                  [&](uint32_t t) { return left_out(which, flesh[object].faces[t]); });
                if (!part.triangles.empty()) set.parts.push_back(std::move(part));
            };
            add_part(nullptr, [&](uint32_t material) { return !cut_out_of(object, material); });
            for (uint32_t i = 0; i < meshes[object]->materials.size(); ++i)
                if (const CutOutMap* cut_out = cut_out_of(object, i))
                    add_part(cut_out, [&](uint32_t material) { return material == i; });
        }
        if (set.parts.empty()) return true;
        set.scene.reset(rtcNewScene(device.get()));
        rtcSetSceneFlags(set.scene.get(), RTC_SCENE_FLAG_ROBUST | kEmbreeQueryFilters);
        // Not high quality: its spatial splits report a triangle twice to all_hits.
        rtcSetSceneBuildQuality(set.scene.get(), RTC_BUILD_QUALITY_MEDIUM);
        for (const Part& part : set.parts) {
            const Mesh& mesh = *meshes[part.object];
            if (!attach(device.get(), set.scene.get(), mesh.positions_mm, corners_of(mesh, part),
                        part.cut_out ? &part : nullptr))
                return false;
        }
        if (bounds_flesh(which) && !add_caps(which, set, flesh)) return false;
        rtcCommitScene(set.scene.get());
        return rtcGetDeviceError(device.get()) == RTC_ERROR_NONE;
    }

    bool add_caps(RaySet which, TriangleSet& set, std::span<const Flesh> flesh) {
        const std::vector<Vec3> corners = cap_corners(which, flesh);
        if (corners.empty()) return true;
        std::vector<uint32_t> indices(corners.size());
        std::iota(indices.begin(), indices.end(), 0u);
        Part part{.object = kCapObject, .triangles = std::vector<uint32_t>(corners.size() / 3)};
        std::iota(part.triangles.begin(), part.triangles.end(), 0u);
        set.parts.push_back(std::move(part));
        return attach(device.get(), set.scene.get(), corners, indices);
    }

    Result<void> build(std::span<const std::span<const MaterialClass>> classes,
                       std::span<const Flesh> flesh) {
        assert(flesh.empty() || flesh.size() == meshes.size());
        size_t triangles = 0;
        float extent_mm = 0;
        for (const Mesh* mesh : meshes) {
            triangles += mesh->triangle_count();
            for (const Vec3 p : mesh->positions_mm)
                extent_mm = std::max({extent_mm, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
        if (triangles == 0) return Error{"the scene has no triangle to trace rays against"};
        epsilon_mm = 2e-6f * extent_mm;
        // Embree's thread pool ends the program when it cannot start a thread, so they are tried first.
        if (!can_start_threads())
            return Error{
                "the threads of the ray library cannot be started; raise the limit on processes (ulimit -u)"};
        device.reset(rtcNewDevice(nullptr));
        if (!device) return Error{"the ray library (Embree) does not start on this machine"};
        for (const RaySet which :
             {RaySet::opaque, RaySet::skin, RaySet::translucent, RaySet::flesh, RaySet::capped_cavities})
            if ((!bounds_flesh(which) || !flesh.empty()) && !add_set(which, classes, flesh))
                return Error{"the ray library (Embree) has not enough memory for this scene"};
        return {};
    }
};

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

Result<RayScene> RayScene::build(std::span<const SceneObject> objects, std::span<const Flesh> flesh) {
    auto impl = std::make_unique<Impl>();
    std::vector<std::span<const MaterialClass>> classes;
    for (const SceneObject& object : objects) {
        impl->meshes.push_back(&object.mesh);
        classes.push_back(object.classes);
    }
    DERMIS_TRY(impl->load_cut_outs(objects));
    DERMIS_TRY(impl->build(classes, flesh));
    return RayScene(std::move(impl));
}

Result<RayScene> RayScene::build(const Mesh& mesh) {
    auto impl = std::make_unique<Impl>();
    impl->meshes.push_back(&mesh);
    const std::span<const MaterialClass> all_skin;
    DERMIS_TRY(impl->build(std::span(&all_skin, 1), {}));
    return RayScene(std::move(impl));
}

std::optional<RayHit> RayScene::closest_hit(RaySet which, const Ray& ray) const {
    const TriangleSet& set = impl_->set(which);
    if (!set.scene) return std::nullopt;
    Context context = make_context(ray.blends);
    RTCRayHit query = embree_ray(ray);
    embree_intersect(set.scene.get(), &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return make_hit(set, query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v,
                    {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
}

bool RayScene::occluded(RaySet which, const Ray& ray) const {
    const TriangleSet& set = impl_->set(which);
    if (!set.scene) return false;
    Context context = make_context(ray.blends);
    RTCRay query = embree_ray(ray).ray;
    embree_occluded(set.scene.get(), &context.embree, &query);
    return query.tfar < 0;
}

size_t RayScene::all_hits(RaySet which, const Ray& ray, std::span<RayHit> hits) const {
    const TriangleSet& set = impl_->set(which);
    if (!set.scene) return 0;
    CollectContext collected{.context = make_context(ray.blends), .set = &set, .hits = hits, .count = 0};
    RTCRayHit query = embree_ray(ray);
    embree_intersect(set.scene.get(), &collected.context.embree, &query, collect);
    return collected.count;
}

RayScene::Bounds RayScene::bounds(RaySet which) const {
    RTCBounds box;
    rtcGetSceneBounds(impl_->set(which).scene.get(), &box);
    return {{box.lower_x, box.lower_y, box.lower_z}, {box.upper_x, box.upper_y, box.upper_z}};
}

float RayScene::alpha_at(const RayHit& hit) const {
    if (hit.object == kCapObject) return 1;
    const uint32_t material = material_of_triangle(mesh(hit.object), hit.triangle);
    const CutOutMap* cut_out = impl_->cut_out_of(hit.object, material);
    return cut_out ? cut_out->alpha(hit.triangle, hit.u, hit.v) : 1;
}

bool RayScene::has(RaySet which) const {
    return impl_->set(which).scene != nullptr;
}
const Mesh& RayScene::mesh(uint32_t object) const {
    return *impl_->meshes[object];
}
float RayScene::epsilon_mm() const {
    return impl_->epsilon_mm;
}

}  // namespace dermis::inline rays
