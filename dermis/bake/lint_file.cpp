// The linter's files: pictures, and CSV as a picture.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "dermis/bake/lint_model.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/table_report.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"

namespace dermis::inline bake {
namespace {

using Cells = std::array<double, 5>;  // u, v, red, green, blue

std::optional<Cells> parse_cells(std::string_view line) {
    const std::vector<std::string_view> texts = split(line, ',');
    Cells cells = {};
    if (texts.size() != cells.size()) return std::nullopt;
    for (size_t i = 0; i < cells.size(); ++i) {
        const std::optional<double> number = parse_number(trim(texts[i]));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        cells[i] = *number;
    }
    return cells;
}

std::string span_text(const std::string& name, double first, double last) {
    return name + " " + lint::rounded(first) + " to " + lint::rounded(last);
}

// The convention as an explanation of the file's numbers, or nothing where it is not of this kind.
std::optional<LintHypothesis> hypothesis_of(const Convention& convention, bool holds_light) {
    TableAxis n_dot_l = convention.axes[0];
    if (convention.kind != TableKind::diffuse || n_dot_l.warp != AxisWarp::linear) return std::nullopt;
    LintHypothesis own{.how = convention.how,
                       .integration = convention.integration,
                       .profile = convention.profile,
                       .axis = convention.axes[1],
                       .v_origin = holds_light ? VOrigin::top : convention.v_origin};
    own.n_dot_l_mirrored = n_dot_l.min > n_dot_l.max;
    own.n_dot_l_min = std::min(n_dot_l.min, n_dot_l.max);
    own.n_dot_l_max = std::max(n_dot_l.min, n_dot_l.max);
    own.sampling = n_dot_l.sampling;
    if (own.n_dot_l_mirrored && own.sampling != TexelSampling::centre)
        own.sampling =
            own.sampling == TexelSampling::low_edge ? TexelSampling::high_edge : TexelSampling::low_edge;
    if (holds_light || convention.encoding == TableEncoding::linear) return own;
    if (convention.encoding == TableEncoding::srgb)
        own.stored_as = StoredAs::srgb;
    else if (convention.encoding == TableEncoding::difference)
        own.stored_as = StoredAs::difference;
    else
        return std::nullopt;
    return own;
}

}  // namespace

Result<lint::TablePicture> lint::parse_csv_picture(std::string_view text, std::string_view place) {
    const auto fail = [&](size_t line, const std::string& what) {
        return Error{std::string(place) + ":" + std::to_string(line) + ": " + what};
    };
    std::vector<std::string_view> lines = split(text, '\n');
    while (!lines.empty() && trim(lines.back()).empty()) lines.pop_back();
    const size_t first = !lines.empty() && !parse_cells(trim(lines[0])) ? 1 : 0;
    std::vector<Cells> texels;
    for (size_t i = first; i < lines.size(); ++i) {
        const std::optional<Cells> cells = parse_cells(trim(lines[i]));
        if (!cells) return fail(i + 1, "must be five numbers: N.L, curvature or radius, red, green, blue");
        texels.push_back(*cells);
    }
    if (texels.size() < 2) return fail(1, "has no texels");
    const size_t slow = texels[0][1] == texels[1][1] ? 1 : 0, fast = 1 - slow;
    size_t width = 1;
    while (width < texels.size() && texels[width][slow] == texels[0][slow]) ++width;
    if (texels.size() % width != 0)
        return fail(lines.size(), "the last row has " + std::to_string(texels.size() % width) +
                                      " texels, the first " + std::to_string(width));
    for (size_t i = 0; i < texels.size(); ++i)
        if (texels[i][fast] != texels[i % width][fast] || texels[i][slow] != texels[i - i % width][slow])
            return fail(i + first + 1, "its coordinates are not those of a grid of " + std::to_string(width) +
                                           " texels a row");
    if (Result<void> size = check_image_size(width, texels.size() / width, 3); !size)
        return Error{std::string(place) + ": " + size.error().message};
    TablePicture picture{.image = Image(int(width), int(texels.size() / width), 3), .holds_light = true};
    for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) picture.image.floats()[3 * i + c] = float(texels[i][2 + c]);
    std::vector<std::string_view> names = split(lines[0], ',');
    if (first == 0 || names.size() != 5) names = {"first column", "second column"};
    picture.coordinates =
        span_text(printable_line(trim(names[fast]), 40), texels.front()[fast], texels.back()[fast]) +
        " across, " +
        span_text(printable_line(trim(names[slow]), 40), texels.front()[slow], texels.back()[slow]) + " down";
    return picture;
}

Result<lint::TablePicture> lint::read_picture(const std::filesystem::path& path) {
    if (to_lower(path.extension().string()) == ".csv") {
        DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
        return parse_csv_picture(text, path.string());
    }
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
    DERMIS_TRY_ASSIGN(LoadedImage loaded, decode_image(file, path.string(), ImageUse::data));
    return TablePicture{
        .image = std::move(loaded.image), .coordinates = {}, .flagged_srgb = png_is_flagged_srgb(file)};
}

Result<LintReport> lint_file(const std::filesystem::path& path) {
    const Result<lint::TablePicture> picture = lint::read_picture(path);
    if (!picture) return picture.error();
    const Result<Table> table = read_table(path, {});
    std::optional<LintHypothesis> own;
    if (table) own = hypothesis_of(table->convention, picture->holds_light);
    Result<LintReport> report = lint_table(picture->image, own ? &*own : nullptr);
    if (!report) return Error{path.string() + ": " + report.error().message};
    if (picture->flagged_srgb && report->best.stored_as != StoredAs::srgb && report->explained) {
        report->findings.push_back("the PNG is flagged sRGB, its numbers are not");
        report->advice.push_back("import it as data (no sRGB), against its flag");
    }
    if (!picture->coordinates.empty())
        report->findings.push_back("its texels' centres say: " + picture->coordinates);
    if (table) report->findings.push_back("its own convention says: " + describe(*table));
    if (table && table->convention.kind != (report->other ? report->other->kind : TableKind::diffuse))
        report->findings.push_back("its own convention does not describe these numbers");
    return report;
}

}  // namespace dermis::inline bake
