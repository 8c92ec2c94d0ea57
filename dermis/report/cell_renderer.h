#pragma once
// One cell of a figure as a picture.

#include <map>
#include <memory>
#include <string>

#include "dermis/render/catalog.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/figure.h"

namespace dermis::inline report {

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

    /// `figure` gives what the cell leaves open; not for differences. Errors name the cell.
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

}  // namespace dermis::inline report
