#pragma once
// Pictures and words composed to one sheet: title and source, rows of labelled cells, a note, credits.

#include <string>
#include <vector>

#include "dermis/image/image.h"
#include "dermis/image/label.h"

namespace dermis::inline plot {

/// One cell: words above, picture, words beneath; both are wrapped to its width. The picture is u8 and
/// sRGB-encoded with three channels; empty leaves its place free.
struct SheetCell {
    std::string label;
    Image picture;
    std::string beneath;
};

struct SheetRow {
    std::string label;
    std::vector<SheetCell> cells;
};

struct Sheet {
    std::string title, source, note;
    std::vector<SheetRow> rows;
    std::vector<std::string> credits;
};

/// Cells of a row are as wide as the widest picture; rows are as high as they need. u8, sRGB, three channels.
[[nodiscard]] Image compose_sheet(const Sheet& sheet, const Font& font);

}  // namespace dermis::inline plot
