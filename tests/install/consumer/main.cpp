// consumer MESH TABLE SHADER [PROFILE]: a skin's table, the curvature of a mesh, and the functions for HLSL.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "dermis/dermis.h"

namespace {

dermis::Result<void> write_skin(const char* mesh_file, const char* table_file, const char* shader_file,
                                const char* profile_name) {
    // A preset, a CSV file, a MaterialX file, a glTF file, or "burley:R,G,B".
    DERMIS_TRY_ASSIGN(const dermis::Profile profile, dermis::find_profile(profile_name));

    // Diffuse light over N.L and curvature. 0.25/mm is a sphere with a radius of 4 mm.
    dermis::LutOptions options = *dermis::lut_options("dermis");
    options.profile = profile;
    options.width = options.height = 64;
    options.convention.axes[1] = dermis::curvature_axis(0, 0.25);
    DERMIS_TRY_ASSIGN(const dermis::Table table, dermis::bake_lut(options));
    DERMIS_TRY(dermis::write_table(table_file, table));

    // Curvature at each vertex in 1/mm, positive where convex: a vertex attribute for the shader.
    DERMIS_TRY_ASSIGN(const dermis::LoadedMesh loaded, dermis::read_mesh(mesh_file, {.unit_mm = 1.0}));
    const std::vector<float> curvatures_per_mm =
        dermis::compute_curvature(loaded.mesh, dermis::kCurvatureSmoothingMm);
    const float most = std::ranges::max(curvatures_per_mm);

    // The shading functions in HLSL, with this skin's coefficients.
    DERMIS_TRY_ASSIGN(const std::string shader,
                      dermis::shading::skin_text(profile, dermis::shading::skin_sources(),
                                                 dermis::shading::Language::hlsl));
    DERMIS_TRY(dermis::write_text_file(shader_file, shader));

    // What the shader will read: light at the terminator of the most curved point.
    std::printf("curvature %.3f/mm: red at N.L 0 is %.3f\n", most, dermis::lookup(table, 0, most)[0]);
    return {};
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) return std::fprintf(stderr, "usage: consumer MESH TABLE SHADER [PROFILE]\n"), 2;
    const auto done = write_skin(words[1], words[2], words[3], count > 4 ? words[4] : "gpu_gems_3");
    if (!done) return std::fprintf(stderr, "%s\n", done.error().message.c_str()), 1;
}
