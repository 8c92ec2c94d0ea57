#pragma once
// A technique's figures, drawn: every cell rendered, compared where it asks for it, and laid on one sheet.

#include <functional>
#include <string>
#include <vector>

#include "dermis/image/label.h"
#include "dermis/report/cell_renderer.h"
#include "dermis/technique/technique.h"

namespace dermis::inline report {

/// How far one cell is from another, over what both cover whole.
struct CellDifference {
    double mean_abs = 0, max_abs = 0;  ///< of linear values (radiance), all channels
    double flip = 0;                   ///< mean FLIP of the pictures as displayed, 0 to 1
};

struct CellReport {
    std::string label;        ///< with its row's before it, if that has one
    std::string compared_to;  ///< likewise; empty when it was compared with nothing
    CellDifference difference;
};

struct FigureResult {
    Image sheet;  ///< u8, sRGB, three channels
    std::vector<CellReport> cells;
    std::vector<std::string> credits;
};

/// Figures of one technique; with `only`, that one. Errors: it has none, an unknown id.
[[nodiscard]] Result<std::vector<Figure>> figures_of(const Technique& technique,
                                                     const std::string& only = {});

/// Draws and composes; `size` is the height of a cell in pixels, 16 to 2048. `drawn` is called after each
/// cell.
[[nodiscard]] Result<FigureResult> draw_figure(CellRenderer& renderer, const Font& font, const Figure& figure,
                                               int size, const std::function<void()>& drawn = {});

/// Errors: different sizes, nothing covered by both.
[[nodiscard]] Result<CellDifference> compare_cells(const CellPicture& a, const CellPicture& b);

}  // namespace dermis::inline report
