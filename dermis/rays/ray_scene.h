#pragma once
// Rays against triangle meshes: closest hit with interpolated attributes, occlusion, all hits of a segment.
//
// The scene is kept as sets, so that a query sees only what it is about: opaque surfaces (skin and other),
// skin alone (probes), what bounds the flesh (walks inside it), and translucent objects (coloured shadows).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/mesh/mesh.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/texture.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

enum class RaySet {
    opaque,  ///< skin and other
    skin,    ///< that is not hidden
    translucent,
    flesh,           ///< what encloses it: skin without the inner faces of cavities, and all caps
    capped_cavities  ///< the same without the caps of the mesh's openings: an open sheet encloses nothing
};

/// RayHit::object of a cap, which belongs to no mesh.
inline constexpr uint32_t kCapObject = ~0u;

struct Ray {
    Vec3 origin_mm;
    Vec3 direction;  ///< unit
    float min_mm = 0;
    float max_mm = 1e30f;
    bool blends = false;  ///< stops wherever a blended material shows, not only at an alpha of 0.5
};

/// Where a ray met a triangle; attributes come from RayScene::surface_at.
struct RayHit {
    float distance_mm = 0;
    uint32_t object = 0;    ///< index of the mesh given to build(), or kCapObject
    uint32_t triangle = 0;  ///< of that mesh
    float u = 0, v = 0;     ///< barycentric weights of the second and third corner
    Vec3 n_face;            ///< unit, by winding
};

/// Room for hits, not set to anything first: to clear it costs as much as a short ray.
template <size_t kMost>
class HitBuffer {
  public:
    [[nodiscard]] std::span<RayHit> hits() { return {reinterpret_cast<RayHit*>(bytes_), kMost}; }

  private:
    alignas(RayHit) std::byte bytes_[kMost * sizeof(RayHit)];
};

struct SurfaceAttributes {
    Vec3 p_world_mm;        ///< interpolated between the corners: on the triangle to rounding
    Vec3 n_face_world;      ///< unit, by winding
    Vec3 n_geometry_world;  ///< unit, interpolated vertex normal
    Vec4 tangent_world;     ///< interpolated, not orthonormal; zero when the mesh has none
    Vec2 uv;
    Vec4 color_linear = {1, 1, 1, 1};  ///< the vertices' own
    uint32_t material = 0;
    float tension = 0;  ///< mesh/tension.h
    /// p_world_mm lifted onto the smooth surface that the vertex normals describe, so that a shadow ray does
    /// not meet the facets beside it: Hanika 2021, Hacking the Shadow Terminator, Ray Tracing Gems II,
    /// chapter 4.
    Vec3 p_smooth_mm;
    UvFootprint footprint = {};  ///< what maps are averaged over; surface_at leaves it zero
};

/// Whether alpha maps cut some of the objects out: what rays find then depends on images, which add_shape()
/// (scene/scene_hash.h) does not hash, so it is not cached.
[[nodiscard]] bool has_cut_outs(std::span<const SceneObject> objects);

/// Immutable once built; every query is const and safe from any thread. Keeps pointers to the meshes: they
/// must outlive it and not change. About 100 bytes a triangle; 20 ms for 17,684 triangles.
class RayScene {
  public:
    /// Rays pass what the alpha maps of materials of class `other` cut out.
    /// Errors: no triangle at all, the ray library cannot start, or an alpha map cannot be read.
    /// With `flesh` (one per object, from find_flesh) hidden skin is excluded, and the sets `flesh` and
    /// `capped_cavities` exist; without it all skin is.
    [[nodiscard]] static Result<RayScene> build(std::span<const SceneObject> objects,
                                                std::span<const Flesh> flesh = {});
    /// One mesh, all of it skin.
    [[nodiscard]] static Result<RayScene> build(const Mesh& mesh);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    [[nodiscard]] std::optional<RayHit> closest_hit(RaySet set, const Ray& ray) const;
    [[nodiscard]] bool occluded(RaySet set, const Ray& ray) const;
    /// Everything between min_mm and max_mm, unordered; at most hits.size() of them, returns how many.
    [[nodiscard]] size_t all_hits(RaySet set, const Ray& ray, std::span<RayHit> hits) const;

    /// Alpha of map and vertices for materials that are cut out or blended; else 1.
    [[nodiscard]] float alpha_at(const RayHit& hit) const;

    [[nodiscard]] bool has(RaySet set) const;
    [[nodiscard]] SurfaceAttributes surface_at(const RayHit& hit) const;
    /// How far uv moves for a step within the plane of the triangle that was hit; zero without uvs.
    [[nodiscard]] Vec2 uv_step(const RayHit& hit, Vec3 step_mm) const;
    [[nodiscard]] const Mesh& mesh(uint32_t object) const;

    struct Bounds {
        Vec3 min_mm, max_mm;
    };
    /// The box of a set that has triangles.
    [[nodiscard]] Bounds bounds(RaySet set) const;

    /// A length below which two points of this scene are the same to a ray: 2e-6 of its extent from the
    /// origin.
    [[nodiscard]] float epsilon_mm() const;

  private:
    struct Impl;
    explicit RayScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The material of a triangle of the mesh.
[[nodiscard]] uint32_t material_of_triangle(const Mesh& mesh, uint32_t triangle);

}  // namespace dermis::inline rays
