#pragma once
// Text in pictures: DejaVu Sans through FreeType, anti-aliased, left to right, without kerning.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline image {

/// $DERMIS_FONT (any file that FreeType reads), or the system's DejaVuSans.ttf. The error names the package.
[[nodiscard]] Result<std::filesystem::path> find_font();

struct TextStyle {
    float size_px = 14;               ///< of the em square, 4 to 400
    Vec3 color = {0.9f, 0.9f, 0.9f};  ///< as the image stores it: sRGB-encoded in a display picture
};

/// A font and its glyphs at any size. Text is UTF-8; invalid bytes and missing characters are drawn as
/// boxes. Move-only; one thread at a time.
class Font {
  public:
    /// Errors: no font found, not a font.
    [[nodiscard]] static Result<Font> load();
    [[nodiscard]] static Result<Font> load(const std::filesystem::path& path);
    Font(Font&&) noexcept;
    Font& operator=(Font&&) noexcept;
    ~Font();

    [[nodiscard]] int width_px(std::string_view text, float size_px) const;
    /// Distance between baselines.
    [[nodiscard]] int line_px(float size_px) const;
    /// Blends the text over the colour channels (the first three at most); x is its left end, y the top of
    /// its line. Clipped to the image.
    void draw(Image& image, int x, int y, std::string_view text, const TextStyle& style) const;
    /// Lines no wider than `width_px`, broken at spaces; a single word may be wider.
    [[nodiscard]] std::vector<std::string> wrap(std::string_view text, float size_px, int width_px) const;

  private:
    struct State;
    explicit Font(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::inline image
