#include "subjects/bust/bust.h"

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "subjects/bust/head_mesh.h"
#include "subjects/bust/maps.h"
#include "subjects/bust/skin.h"

namespace dermis {

using namespace bust;

namespace {

// Part of the cache's key: raise it when meshing, flattening or painting change. Changes of the shape and of
// the skin are in the key already, by sampled values.
constexpr uint32_t kGeneration = 6;

Vec3 to_float(Point p) {
    return {float(p.x), float(p.y), float(p.z)};
}

void add_material(Mesh& mesh) {
    mesh.submeshes = {
        {.name = "bust", .first_index = 0, .index_count = uint32_t(mesh.indices.size()), .material = 0}};
    Material skin;
    skin.name = "skin";
    skin.base_color_linear = {1, 1, 1};
    skin.roughness = 1;
    skin.ior = 1.4f;
    mesh.materials = {skin};
}

Mesh to_mesh(const Atlas& atlas, const BustField& field) {
    Mesh mesh;
    const size_t n = atlas.mesh.points.size();
    mesh.positions_mm.resize(n);
    mesh.normals.resize(n);
    mesh.uvs.resize(n);
    std::vector<Point> tangents(n);
    for (const auto& t : atlas.mesh.triangles) {
        const auto &p = atlas.mesh.points, &uv = atlas.uvs;
        const Point e = p[t[1]] - p[t[0]], f = p[t[2]] - p[t[0]], a = uv[t[1]] - uv[t[0]],
                    b = uv[t[2]] - uv[t[0]];
        // v runs down in a chart seen upright from outside, so its area is negative; only the direction is
        // kept.
        const Point along_u = (e * b.y - f * a.y) * (a.x * b.y - a.y * b.x < 0 ? -1 : 1);
        for (const int v : t) tangents[size_t(v)] = tangents[size_t(v)] + unit(along_u) * length(cross(e, f));
        for (const int v : t) mesh.indices.push_back(uint32_t(v));
    }
    mesh.tangents.resize(n);
    parallel_for(n, 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Point p = atlas.mesh.points[i], normal = field.normal(p);
            Point t = tangents[i] - normal * dot(tangents[i], normal);
            if (dot(t, t) < 1e-20)
                t = cross(std::abs(normal.y) < 0.9 ? Point{0, 1, 0} : Point{1, 0, 0}, normal);
            t = unit(t);
            mesh.positions_mm[i] = to_float(p);
            mesh.normals[i] = to_float(normal);
            mesh.tangents[i] = {float(t.x), float(t.y), float(t.z), 1};
            mesh.uvs[i] = {float(atlas.uvs[i].x), float(atlas.uvs[i].y)};
        }
    });
    add_material(mesh);
    return mesh;
}

Bust blank_bust() {
    const int side = kBustMapSide;
    return {.mesh = {},
            .albedo = Image(side, side, 3, PixelFormat::u8, Encoding::srgb),
            .normal = Image(side, side, 3, PixelFormat::u8),
            .roughness = Image(side, side, 1, PixelFormat::u8),
            .specular = Image(side, side, 1, PixelFormat::u8),
            .kernel_size = Image(side, side, 1, PixelFormat::u8),
            .melanin = Image(side, side, 1, PixelFormat::u8),
            .blood = Image(side, side, 1, PixelFormat::u8)};
}

std::string cache_key(const BustParams& params) {
    Hasher hasher;
    hasher.add(kGeneration).add(kBustMapSide).add(params.seed);
    ParameterValues values(bust_parameters());
    values.put_all(params);
    for (const Parameter& row : bust_parameters().parameters)
        if (row.kind == ParameterKind::number) hasher.add(row.name).add(values.get(row)[0]);
    for (const double channel : skin_albedo({})) hasher.add(channel);
    const BustField field(params);
    const Hairs hairs(uint32_t(params.seed));
    for (int i = 0; i < 600; ++i) {
        // Sample points on a spiral over the head, which ends inside the features of the face.
        const double t = i / 600.0, a = i * 2.399963;
        const Point p = {80 * std::sin(a) * (1 - 0.6 * t), 130 - 320 * t,
                         110 * std::cos(a) * (0.4 + 0.6 * t)};
        hasher.add(float(field.distance_mm(p)));
        const SkinSample skin = skin_at(p, skin_zones(p), params, hairs);
        hasher.add(skin.pigments.melanin).add(skin.pigments.blood).add(skin.residue.x).add(skin.residue.y);
        hasher.add(skin.roughness).add(skin.height_mm);
        hasher.add(skin.kernel_size);
    }
    return hasher.hex();
}

}  // namespace

Result<Bust> build_bust(const BustParams& params, int map_side) {
    DERMIS_TRY(check_bust_params(params));
    const BustField field(params);
    const Atlas atlas = make_atlas(make_head_surface(field), field);
    SkinMaps maps = paint_maps(atlas, field, params, map_side);
    return Bust{.mesh = to_mesh(atlas, field),
                .albedo = std::move(maps.albedo),
                .normal = std::move(maps.normal),
                .roughness = std::move(maps.roughness),
                .specular = std::move(maps.specular),
                .kernel_size = std::move(maps.kernel_size),
                .melanin = std::move(maps.melanin),
                .blood = std::move(maps.blood)};
}

Result<Bust> make_bust(const BustParams& params) {
    DERMIS_TRY(check_bust_params(params));
    Result<Bust> bust = cached(
        "bust", cache_key(params), blank_bust(), [&] { return build_bust(params, kBustMapSide); },
        [](auto& b) {
            return std::tie(b.mesh.positions_mm, b.mesh.normals, b.mesh.tangents, b.mesh.uvs, b.mesh.indices,
                            b.albedo.bytes, b.normal.bytes, b.roughness.bytes, b.specular.bytes,
                            b.kernel_size.bytes, b.melanin.bytes, b.blood.bytes);
        });
    if (bust) add_material(bust->mesh);
    return bust;
}

}  // namespace dermis
