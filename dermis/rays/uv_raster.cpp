#include "dermis/rays/uv_raster.h"

#include <array>

#include "dermis/mesh/uv_texels.h"

namespace dermis::inline rays {
namespace {

bool within_unit(Vec2 uv) {
    // A small tolerance, since exporters round the borders of an atlas.
    return uv.x >= -1e-4f && uv.y >= -1e-4f && uv.x <= 1.0001f && uv.y <= 1.0001f;
}

void draw(UvRaster& raster, uint32_t object, uint32_t triangle, const std::array<Vec2, 3>& uv) {
    std::array<std::array<double, 2>, 3> corners;
    for (size_t i = 0; i < 3; ++i)
        corners[i] = {double(uv[i].x) * raster.width, double(uv[i].y) * raster.height};
    visit_texels_of(corners, {raster.width, raster.height}, [&](int x, int y, double v, double w) {
        UvTexel& texel = raster.texels[size_t(y) * size_t(raster.width) + size_t(x)];
        texel.covered() ? ++raster.overlapping : ++raster.covered;
        texel = {object, triangle, float(v), float(w)};
    });
}

}  // namespace

bool is_skin(const SceneObject& object, uint32_t material) {
    return material >= object.classes.size() || object.classes[material] == MaterialClass::skin;
}

UvRaster rasterise_uv(std::span<const SceneObject> objects, int width, int height,
                      const MaterialFilter& wanted, UvSet set) {
    UvRaster raster{
        .width = width, .height = height, .texels = std::vector<UvTexel>(size_t(width) * size_t(height))};
    for (uint32_t o = 0; o < objects.size(); ++o) {
        const Mesh& mesh = objects[o].mesh;
        const std::vector<Vec2>& uvs = set == UvSet::atlas ? atlas_uvs_of(mesh) : mesh.uvs;
        if (uvs.empty()) continue;
        for (const Submesh& submesh : mesh.submeshes) {
            if (!wanted(objects[o], submesh.material)) continue;
            const uint32_t first = submesh.first_index / 3;
            for (uint32_t t = first; t < first + submesh.index_count / 3; ++t) {
                const uint32_t* corner = &mesh.indices[3 * size_t(t)];
                const std::array<Vec2, 3> uv = {uvs[corner[0]], uvs[corner[1]], uvs[corner[2]]};
                if (within_unit(uv[0]) && within_unit(uv[1]) && within_unit(uv[2]))
                    draw(raster, o, t, uv);
                else
                    ++raster.outside;
            }
        }
    }
    return raster;
}

Image coverage_mask(const UvRaster& raster) {
    Image mask(raster.width, raster.height, 1, PixelFormat::u8);
    for (size_t i = 0; i < raster.texels.size(); ++i)
        mask.bytes[i] = raster.texels[i].covered() ? std::byte{255} : std::byte{0};
    return mask;
}

std::array<Vec3, 3> corners_mm(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
    return {mesh.positions_mm[corner[0]], mesh.positions_mm[corner[1]], mesh.positions_mm[corner[2]]};
}

float triangle_area_mm2(const Mesh& mesh, uint32_t triangle) {
    const auto [a, b, c] = corners_mm(mesh, triangle);
    return 0.5f * length(cross(b - a, c - a));
}

Vec3 face_normal(const Mesh& mesh, uint32_t triangle) {
    const auto [a, b, c] = corners_mm(mesh, triangle);
    return normalize(cross(b - a, c - a));
}

}  // namespace dermis::inline rays
