// What the linter found out, as the convention file that read_table asks for.

#include <cmath>

#include "dermis/bake/lint.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"

namespace dermis {
namespace {

// A fit ends within this share of the axis's length of the round number that was meant.
constexpr double kFitted = 0.004;

double without_noise(double value, const TableAxis& axis) {
    const double length = std::abs(axis.max - axis.min);
    if (std::abs(value) < kFitted * length) return 0;
    const double rounded = std::round(value * 100) / 100;
    return std::abs(rounded - value) < kFitted * length ? rounded : value;
}

}  // namespace

Result<Convention> convention_of(const LintReport& report) {
    const LintHypothesis& best = report.best;
    if (!report.explained) return Error{"no convention explains it; nothing is written"};
    if (best.transposed) return Error{"N.L runs down the picture: turn it by 90 degrees first"};
    if (best.stored_as == StoredAs::decoded_twice)
        return Error{"its light was decoded from sRGB by mistake: encode it once first"};
    Convention convention = lut_options("dermis")->convention;
    TableAxis& n_dot_l = convention.axes[0];
    if (best.n_dot_l_mirrored) std::swap(n_dot_l.min, n_dot_l.max);
    n_dot_l.sampling = best.sampling;
    convention.axes[1] = best.axis;
    convention.axes[1].min = without_noise(best.axis.min, best.axis);
    convention.axes[1].max = without_noise(best.axis.max, best.axis);
    convention.v_origin = VOrigin::top;
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
    const Result<std::vector<std::byte>> file = read_file(path);
    if (!file) return file.error();
    const Result<LoadedImage> loaded = decode_image(*file, path.string(), ImageUse::data);
    if (!loaded) return loaded.error();
    const std::filesystem::path beside = sidecar_path(path);
    const std::string json = convention_json(*convention, loaded->image.width, loaded->image.height) + "\n";
    if (Result<void> written = write_text_file(beside, json); !written) return written.error();
    return beside;
}

}  // namespace dermis
