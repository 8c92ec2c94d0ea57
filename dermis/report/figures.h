#pragma once
// A technique's figures, drawn: every cell rendered, compared where it asks for it, and laid on one sheet.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dermis/image/label.h"
#include "dermis/render/catalog.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/figure.h"
#include "dermis/technique/technique.h"

namespace dermis::inline report {

/// One cell of a figure as a picture.
struct CellPicture {
    Image display;  ///< sRGB-encoded, u8, three channels: what the sheet shows
    Image
        radiance;  ///< linear f32, four channels; alpha is 1 where skin covers the whole pixel, or everywhere
    std::string remark;  ///< after the label ("studio turned: no sunset.hdr"); may be empty
    std::string credit;  ///< of the scene
};

struct CellSize {
    int width = 256, height = 256;
};

/// Keeps the scenes it has drawn on the device for the cells to come; three at most.
class CellRenderer {
  public:
    struct Options {
        std::string scene;  ///< instead of every figure's own when not empty
        int samples = 4;
        /// Keys of every figure's scene: those that are read while it is loaded, and the others; a cell's own
        /// camera and light come after them.
        std::vector<SceneWord> loading_words = {}, words = {};
    };
    /// `device` and what `catalog` shows must outlive it.
    CellRenderer(gpu::Device& device, const Catalog& catalog, Options options);
    CellRenderer(CellRenderer&&) noexcept;
    ~CellRenderer();

    /// Settings that the cell lacks are those of `figure`. Not for cells that show a difference. Errors name
    /// the cell.
    [[nodiscard]] Result<CellPicture> draw(const Figure& figure, const FigureCell& cell, CellSize size);

  private:
    struct Stage;
    Result<Stage*> stage(const Figure& figure, const FigureCell& cell);
    Result<CellPicture> draw_scene(const Technique& technique, const ParameterValues& values,
                                   const FigureCell& cell, Stage& stage, CellSize size);

    gpu::Device* device_;
    Catalog catalog_;
    Options options_;
    std::map<std::string, std::unique_ptr<Stage>> stages_;
};

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
