#include "dermis/image/label.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dermis/base/text.h"

namespace dermis::inline image {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/local/share/fonts/dejavu/DejaVuSans.ttf"};
constexpr char32_t kReplacement = 0xFFFD;

// Removes one UTF-8 character from the front; a byte that begins none gives a replacement character.
char32_t take_character(std::string_view& text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const size_t length = lead < 0x80         ? 1
                          : (lead >> 5) == 6  ? 2
                          : (lead >> 4) == 14 ? 3
                          : (lead >> 3) == 30 ? 4
                                              : 0;
    if (length == 0 || length > text.size()) return text.remove_prefix(1), kReplacement;
    char32_t code = length == 1 ? lead : lead & (0x7Fu >> length);
    for (size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0) != 0x80) return text.remove_prefix(1), kReplacement;
        code = code << 6 | (byte & 0x3Fu);
    }
    text.remove_prefix(length);
    return code;
}

void blend_glyph(Image& image, const FT_Bitmap& glyph, int left, int top, Vec3 color) {
    const float channels[3] = {color.x, color.y, color.z};
    for (int row = 0; row < int(glyph.rows); ++row)
        for (int column = 0; column < int(glyph.width); ++column) {
            const int x = left + column, y = top + row;
            if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
            const float cover = float(glyph.buffer[row * glyph.pitch + column]) / 255;
            for (int c = 0; c < std::min(image.channels, 3); ++c)
                image.set(x, y, c, std::lerp(image.at(x, y, c), channels[c], cover));
        }
}

}  // namespace

struct Font::State {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    ~State() {
        if (face) FT_Done_Face(face);
        if (library) FT_Done_FreeType(library);
    }
    void set_size(float size_px) {
        FT_Set_Pixel_Sizes(face, 0, FT_UInt(std::lround(std::clamp(size_px, 4.0f, 400.0f))));
    }
    [[nodiscard]] bool load_glyph(char32_t code, FT_Int32 flags) {
        return FT_Load_Char(face, code, flags | FT_LOAD_TARGET_LIGHT) == 0;
    }
};

Result<fs::path> find_font() {
    if (const char* named = std::getenv("DERMIS_FONT"); named && *named) return fs::path(named);
    std::error_code ec;
    for (const char* file : kFontFiles)
        if (fs::exists(file, ec)) return fs::path(file);
    return Error{
        "no DejaVuSans.ttf for labels: install the package fonts-dejavu-core, or name a font file in "
        "DERMIS_FONT"};
}

Font::Font(std::unique_ptr<State> state) : state_(std::move(state)) {}
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;
Font::~Font() = default;

Result<Font> Font::load() {
    const Result<fs::path> path = find_font();
    return path ? load(*path) : path.error();
}

Result<Font> Font::load(const fs::path& path) {
    auto state = std::make_unique<State>();
    if (FT_Init_FreeType(&state->library) != 0) return Error{"FreeType cannot start"};
    if (FT_New_Face(state->library, path.c_str(), 0, &state->face) != 0 || !FT_IS_SCALABLE(state->face))
        return Error{path.string() + ": not a scalable font that FreeType can read"};
    return Font(std::move(state));
}

int Font::width_px(std::string_view text, float size_px) const {
    state_->set_size(size_px);
    FT_Pos width = 0;
    while (!text.empty())
        if (state_->load_glyph(take_character(text), FT_LOAD_DEFAULT))
            width += state_->face->glyph->advance.x;
    return int((width + 63) / 64);
}

int Font::line_px(float size_px) const {
    state_->set_size(size_px);
    return int((state_->face->size->metrics.height + 63) / 64);
}

void Font::draw(Image& image, int x, int y, std::string_view text, const TextStyle& style) const {
    state_->set_size(style.size_px);
    const int baseline = y + int((state_->face->size->metrics.ascender + 63) / 64);
    FT_Pos pen = FT_Pos(x) * 64;
    while (!text.empty()) {
        if (!state_->load_glyph(take_character(text), FT_LOAD_RENDER)) continue;
        const FT_GlyphSlot glyph = state_->face->glyph;
        blend_glyph(image, glyph->bitmap, int(pen / 64) + glyph->bitmap_left, baseline - glyph->bitmap_top,
                    style.color);
        pen += glyph->advance.x;
    }
}

std::vector<std::string> Font::wrap(std::string_view text, float size_px, int width_px) const {
    std::vector<std::string> lines;
    for (const std::string_view word : split(text, ' ')) {
        const std::string longer = lines.empty() ? std::string(word) : lines.back() + ' ' + std::string(word);
        if (!lines.empty() && this->width_px(longer, size_px) <= width_px)
            lines.back() = longer;
        else
            lines.emplace_back(word);
    }
    return lines;
}

}  // namespace dermis::inline image
