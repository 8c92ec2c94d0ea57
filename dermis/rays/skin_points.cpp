#include "dermis/rays/skin_points.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/image/dilate.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/mapped_normal.h"
#include "dermis/rays/texture.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline rays {
namespace {

using Cube = std::array<int, 3>;

Cube cube_of(Vec3 p_mm, float side_mm) {
    const auto part = [&](float x) { return int(std::floor(std::clamp(x / side_mm, -1e6f, 1e6f))); };
    return {part(p_mm.x), part(p_mm.y), part(p_mm.z)};
}

uint64_t key_of(Cube cube) {
    const auto part = [](int x) { return uint64_t(x + (1 << 20)) & 0x1FFFFF; };
    return part(cube[0]) << 42 | part(cube[1]) << 21 | part(cube[2]);
}

// One of some 200 ranges of directions, about 15 degrees wide: points of a small sphere and of a sharp edge
// stay apart, and so do two walls that face each other, however thin the gap or the flesh between them is.
uint32_t facing(Vec3 n) {
    const auto part = [](float x) { return uint32_t(std::clamp(int(std::lround(4 * x)), -4, 4) + 4); };
    return (part(n.x) * 9 + part(n.y)) * 9 + part(n.z);
}

SkinPoint point_of(const SkinTexel& texel) {
    const Vec3 n = texel.n;
    return {.p_mm = texel.p_mm,
            .area_mm2 = texel.area_mm2,
            .n_geometry = texel.n_geometry,
            .n = n,
            .squares = n * n,
            .mixed = {n.y * n.z, n.x * n.z, n.x * n.y}};
}

SkinCube bounded(size_t first, std::span<const SkinPoint> points) {
    SkinCube cube{first, points, points[0].p_mm, points[0].p_mm};
    for (const SkinPoint& point : points) {
        cube.low_mm = {std::min(cube.low_mm.x, point.p_mm.x), std::min(cube.low_mm.y, point.p_mm.y),
                       std::min(cube.low_mm.z, point.p_mm.z)};
        cube.high_mm = {std::max(cube.high_mm.x, point.p_mm.x), std::max(cube.high_mm.y, point.p_mm.y),
                        std::max(cube.high_mm.z, point.p_mm.z)};
    }
    return cube;
}

// Skin inside a cavity has no area; it has a place all the same.
constexpr float kLeastArea = 1e-12f;

}  // namespace

struct SkinPoints::Place {
    uint64_t cube;
    uint32_t part, number;  // part: the small cube in the cube, and the facing

    friend bool operator<(const Place& a, const Place& b) {
        return a.cube != b.cube ? a.cube < b.cube : a.part != b.part ? a.part < b.part : a.number < b.number;
    }
};

void SkinPoints::sort(std::vector<Place> places,
                      const std::function<SkinPoint(std::span<const Place>)>& merged) {
    std::sort(places.begin(), places.end());
    std::vector<size_t> starts;
    for (size_t begin = 0, end = 0; begin < places.size(); begin = end) {
        while (end < places.size() && places[end].cube == places[begin].cube &&
               places[end].part == places[begin].part)
            ++end;
        if (begin == 0 || places[begin].cube != places[begin - 1].cube) {
            index_.emplace(places[begin].cube, starts.size());
            starts.push_back(points_.size());
        }
        points_.push_back(merged(std::span(places).subspan(begin, end - begin)));
    }
    starts.push_back(points_.size());
    for (size_t i = 0; i + 1 < starts.size(); ++i)
        cubes_.push_back(
            bounded(starts[i], std::span(points_).subspan(starts[i], starts[i + 1] - starts[i])));
}

SkinPoints::SkinPoints(std::span<const SkinTexel> texels, float cube_mm) : cube_mm_(cube_mm) {
    std::vector<Place> places;
    places.reserve(texels.size());
    points_.reserve(texels.size());
    order_.reserve(texels.size());
    for (size_t i = 0; i < texels.size(); ++i)
        places.push_back({key_of(cube_of(texels[i].p_mm, cube_mm)), uint32_t(i), uint32_t(i)});
    sort(std::move(places), [&](std::span<const Place> one) {
        order_.push_back(one[0].number);
        return point_of(texels[one[0].number]);
    });
}

SkinPoints::SkinPoints(const SkinPoints& finer, float side_mm, float cube_mm) {
    const int sides = std::max(int(std::lround(cube_mm / side_mm)), 1);
    cube_mm_ = side_mm * float(sides);
    std::vector<Place> places;
    places.reserve(finer.points_.size());
    for (const SkinPoint& point : finer.points_) {
        const Cube small = cube_of(point.p_mm, side_mm), cube = cube_of(point.p_mm, cube_mm_);
        uint32_t part = facing(point.n_geometry);
        for (size_t axis = 0; axis < 3; ++axis)
            part = part << 7 | uint32_t(std::clamp(small[axis] - cube[axis] * sides, 0, 127));
        places.push_back({key_of(cube), part, uint32_t(finer.number_of(point))});
    }
    sort(std::move(places), [&](std::span<const Place> parts) {
        SkinPoint sum;
        float total = 0;
        for (const Place& place : parts) {
            const SkinPoint& point = finer.points_[place.number];
            const float weight = std::max(point.area_mm2, kLeastArea);
            total += weight;
            sum.area_mm2 += point.area_mm2;
            sum.p_mm += point.p_mm * weight;
            sum.variance_mm2 += point.variance_mm2 * weight;
            sum.n_geometry += point.n_geometry * weight;
            sum.n += point.n * weight;
            sum.squares += point.squares * weight;
            sum.mixed += point.mixed * weight;
        }
        const float scale = 1 / total;
        const Vec3 centre_mm = sum.p_mm * scale;
        for (const Place& place : parts) {
            const SkinPoint& point = finer.points_[place.number];
            const Vec3 way_mm = point.p_mm - centre_mm;
            sum.variance_mm2 += 0.5f * dot(way_mm, way_mm) * std::max(point.area_mm2, kLeastArea);
        }
        return SkinPoint{.p_mm = centre_mm,
                         .area_mm2 = sum.area_mm2,
                         .variance_mm2 = sum.variance_mm2 * scale,
                         .n_geometry = normalize(sum.n_geometry),
                         .n = sum.n * scale,
                         .squares = sum.squares * scale,
                         .mixed = sum.mixed * scale};
    });
}

std::vector<const SkinCube*> SkinPoints::around(Vec3 low_mm, Vec3 high_mm) const {
    std::vector<const SkinCube*> found;
    const Cube low = cube_of(low_mm, cube_mm_), high = cube_of(high_mm, cube_mm_);
    for (int x = low[0]; x <= high[0]; ++x)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int z = low[2]; z <= high[2]; ++z)
                if (const auto i = index_.find(key_of({x, y, z})); i != index_.end())
                    found.push_back(&cubes_[i->second]);
    return found;
}

void SkinPoints::for_each_cube(const SkinPoints& others, float reach_mm, size_t step,
                               const std::function<void(const SkinCube& cube, Near near)>& body) const {
    const Vec3 reach{reach_mm, reach_mm, reach_mm};
    parallel_for((cubes_.size() + step - 1) / step, 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const SkinCube& cube = cubes_[i * step];
            body(cube, others.around(cube.low_mm - reach, cube.high_mm + reach));
        }
    });
}

namespace {

// As mean_normal_world() of shaders/include/surface.glsl.
Vec3 mean_normal(const Material& material, const NormalMaps& maps, const SurfaceAttributes& at) {
    const Vec3 n = at.n_geometry_world;
    if (maps.normal->empty()) return n;
    const Vec3 mapped = mapped_normal(material, maps, at);
    if (material.normal_space == NormalSpace::object) return n + (mapped - n) * material.normal_scale;
    const Vec3 along{at.tangent_world.x, at.tangent_world.y, at.tangent_world.z};
    const Vec3 t = normalize(along - n * dot(n, along));
    if (dot(t, t) < 0.5f) return n;
    const Vec3 b = cross(n, t) * (at.tangent_world.w < 0 ? -1.0f : 1.0f);
    return t * (mapped.x * material.normal_scale) + b * (mapped.y * material.normal_scale) + n * mapped.z;
}

// As the renderer uploads a normal map: a texel whose length is not 1, as in a JPEG file, is no spread of
// normals.
void make_unit(Image& image) {
    image = to_linear_float(image);
    if (image.channels < 3) return;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        float* texel = &image.floats()[size_t(image.channels) * i];
        const Vec3 n = normalize(Vec3{texel[0], texel[1], texel[2]} * 2.0f - Vec3{1, 1, 1});
        texel[0] = n.x * 0.5f + 0.5f, texel[1] = n.y * 0.5f + 0.5f, texel[2] = n.z * 0.5f + 0.5f;
    }
}

Result<Texture> normals_of(const Mesh& mesh, const Material& material, const ImageSource& source) {
    if (!source.present()) return Texture();
    DERMIS_TRY_ASSIGN(Image image, load_image_source(source, ImageUse::data));
    if (material.dilate_texels > 0)
        dilate(image, atlas_mask(mesh, image.width, image.height), material.dilate_texels);
    make_unit(image);
    return Texture(image, source.wrap_u, source.wrap_v);
}

// Square millimetres of a triangle over its area in UV.
float mm2_per_uv2(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
    const Vec3 origin = mesh.positions_mm[corner[0]];
    const std::vector<Vec2>& uvs = atlas_uvs_of(mesh);
    const Vec2 uv = uvs[corner[0]], u = uvs[corner[1]] - uv, v = uvs[corner[2]] - uv;
    const float area = std::abs(u.x * v.y - u.y * v.x);
    return area > 0
               ? length(cross(mesh.positions_mm[corner[1]] - origin, mesh.positions_mm[corner[2]] - origin)) /
                     area
               : 0;
}

// The UVs of the file that a texel of the atlas covers.
UvFootprint texel_footprint(const Mesh& mesh, uint32_t triangle, int size) {
    const float side = 1 / float(size);
    if (mesh.atlas_uvs.empty()) return {{side, 0}, {0, side}};
    if (mesh.uvs.empty()) return {};
    const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
    const auto edge = [&](const std::vector<Vec2>& uvs, size_t k) { return uvs[corner[k]] - uvs[corner[0]]; };
    const Vec2 a = edge(mesh.atlas_uvs, 1), b = edge(mesh.atlas_uvs, 2);
    const float area = cross(a, b);
    if (area == 0) return {};
    const Vec2 uv_a = edge(mesh.uvs, 1), uv_b = edge(mesh.uvs, 2);
    return {(uv_a * b.y - uv_b * a.y) * (side / area), (uv_b * a.x - uv_a * b.x) * (side / area)};
}

}  // namespace

struct SkinTexelReader::Impl {
    struct Normals {
        Texture normal, stretch, compress;  // empty: the material has none
        WrinkleWeights weights = {};
    };
    const Scene* scene;
    std::vector<Flesh> flesh;
    RayScene rays;
    std::vector<std::vector<Normals>> normal_maps;  // of each object and material
};

SkinTexelReader::SkinTexelReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SkinTexelReader::~SkinTexelReader() = default;
SkinTexelReader::SkinTexelReader(SkinTexelReader&&) noexcept = default;

Result<SkinTexelReader> SkinTexelReader::create(const Scene& scene) {
    DERMIS_TRY_ASSIGN(std::vector<Flesh> flesh, find_flesh(scene.objects));
    DERMIS_TRY_ASSIGN(RayScene rays, RayScene::build(scene.objects));
    std::vector<std::vector<Impl::Normals>> maps;
    for (const SceneObject& object : scene.objects) {
        auto& of_object = maps.emplace_back(object.mesh.materials.size());
        for (size_t i = 0; i < of_object.size(); ++i) {
            const Material& material = object.mesh.materials[i];
            if (object.classes[i] != MaterialClass::skin) continue;
            DERMIS_TRY_ASSIGN(of_object[i].normal, normals_of(object.mesh, material, material.normal_map));
            if (!shows_wrinkles(object)) continue;
            of_object[i].weights = wrinkle_weights(material, object.target_weights);
            DERMIS_TRY_ASSIGN(of_object[i].stretch,
                              normals_of(object.mesh, material, material.wrinkle_stretch_map));
            DERMIS_TRY_ASSIGN(of_object[i].compress,
                              normals_of(object.mesh, material, material.wrinkle_compress_map));
        }
    }
    return SkinTexelReader(
        std::make_unique<Impl>(Impl{&scene, std::move(flesh), std::move(rays), std::move(maps)}));
}

SkinTexels SkinTexelReader::read(int size) const {
    const UvRaster raster = rasterise_uv(impl_->scene->objects, size, size, is_skin, UvSet::atlas);
    SkinTexels skin{.size = size, .texels = {}, .coverage = coverage_mask(raster)};
    for (size_t i = 0; i < raster.texels.size(); ++i)
        if (raster.texels[i].covered()) skin.texels.push_back({.index = uint32_t(i)});
    parallel_for(skin.texels.size(), 1024, [&](size_t begin, size_t end) {
        for (SkinTexel& texel : std::span(skin.texels).subspan(begin, end - begin)) {
            const UvTexel& place = raster.texels[texel.index];
            const Mesh& mesh = impl_->scene->objects[place.object].mesh;
            SurfaceAttributes at = impl_->rays.surface_at(place.as_hit(face_normal(mesh, place.triangle)));
            at.footprint = texel_footprint(mesh, place.triangle, size);
            texel.p_mm = at.p_world_mm;
            texel.n_geometry = at.n_geometry_world;
            const Impl::Normals& maps = impl_->normal_maps[place.object][at.material];
            texel.n = mean_normal(mesh.materials[at.material],
                                  {.normal = &maps.normal,
                                   .stretch = &maps.stretch,
                                   .compress = &maps.compress,
                                   .weights = maps.weights},
                                  at);
            const bool seen = impl_->flesh[place.object].faces[place.triangle] == SkinFace::visible;
            texel.area_mm2 = seen ? mm2_per_uv2(mesh, place.triangle) / (float(size) * float(size)) : 0;
        }
    });
    return skin;
}

float typical_texel_mm(const SkinTexels& skin) {
    std::vector<float> areas;
    double total = 0, sum = 0;
    for (const SkinTexel& texel : skin.texels) areas.push_back(texel.area_mm2), total += texel.area_mm2;
    std::ranges::sort(areas);
    for (const float area : areas)
        if ((sum += area) >= 0.5 * total) return std::sqrt(area);
    return 0;
}

}  // namespace dermis::inline rays
