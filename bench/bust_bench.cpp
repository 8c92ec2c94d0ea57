// The time of the built-in head: one value of its field, and its stages from the field to the painted maps.
// CPU is that of the whole process, so that other work on the machine does not change it; on two cores the
// elapsed time is half of it.

#include <benchmark/benchmark.h>

#include "subjects/bust/atlas.h"
#include "subjects/bust/head_mesh.h"
#include "subjects/bust/maps.h"

namespace {

using namespace dermis;
using namespace dermis::bust;

const BustField& field() {
    static const BustField standard{BustParams{}};
    return standard;
}

void field_value(benchmark::State& state) {
    double x = 0;
    for (auto _ : state) {
        x = x > 70 ? -70 : x + 0.37;
        benchmark::DoNotOptimize(field().distance_mm({x, 0.5 * x, 95}));
    }
}
BENCHMARK(field_value);

void surface(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(make_head_surface(field()));
}
BENCHMARK(surface)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(1);

void atlas(benchmark::State& state) {
    const Surface mesh = make_head_surface(field());
    for (auto _ : state) benchmark::DoNotOptimize(make_atlas(mesh, field()));
}
BENCHMARK(atlas)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(1);

void maps_of_2048(benchmark::State& state) {
    const Atlas flat = make_atlas(make_head_surface(field()), field());
    for (auto _ : state) benchmark::DoNotOptimize(paint_maps(flat, field(), {}, 2048));
}
BENCHMARK(maps_of_2048)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
