// OpenSubdiv's Far layer: a topology refiner over positions with one face-varying channel, refined uniformly,
// then evaluated at the limit.

#include "dermis/mesh/subdivide.h"

#include <fmt/core.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>

#include "dermis/base/progress.h"
#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
constexpr uint64_t kMaxFaces = 20'000'000;

// OpenSubdiv interpolates by weighted sums.
template <class Value>
struct Sum {
    Value value;
    void Clear() { value = {}; }
    void AddWithWeight(const Sum& other, float weight) { value = value + other.value * weight; }
};
using PositionSum = Sum<Vec3>;
using UvSum = Sum<Vec2>;

struct Cage {
    std::vector<int> face_sizes, positions, uvs;  // signed, as OpenSubdiv has its indices
    std::vector<Vec2> uv_values;
};

Cage prepare(const PolygonMesh& polygons) {
    Cage cage;
    cage.face_sizes.assign(polygons.face_sizes.begin(), polygons.face_sizes.end());
    cage.positions.assign(polygons.corner_positions.begin(), polygons.corner_positions.end());
    if (polygons.corner_uvs.empty()) return cage;
    std::vector<Vec2> corner_uvs;
    std::vector<uint32_t> words;
    for (size_t corner = 0; corner < polygons.corner_positions.size(); ++corner) {
        const uint32_t index = polygons.corner_uvs[corner];
        const Vec2 uv = index == kNoIndex ? Vec2{} : polygons.uvs[index];
        corner_uvs.push_back(uv);
        for (const uint32_t word : {polygons.corner_positions[corner], weld_key(uv.x), weld_key(uv.y)})
            words.push_back(word);
    }
    const Weld weld = weld_records(words, 3);
    cage.uvs.assign(weld.ids.begin(), weld.ids.end());
    for (const uint32_t corner : weld.first) cage.uv_values.push_back(corner_uvs[corner]);
    return cage;
}

std::unique_ptr<Far::TopologyRefiner> make_refiner(const Cage& cage, size_t position_count) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_BOUNDARIES);
    options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(position_count);
    descriptor.numFaces = int(cage.face_sizes.size());
    descriptor.numVertsPerFace = cage.face_sizes.data();
    descriptor.vertIndicesPerFace = cage.positions.data();
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = int(cage.uv_values.size());
    channel.valueIndices = cage.uvs.data();
    descriptor.numFVarChannels = cage.uvs.empty() ? 0 : 1;
    descriptor.fvarChannels = &channel;
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Factory::Options factory(Sdc::SCHEME_CATMARK, options);
    factory.validateFullTopology = true;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(descriptor, factory));
}

template <class Value, class Step>
std::vector<Sum<Value>> refine(const std::vector<Value>& values, int level, Progress& progress,
                               const Step& step) {
    std::vector<Sum<Value>> current;
    for (const Value& value : values) current.push_back({value});
    for (int l = 1; l <= level; ++l) {
        current = step(l, current);
        progress.advance();
    }
    return current;
}

// OpenSubdiv sizes the weights of a limit tangent by the most edges of a vertex and fills in one for each
// face (PrimvarRefiner::limit): where more faces than that meet, as with copies of a face, it writes out of
// bounds.
bool fits_tangent_masks(const Far::TopologyLevel& level) {
    int most_edges = 0, most_faces = 0;
    for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
        most_edges = std::max(most_edges, int(level.GetVertexEdges(vertex).size()));
        most_faces = std::max(most_faces, int(level.GetVertexFaces(vertex).size()));
    }
    return most_faces <= most_edges;
}

void evaluate_positions(const Far::TopologyRefiner& refiner, const std::vector<Vec3>& cage,
                        Progress& progress, PolygonMesh& out) {
    const Far::PrimvarRefiner primvars(refiner);
    const auto refined =
        refine(cage, refiner.GetMaxLevel(), progress, [&](int level, const std::vector<PositionSum>& from) {
            std::vector<PositionSum> to(size_t(refiner.GetLevel(level).GetNumVertices()));
            primvars.Interpolate(level, from, to);
            return to;
        });
    std::vector<PositionSum> limit(refined.size());
    if (!fits_tangent_masks(refiner.GetLevel(refiner.GetMaxLevel()))) {
        // Without normals: whoever reads the mesh computes them.
        primvars.Limit(refined, limit);
        for (const PositionSum& sum : limit) out.positions_mm.push_back(sum.value);
        return;
    }
    std::vector<PositionSum> along_1(refined.size()), along_2(refined.size());
    primvars.Limit(refined, limit, along_1, along_2);
    for (size_t i = 0; i < limit.size(); ++i) {
        out.positions_mm.push_back(limit[i].value);
        out.normals.push_back(normalize(cross(normalize(along_1[i].value), normalize(along_2[i].value))));
    }
}

void evaluate_uvs(const Far::TopologyRefiner& refiner, const std::vector<Vec2>& cage, Progress& progress,
                  PolygonMesh& out) {
    const Far::PrimvarRefiner primvars(refiner);
    const auto refined =
        refine(cage, refiner.GetMaxLevel(), progress, [&](int level, const std::vector<UvSum>& from) {
            std::vector<UvSum> to(size_t(refiner.GetLevel(level).GetNumFVarValues(0)));
            primvars.InterpolateFaceVarying(level, from, to, 0);
            return to;
        });
    std::vector<UvSum> limit(refined.size());
    primvars.LimitFaceVarying(refined, limit, 0);
    for (const UvSum& uv : limit) out.uvs.push_back(uv.value);
}

void copy_faces(const Far::TopologyRefiner& refiner, const PolygonMesh& cage, PolygonMesh& out) {
    const int last = refiner.GetMaxLevel();
    const Far::TopologyLevel& level = refiner.GetLevel(last);
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        const auto vertices = level.GetFaceVertices(face);
        out.face_sizes.push_back(uint32_t(vertices.size()));
        for (int i = 0; i < vertices.size(); ++i) out.corner_positions.push_back(uint32_t(vertices[i]));
        if (!out.uvs.empty()) {
            const auto uvs = level.GetFaceFVarValues(face, 0);
            for (int i = 0; i < uvs.size(); ++i) out.corner_uvs.push_back(uint32_t(uvs[i]));
        }
        int parent = face;
        for (int l = last; l > 0; --l) parent = refiner.GetLevel(l).GetFaceParentFace(parent);
        out.face_materials.push_back(cage.face_materials[size_t(parent)]);
    }
    if (!out.normals.empty()) out.corner_normals = out.corner_positions;
}

void keep_quiet(Far::ErrorType, const char*) {}

}  // namespace

Result<PolygonMesh> subdivide(const PolygonMesh& polygons, int level) {
    if (level == 0) return polygons;
    if (level < 0 || level > kMaxSubdivisionLevel)
        return Error{fmt::format("subdivision level {} is outside of 0 to {}", level, kMaxSubdivisionLevel)};
    // The first refinement makes a quad of every corner, each further one four of a quad.
    const uint64_t faces = uint64_t{polygons.corner_positions.size()} << (2 * (level - 1));
    if (faces > kMaxFaces)
        return Error{
            fmt::format("subdivision to level {} makes {} faces, more than 20 million; take a lower level",
                        level, faces)};
    // It would print to standard error; a null refiner says enough.
    Far::SetErrorCallback(keep_quiet);
    Far::SetWarningCallback([](const char*) {});
    const Cage cage = prepare(polygons);
    const auto refiner = make_refiner(cage, polygons.positions_mm.size());
    if (!refiner)
        return Error{"the mesh cannot be subdivided: a face uses a vertex twice, or an edge is not manifold"};
    Far::TopologyRefiner::UniformOptions uniform(level);
    uniform.fullTopologyInLastLevel = true;
    // The topology and the faces count as one step each, positions and UVs as one a level.
    Progress progress("subdividing", 2 + 2 * size_t(level));
    refiner->RefineUniform(uniform);
    progress.advance();
    PolygonMesh out;
    out.materials = polygons.materials;
    evaluate_positions(*refiner, polygons.positions_mm, progress, out);
    if (!cage.uvs.empty()) evaluate_uvs(*refiner, cage.uv_values, progress, out);
    copy_faces(*refiner, polygons, out);
    return out;
}

}  // namespace dermis::inline mesh
