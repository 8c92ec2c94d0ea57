#include "dermis/rays/uv_raster.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline rays {
namespace {

bool within_unit(Vec2 uv) {
    // A small tolerance, since exporters round the borders of an atlas.
    return uv.x >= -1e-4f && uv.y >= -1e-4f && uv.x <= 1.0001f && uv.y <= 1.0001f;
}

// Twice the signed area of (a, b, p). In double: at 16384 texels floats would leave gaps.
double edge(const double (&a)[2], const double (&b)[2], double x, double y) {
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

// Fill rule for a triangle of positive area in a y-down raster: edges that run up, or to the right when
// horizontal, own their points.
bool owns(const double (&a)[2], const double (&b)[2]) {
    return b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
}

void draw(UvRaster& raster, uint32_t object, uint32_t triangle, const Vec2 (&uv)[3]) {
    double p[3][2];
    for (int i = 0; i < 3; ++i) {
        p[i][0] = double(uv[i].x) * raster.width;
        p[i][1] = double(uv[i].y) * raster.height;
    }
    double area = edge(p[0], p[1], p[2][0], p[2][1]);
    if (area == 0 || !std::isfinite(area)) return;
    const bool flipped = area < 0;
    if (flipped) {
        std::swap(p[1], p[2]);
        area = -area;
    }
    const auto range = [&](int axis, int size) {
        const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
        return std::pair{std::max(int(std::floor(low - 0.5)), 0), std::min(int(std::ceil(high)), size - 1)};
    };
    const auto [x0, x1] = range(0, raster.width);
    const auto [y0, y1] = range(1, raster.height);
    const bool own[3] = {owns(p[1], p[2]), owns(p[2], p[0]), owns(p[0], p[1])};
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const double w[3] = {edge(p[1], p[2], x + 0.5, y + 0.5), edge(p[2], p[0], x + 0.5, y + 0.5),
                                 edge(p[0], p[1], x + 0.5, y + 0.5)};
            bool inside = true;
            for (int i = 0; i < 3; ++i) inside = inside && (w[i] > 0 || (w[i] == 0 && own[i]));
            if (!inside) continue;
            UvTexel& texel = raster.texels[size_t(y) * size_t(raster.width) + size_t(x)];
            texel.covered() ? ++raster.overlapping : ++raster.covered;
            const float second = float(w[1] / area), third = float(w[2] / area);
            texel = {object, triangle, flipped ? third : second, flipped ? second : third};
        }
}

}  // namespace

bool is_skin(const SceneObject& object, uint32_t material) {
    return material >= object.classes.size() || object.classes[material] == MaterialClass::skin;
}

UvRaster rasterise_uv(std::span<const SceneObject> objects, int width, int height,
                      const MaterialFilter& wanted) {
    UvRaster raster{
        .width = width, .height = height, .texels = std::vector<UvTexel>(size_t(width) * size_t(height))};
    for (uint32_t o = 0; o < objects.size(); ++o) {
        const Mesh& mesh = objects[o].mesh;
        if (mesh.uvs.empty()) continue;
        for (const Submesh& submesh : mesh.submeshes) {
            if (!wanted(objects[o], submesh.material)) continue;
            const uint32_t first = submesh.first_index / 3;
            for (uint32_t t = first; t < first + submesh.index_count / 3; ++t) {
                const uint32_t* corner = &mesh.indices[3 * size_t(t)];
                const Vec2 uv[3] = {mesh.uvs[corner[0]], mesh.uvs[corner[1]], mesh.uvs[corner[2]]};
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

Vec3 face_normal(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
    const Vec3 a = mesh.positions_mm[corner[0]];
    return normalize(cross(mesh.positions_mm[corner[1]] - a, mesh.positions_mm[corner[2]] - a));
}

}  // namespace dermis::inline rays
