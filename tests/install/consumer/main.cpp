// As the build of an engine: bakes the table of a preset with its own size and axis.
#include <cstdio>

#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/optics/presets.h"

int main(int, char** argv) {
    dermis::LutOptions options = *dermis::lut_options("dermis");
    options.width = options.height = 32;
    options.convention.axes[1] = dermis::curvature_axis(0, 0.25);
    const dermis::Result<dermis::Table> table = dermis::bake_lut(options);
    if (!table) return std::fprintf(stderr, "%s\n", table.error().message.c_str()), 1;
    if (const auto written = dermis::write_table(argv[1], *table); !written)
        return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 1;
    const auto read = dermis::read_table(argv[1], {.v_axis = "curvature_per_mm", .profile = "gpu_gems_3"});
    if (!read) return std::fprintf(stderr, "%s\n", read.error().message.c_str()), 1;
    std::printf("red at N.L 0, r 8 mm: %.3f\n", dermis::lookup(*read, 0, 0.125)[0]);
}
