// Attributes of a mesh's surface where a ray met it.

#include <algorithm>

#include "dermis/rays/ray_scene.h"

namespace dermis::inline rays {

SurfaceAttributes RayScene::surface_at(const RayHit& hit) const {
    const Mesh& mesh = this->mesh(hit.object);
    const uint32_t* corner = &mesh.indices[3 * size_t(hit.triangle)];
    const float weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};
    SurfaceAttributes surface{.n_face_world = hit.n_face,
                              .material = material_of_triangle(mesh, hit.triangle)};
    Vec3 normal;
    for (int i = 0; i < 3; ++i) {
        surface.p_world_mm += mesh.positions_mm[corner[i]] * weight[i];
        if (!mesh.normals.empty()) normal += mesh.normals[corner[i]] * weight[i];
        if (!mesh.tensions.empty()) surface.tension += mesh.tensions[corner[i]] * weight[i];
        if (!mesh.uvs.empty()) surface.uv = surface.uv + mesh.uvs[corner[i]] * weight[i];
        if (!mesh.colors_linear.empty()) {
            const Vec4 c = mesh.colors_linear[corner[i]];
            Vec4& sum = surface.color_linear;
            if (i == 0) sum = {};
            sum = {sum.x + c.x * weight[i], sum.y + c.y * weight[i], sum.z + c.z * weight[i],
                   sum.w + c.w * weight[i]};
        }
        if (!mesh.tangents.empty()) {
            const Vec4 t = mesh.tangents[corner[i]];
            Vec4& sum = surface.tangent_world;
            sum = {sum.x + t.x * weight[i], sum.y + t.y * weight[i], sum.z + t.z * weight[i], t.w};
        }
    }
    surface.n_geometry_world = dot(normal, normal) > 1e-12f ? normalize(normal) : hit.n_face;
    // The point is moved up towards each corner's tangent plane that it lies below.
    surface.p_smooth_mm = surface.p_world_mm;
    if (!mesh.normals.empty())
        for (int i = 0; i < 3; ++i) {
            const Vec3 n = mesh.normals[corner[i]];
            const float above_mm = dot(surface.p_world_mm - mesh.positions_mm[corner[i]], n);
            surface.p_smooth_mm += n * (-std::min(above_mm, 0.0f) * weight[i]);
        }
    return surface;
}

Vec2 RayScene::uv_step(const RayHit& hit, Vec3 step_mm) const {
    const Mesh& mesh = this->mesh(hit.object);
    if (mesh.uvs.empty()) return {};
    const uint32_t* corner = &mesh.indices[3 * size_t(hit.triangle)];
    const Vec3 p = mesh.positions_mm[corner[0]];
    const Vec3 e1 = mesh.positions_mm[corner[1]] - p, e2 = mesh.positions_mm[corner[2]] - p;
    // step = a e1 + b e2, from the normal equations.
    const float e11 = dot(e1, e1), e12 = dot(e1, e2), e22 = dot(e2, e2), s1 = dot(step_mm, e1),
                s2 = dot(step_mm, e2);
    const float determinant = e11 * e22 - e12 * e12;
    if (!(determinant > 0)) return {};
    const float a = (s1 * e22 - s2 * e12) / determinant, b = (s2 * e11 - s1 * e12) / determinant;
    const Vec2 uv = mesh.uvs[corner[0]], uv1 = mesh.uvs[corner[1]], uv2 = mesh.uvs[corner[2]];
    return {(uv1.x - uv.x) * a + (uv2.x - uv.x) * b, (uv1.y - uv.y) * a + (uv2.y - uv.y) * b};
}

uint32_t material_of_triangle(const Mesh& mesh, uint32_t triangle) {
    const auto after =
        std::upper_bound(mesh.submeshes.begin(), mesh.submeshes.end(), 3 * triangle,
                         [](uint32_t index, const Submesh& submesh) { return index < submesh.first_index; });
    return after == mesh.submeshes.begin() ? 0 : std::prev(after)->material;
}

}  // namespace dermis::inline rays
