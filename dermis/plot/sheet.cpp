#include "dermis/plot/sheet.h"

#include <algorithm>

namespace dermis::inline plot {
namespace {

constexpr int kMargin = 12, kGap = 8, kSmallestWidth = 360;
constexpr Vec3 kPaper = {0.125f, 0.125f, 0.133f}, kInk = {0.93f, 0.93f, 0.93f},
               kFaint = {0.66f, 0.66f, 0.68f};
constexpr float kTitlePx = 18, kRowPx = 15, kLabelPx = 13, kNumberPx = 12;

// Places text and pictures. The sheet is laid out twice, first without an image to measure, then with one to
// draw, so that both agree.
class Pen {
  public:
    Pen(const Font& font, Image* image) : font_(&font), image_(image) {}

    /// Returns the y below the text.
    int text(int x, int y, int width, const std::string& words, float size_px, Vec3 color) const {
        if (words.empty()) return y;
        for (const std::string& line : font_->wrap(words, size_px, width)) {
            if (image_) font_->draw(*image_, x, y, line, {size_px, color});
            y += font_->line_px(size_px);
        }
        return y;
    }
    void picture(int x, int y, const Image& picture) const {
        if (!image_) return;
        for (int row = 0; row < picture.height; ++row)
            for (int column = 0; column < picture.width; ++column)
                for (int c = 0; c < 3; ++c) image_->set(x + column, y + row, c, picture.at(column, row, c));
    }

  private:
    const Font* font_;
    Image* image_;
};

int widest_picture(const Sheet& sheet) {
    int width = 1;
    for (const SheetRow& row : sheet.rows)
        for (const SheetCell& cell : row.cells) width = std::max(width, cell.picture.width);
    return width;
}

int sheet_width(const Sheet& sheet) {
    size_t columns = 1;
    for (const SheetRow& row : sheet.rows) columns = std::max(columns, row.cells.size());
    return std::max(kSmallestWidth, 2 * kMargin + int(columns) * (widest_picture(sheet) + kGap) - kGap);
}

// The pictures of a row begin at one height, below its longest label.
int lay_row(const Pen& pen, const SheetRow& row, int y, int cell_width, int width) {
    y = pen.text(kMargin, y, width, row.label, kRowPx, kInk);
    const auto x_of = [&](size_t i) { return kMargin + int(i) * (cell_width + kGap); };
    int pictures_y = y, words_y = y, bottom = y;
    for (size_t i = 0; i < row.cells.size(); ++i)
        pictures_y =
            std::max(pictures_y, pen.text(x_of(i), y, cell_width, row.cells[i].label, kLabelPx, kInk) + 3);
    for (size_t i = 0; i < row.cells.size(); ++i) {
        pen.picture(x_of(i), pictures_y, row.cells[i].picture);
        words_y = std::max(words_y, pictures_y + row.cells[i].picture.height);
    }
    for (size_t i = 0; i < row.cells.size(); ++i)
        bottom = std::max(
            bottom, pen.text(x_of(i), words_y + 1, cell_width, row.cells[i].beneath, kNumberPx, kFaint));
    return std::max(bottom, words_y) + kGap;
}

int lay_sheet(const Pen& pen, const Sheet& sheet, int sheet_width_px) {
    const int width = sheet_width_px - 2 * kMargin, cell_width = widest_picture(sheet);
    int y = pen.text(kMargin, kMargin, width, sheet.title, kTitlePx, kInk);
    y = pen.text(kMargin, y, width, sheet.source, kLabelPx, kFaint) + kGap;
    for (const SheetRow& row : sheet.rows) y = lay_row(pen, row, y, cell_width, width);
    y = pen.text(kMargin, y, width, sheet.note, kLabelPx, kInk);
    for (const std::string& credit : sheet.credits)
        y = pen.text(kMargin, y, width, credit, kNumberPx, kFaint);
    return y + kMargin;
}

}  // namespace

Image compose_sheet(const Sheet& sheet, const Font& font) {
    const int width = sheet_width(sheet);
    const int height = lay_sheet(Pen(font, nullptr), sheet, width);
    Image image(width, height, 3, PixelFormat::u8, Encoding::srgb);
    const float paper[3] = {kPaper.x, kPaper.y, kPaper.z};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, paper[c]);
    lay_sheet(Pen(font, &image), sheet, width);
    return image;
}

}  // namespace dermis::inline plot
