#include "dermis/scene/place_mesh.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "dermis/mesh/subdivide.h"

namespace dermis::inline scene {
namespace {

// Columns are the images of the axes.
struct Rotation {
    Vec3 x, y, z;

    explicit Rotation(Vec3 angle_rad) {
        const float sx = std::sin(angle_rad.x), cx = std::cos(angle_rad.x);
        const float sy = std::sin(angle_rad.y), cy = std::cos(angle_rad.y);
        const float sz = std::sin(angle_rad.z), cz = std::cos(angle_rad.z);
        x = {cz * cy, sz * cy, -sy};
        y = {cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx};
        z = {cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx};
    }
    // R S R^T: R over the columns of S, then over the rows of that.
    [[nodiscard]] CurvatureTensor tensor(const CurvatureTensor& s) const {
        const Vec3 sx = s * row(0), sy = s * row(1), sz = s * row(2);
        const Vec3 cx = (*this)(sx), cy = (*this)(sy), cz = (*this)(sz);
        return {{cx.x, cy.y, cz.z}, {cz.y, cz.x, cy.x}};
    }
    [[nodiscard]] Vec3 row(int r) const {
        if (r == 0) return {x.x, y.x, z.x};
        return r == 1 ? Vec3{x.y, y.y, z.y} : Vec3{x.z, y.z, z.z};
    }
    Vec3 operator()(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace

void place_mesh(Mesh& mesh, const Placement& placement) {
    const Rotation rotate(placement.rotation_rad);
    for (std::vector<Vec3>* positions_mm : {&mesh.positions_mm, &mesh.rest_positions_mm})
        for (Vec3& p : *positions_mm) p = rotate(p * placement.scale) + placement.translation_mm;
    for (Vec3& n : mesh.normals) n = rotate(n);
    for (Vec4& t : mesh.tangents) {
        const Vec3 turned = rotate({t.x, t.y, t.z});
        t = {turned.x, turned.y, turned.z, t.w};
    }
    for (CurvatureTensor& tensor : mesh.curvatures_per_mm) {
        tensor = rotate.tensor(tensor);
        tensor.diagonal *= 1 / placement.scale;
        tensor.mixed *= 1 / placement.scale;
    }
}

void hide_materials(Mesh& mesh, const std::vector<bool>& hidden) {
    std::vector<uint32_t> indices;
    std::vector<Submesh> submeshes;
    for (const Submesh& submesh : mesh.submeshes) {
        if (hidden.at(submesh.material)) continue;
        submeshes.push_back(submesh);
        submeshes.back().first_index = uint32_t(indices.size());
        const auto first = mesh.indices.begin() + submesh.first_index;
        indices.insert(indices.end(), first, first + submesh.index_count);
    }
    mesh.indices = std::move(indices);
    mesh.submeshes = std::move(submeshes);
}

Result<void> apply_displacement(Mesh& mesh) {
    const auto displaced = [](const Material& m) {
        return m.displacement_map.present() && m.displacement_amplitude_mm != 0;
    };
    const auto found = std::ranges::find_if(mesh.materials, displaced);
    if (found == mesh.materials.end()) return {};
    const Material material = *found;
    const ImageSource& source = material.displacement_map;
    if (mesh.materials.size() > 1)
        return Error{source.name + ": displaces a mesh of " + std::to_string(mesh.materials.size()) +
                     " materials; only a mesh of one can be displaced without tearing"};
    if (mesh.uvs.size() != mesh.positions_mm.size())
        return Error{source.name + ": displaces a mesh that has no UVs"};
    DERMIS_TRY_ASSIGN(const LoadedImage loaded,
                      source.encoded.empty() ? read_image(source.name, ImageUse::data)
                                             : decode_image(source.encoded, source.name, ImageUse::data));
    const Image heights = to_linear_float(loaded.image);
    displace(mesh, [&](Vec2 uv) { return sample_bilinear(heights, inside_image(source, uv)).x; },
             {.mid = material.displacement_mid, .amplitude_mm = material.displacement_amplitude_mm});
    mesh.file_vertices.clear();
    return {};
}

}  // namespace dermis::inline scene
