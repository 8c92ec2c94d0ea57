#include "dermis/report/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/plot/sheet.h"

namespace dermis::inline report {
namespace {

struct DrawnCell {
    std::string label;
    CellPicture picture;
};
using DrawnCells = std::map<std::string, DrawnCell>;

Image covered_by_both(const Image& a, const Image& b) {
    Image mask(a.width, a.height, 1, PixelFormat::u8);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            mask.set(x, y, 0, a.at(x, y, 3) >= 1 && b.at(x, y, 3) >= 1 ? 1.0f : 0.0f);
    return mask;
}

CellPicture difference_picture(const CellPicture& a, const CellPicture& b, float gain) {
    CellPicture picture = {Image(a.display.width, a.display.height, 3, PixelFormat::u8, Encoding::srgb),
                           Image(a.display.width, a.display.height, 4)};
    for (int y = 0; y < a.radiance.height; ++y)
        for (int x = 0; x < a.radiance.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float difference = std::abs(a.radiance.at(x, y, c) - b.radiance.at(x, y, c));
                picture.radiance.set(x, y, c, difference);
                picture.display.set(x, y, c, std::min(difference * gain, 1.0f));
            }
            picture.radiance.set(x, y, 3, 1);
        }
    return picture;
}

std::string difference_text(const CellDifference& difference, const std::string& to) {
    char text[160];
    std::snprintf(text, sizeof text, "mean |Δ| %.4f, max %.3f, FLIP %.3f", difference.mean_abs,
                  difference.max_abs, difference.flip);
    return std::string(text) + "  against " + to;
}

std::string full_label(const FigureRow& row, const FigureCell& cell) {
    return row.label.empty() ? cell.label : row.label + ", " + cell.label;
}

// The cell's picture, whatever its kind.
Result<CellPicture> make_picture(CellRenderer& renderer, const Figure& figure, const FigureCell& cell,
                                 CellSize size, const DrawnCells& drawn) {
    if (cell.kind != CellKind::difference) return renderer.draw(figure, cell, size);
    return difference_picture(drawn.at(cell.subject).picture, drawn.at(cell.compare_to).picture, cell.gain);
}

Result<void> compare(const FigureCell& cell, const CellPicture& picture, const DrawnCells& drawn,
                     CellReport& report) {
    if (cell.compare_to.empty()) return {};
    const DrawnCell& other = drawn.at(cell.compare_to);
    const CellPicture& subject = cell.kind == CellKind::difference ? drawn.at(cell.subject).picture : picture;
    DERMIS_TRY_ASSIGN(const CellDifference difference, compare_cells(subject, other.picture));
    report.compared_to = other.label;
    report.difference = difference;
    return {};
}

}  // namespace

Result<CellDifference> compare_cells(const CellPicture& a, const CellPicture& b) {
    const Image mask = covered_by_both(a.radiance, b.radiance);
    DERMIS_TRY_ASSIGN(const Image map, abs_difference_map(a.radiance, b.radiance));
    DERMIS_TRY_ASSIGN(const double max_abs, max_abs_error(a.radiance, b.radiance, mask));
    DERMIS_TRY_ASSIGN(const double flip, mean_flip(a.display, b.display, mask));
    double sum = 0;
    size_t count = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y, 0) > 0) {
                for (int c = 0; c < 3; ++c) sum += std::abs(a.radiance.at(x, y, c) - b.radiance.at(x, y, c));
                count += 3;
            }
    return CellDifference{.mean_abs = sum / double(count), .max_abs = max_abs, .flip = flip};
}

Result<std::vector<Figure>> figures_of(const Technique& technique, const std::string& only) {
    std::vector<Figure> figures = technique.figures ? technique.figures() : std::vector<Figure>{};
    if (figures.empty()) return Error{"technique '" + technique.id + "' has no figures"};
    for (Figure& figure : figures)
        if (figure.technique.empty()) figure.technique = technique.id;
    if (only.empty()) return figures;
    std::vector<std::string> ids;
    for (const Figure& figure : figures) {
        if (figure.id == only) return std::vector<Figure>{figure};
        ids.push_back(figure.id);
    }
    return Error{unknown_name("figure", only, ids)};
}

Result<FigureResult> draw_figure(CellRenderer& renderer, const Font& font, const Figure& figure, int size,
                                 const std::function<void()>& on_drawn) {
    if (const auto wrong = problems(figure); !wrong.empty()) return Error{wrong.front()};
    const CellSize cell_size = {std::max(1, int(std::lround(float(size) * figure.aspect))), size};
    FigureResult result;
    Sheet sheet = {.title = figure.title, .source = figure.source, .note = figure.note};
    DrawnCells drawn;
    for (const FigureRow& row : figure.rows) {
        sheet.rows.push_back({.label = row.label});
        for (const FigureCell& cell : row.cells) {
            DERMIS_TRY_ASSIGN(CellPicture picture, make_picture(renderer, figure, cell, cell_size, drawn));
            CellReport report = {.label = full_label(row, cell)};
            if (Result<void> compared = compare(cell, picture, drawn, report); !compared)
                return Error{"figure '" + figure.id + "', cell '" + cell.label +
                             "': " + compared.error().message};
            const std::string remark = picture.remark.empty() ? "" : " (" + picture.remark + ")";
            sheet.rows.back().cells.push_back(
                {.label = cell.label + remark,
                 .picture = picture.display,
                 .beneath = report.compared_to.empty()
                                ? ""
                                : difference_text(report.difference, report.compared_to)});
            if (!picture.credit.empty() &&
                std::ranges::find(result.credits, picture.credit) == result.credits.end())
                result.credits.push_back(picture.credit);
            if (!cell.id.empty()) drawn[cell.id] = {full_label(row, cell), std::move(picture)};
            result.cells.push_back(std::move(report));
            if (on_drawn) on_drawn();
        }
    }
    sheet.credits = result.credits;
    result.sheet = compose_sheet(sheet, font);
    return result;
}

}  // namespace dermis::inline report
