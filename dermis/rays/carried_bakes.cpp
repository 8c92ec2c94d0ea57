#include "dermis/rays/carried_bakes.h"

#include <cstring>

#include "dermis/base/parallel.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/curvature_stencils.h"
#include "dermis/mesh/surface_frame.h"
#include "dermis/rays/diffused_normals_texel.h"
#include "dermis/rays/uv_raster.h"

namespace dermis::inline rays {
namespace {

// Of each vertex.
struct FrameSource {
    std::vector<Vec3> normals, directions;

    explicit FrameSource(const Mesh& mesh) : normals(mesh.normals), directions(surface_directions(mesh)) {
        normals.resize(mesh.positions_mm.size(), Vec3{0, 0, 1});
    }
};

struct NormalsTexel {
    Vec4 red, green;  // mean; unevenness p, q
};

NormalsTexel moved_texel(const SurfaceFrame& from, const SurfaceFrame& to, const NormalsTexel& texel) {
    const Vec3 mean = {texel.red.x, texel.red.y, texel.red.z};
    if (from == to || !(length(mean) > 0)) return texel;
    const Vec3 red = moved(from, to, mean),
               green = moved(from, to, Vec3{texel.green.x, texel.green.y, texel.green.z});
    // The spread is 1 + [[p, q], [q, -p]] along the axes of the frame around the mean.
    const float p = texel.red.w, q = texel.green.w;
    const SpreadFrame at_rest(normalize(mean)), posed(normalize(red));
    const Vec3 x = moved(from, to, at_rest.x), z = moved(from, to, at_rest.z);
    const auto uneven = [&](Vec3 a, Vec3 c) {
        return p * (dot(x, a) * dot(x, c) - dot(z, a) * dot(z, c)) +
               q * (dot(x, a) * dot(z, c) + dot(z, a) * dot(x, c));
    };
    return {{red.x, red.y, red.z, 0.5f * (uneven(posed.x, posed.x) - uneven(posed.z, posed.z))},
            {green.x, green.y, green.z, uneven(posed.x, posed.z)}};
}

Vec4 decoded(const DiffusedNormals::Texel& texel) {
    return {decoded_part(texel[0]), decoded_part(texel[1]), decoded_part(texel[2]), decoded_part(texel[3])};
}

SurfaceFrame frame_at(const Mesh& mesh, const FrameSource& source, const UvTexel& place) {
    const uint32_t* corner = &mesh.indices[3 * size_t(place.triangle)];
    const auto mix = [&](const std::vector<Vec3>& values) {
        return values[corner[0]] * (1 - place.u - place.v) + values[corner[1]] * place.u +
               values[corner[2]] * place.v;
    };
    return {normalize(mix(source.normals)), mix(source.directions)};
}

std::vector<FrameSource> frame_sources(std::span<const SceneObject> objects) {
    std::vector<FrameSource> sources;
    for (const SceneObject& object : objects) sources.emplace_back(object.mesh);
    return sources;
}

// One tensor a vertex, by its frames at rest and in the pose.
std::vector<CurvatureTensor> by_frames(const Mesh& rest, const Mesh& posed, const auto& tensor_of) {
    const FrameSource from(rest), to(posed);
    std::vector<CurvatureTensor> tensors;
    tensors.reserve(rest.curvatures_per_mm.size());
    for (uint32_t v = 0; v < rest.curvatures_per_mm.size(); ++v)
        tensors.push_back(tensor_of(v, SurfaceFrame(from.normals[v], from.directions[v]),
                                    SurfaceFrame(to.normals[v], to.directions[v])));
    return tensors;
}

}  // namespace

std::vector<CurvatureTensor> carried_curvatures(const Mesh& rest, const Mesh& posed) {
    return by_frames(rest, posed, [&](uint32_t v, const SurfaceFrame& before, const SurfaceFrame& after) {
        return moved(before, after, rest.curvatures_per_mm[v]);
    });
}

std::vector<CurvatureTensor> followed_curvatures(const Mesh& rest, const Mesh& posed) {
    const CurvatureAtRest curvature(rest, kCurvatureSmoothingMm);
    return by_frames(rest, posed, [&](uint32_t v, const SurfaceFrame& before, const SurfaceFrame& after) {
        return curvature.posed(v, before, after, posed.positions_mm);
    });
}

DiffusedNormals carried_normals(std::span<const SceneObject> rest, std::span<const SceneObject> posed,
                                const DiffusedNormals& baked) {
    const UvRaster raster = rasterise_uv(rest, baked.size, baked.size, is_skin, UvSet::atlas);
    const std::vector<FrameSource> from = frame_sources(rest), to = frame_sources(posed);
    Image red(baked.size, baked.size, 4), green(baked.size, baked.size, 4);
    parallel_for(raster.texels.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const UvTexel& place = raster.texels[i];
            if (!place.covered()) continue;
            const NormalsTexel texel =
                moved_texel(frame_at(rest[place.object].mesh, from[place.object], place),
                            frame_at(posed[place.object].mesh, to[place.object], place),
                            {decoded(baked.red[i]), decoded(baked.green[i])});
            std::memcpy(&red.floats()[4 * i], &texel.red, sizeof texel.red);
            std::memcpy(&green.floats()[4 * i], &texel.green, sizeof texel.green);
        }
    });
    return encoded_normals(std::move(red), std::move(green), coverage_mask(raster));
}

}  // namespace dermis::inline rays
