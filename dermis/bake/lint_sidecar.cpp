// The linter's result as the convention file that read_table needs.

#include "dermis/bake/lint_model.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"

namespace dermis::inline bake {
Result<Convention> convention_of(const LintReport& report) {
    if (report.other) return *report.other;
    const LintHypothesis& best = report.best;
    if (!report.refusal.empty()) return Error{"no table of skin: " + report.refusal + "; nothing is written"};
    if (!report.explained) return Error{"no convention explains it; nothing is written"};
    if (best.transposed) return Error{"N.L runs down the picture: turn it by 90 degrees first"};
    if (best.stored_as == StoredAs::decoded_twice)
        return Error{"its light was decoded from sRGB by mistake: encode it once first"};
    if (best.stored_as == StoredAs::encoded_twice)
        return Error{"its light was sRGB-encoded twice: decode it once first"};
    if (best.bgr) return Error{"blue is its first channel: swap red and blue first"};
    Convention convention = lut_options("dermis")->convention;
    TableAxis& n_dot_l = convention.axes[0];
    n_dot_l.min = best.n_dot_l_mirrored ? best.n_dot_l_max : best.n_dot_l_min;
    n_dot_l.max = best.n_dot_l_mirrored ? best.n_dot_l_min : best.n_dot_l_max;
    n_dot_l.sampling = best.sampling;
    convention.axes[1] = best.axis;
    convention.axes[1].min = lint::without_noise(best.axis.min, best.axis);
    convention.axes[1].max = lint::without_noise(best.axis.max, best.axis);
    convention.v_origin = best.v_origin;
    convention.how = best.how;
    convention.integration = best.integration;
    convention.profile = best.profile;
    convention.tool = "dermis lint, " + tool_version();
    convention.encoding = best.stored_as == StoredAs::srgb         ? TableEncoding::srgb
                          : best.stored_as == StoredAs::difference ? TableEncoding::difference
                                                                   : TableEncoding::linear;
    return convention;
}

Result<std::filesystem::path> write_sidecar(const std::filesystem::path& path, const LintReport& report) {
    const Error where{path.string()};
    if (const auto own = read_table(path, {}); own)
        return Error{where.message + ": has a convention already; nothing is written"};
    const Result<Convention> convention = convention_of(report);
    if (!convention) return Error{where.message + ": " + convention.error().message};
    DERMIS_TRY_ASSIGN(const lint::TablePicture picture, lint::read_picture(path));
    if (picture.holds_light && report.best.stored_as != StoredAs::linear)
        return Error{where.message + ": its numbers are encoded; a CSV table has light"};
    const std::filesystem::path beside = sidecar_path(path);
    const std::string json = convention_json(*convention, picture.image.width, picture.image.height) + "\n";
    DERMIS_TRY(write_text_file(beside, json));
    return beside;
}

}  // namespace dermis::inline bake
