// Times of dermis/mesh: its files read on the scanned head (skipped without it), the rest on the bust.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "dermis/mesh/curvature.h"
#include "dermis/mesh/hole_caps.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/obj.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/subdivide.h"
#include "dermis/mesh/tangents.h"
#include "dermis/mesh/uv_report.h"
#include "subjects/bust/bust.h"

namespace {

using namespace dermis;

std::filesystem::path head(const char* name) {
    const char* directory = std::getenv("DERMIS_ASSETS");
    return std::filesystem::path(directory ? directory : DERMIS_SOURCE_DIR "/../shared/assets") /
           "lee_perry_smith" / name;
}

Result<LoadedMesh> load(const char* name, int level = 0) {
    return read_mesh(head(name), {.unit_mm = level > 0 ? 900 : 45, .subdivision_level = level});
}

void read_head(benchmark::State& state) {
    for (auto _ : state) {
        const auto loaded = load("head.obj");
        if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
    }
}
BENCHMARK(read_head)->Unit(benchmark::kMillisecond);

void read_and_subdivide(benchmark::State& state) {
    for (auto _ : state) {
        const auto loaded = load("head_quads.obj", int(state.range(0)));
        if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
    }
}
BENCHMARK(read_and_subdivide)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);

template <class Work>
void on_head(benchmark::State& state, const Work& work) {
    const auto bust = make_bust();
    if (!bust) return state.SkipWithError(bust.error().message.c_str());
    for (auto _ : state) {
        Mesh mesh = bust->mesh;
        work(mesh);
        benchmark::DoNotOptimize(mesh.positions_mm.data());
    }
}

void normals(benchmark::State& state) {
    on_head(state, [](Mesh& mesh) { compute_normals(mesh); });
}
BENCHMARK(normals)->Unit(benchmark::kMillisecond);

void tangents(benchmark::State& state) {
    on_head(state, [](Mesh& mesh) { compute_tangents(mesh); });
}
BENCHMARK(tangents)->Unit(benchmark::kMillisecond);

void curvature(benchmark::State& state) {
    on_head(state,
            [&](Mesh& mesh) { benchmark::DoNotOptimize(compute_curvature(mesh, double(state.range(0)))); });
}
BENCHMARK(curvature)->Arg(0)->Arg(2)->Arg(5)->Unit(benchmark::kMillisecond);

void uv_report(benchmark::State& state) {
    on_head(state, [](Mesh& mesh) { benchmark::DoNotOptimize(analyze_uvs(mesh)); });
}
BENCHMARK(uv_report)->Unit(benchmark::kMillisecond);

// Triangles that share nothing, or one vertex: as hair cards have them.
void borders(benchmark::State& state, uint32_t shared) {
    std::vector<Vec3> positions_mm(shared);
    std::vector<uint32_t> indices, triangles;
    for (uint32_t i = 0; i < uint32_t(state.range(0)); ++i) {
        triangles.push_back(i);
        const auto first = uint32_t(positions_mm.size());
        for (uint32_t k = 0; k < 3; ++k) {
            indices.push_back(k < shared ? k : first + k - shared);
            if (k >= shared) positions_mm.push_back({float(i), float(k), 1});
        }
    }
    for (auto _ : state) {
        std::vector<BorderLoop> loops = border_loops(positions_mm, indices, triangles);
        benchmark::DoNotOptimize(put_last(loops, loops));
    }
}
BENCHMARK_CAPTURE(borders, of_loose_triangles, 0)->Arg(200'000)->Arg(400'000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(borders, at_one_vertex, 1)->Arg(200'000)->Arg(400'000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
