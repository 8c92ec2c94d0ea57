#pragma once
// Files of each format as other programs write them, made with the libraries rather than with dermis/image.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dermis/image/image.h"

namespace dermis {

using FileBytes = std::vector<std::byte>;

struct PngSettings {
    int width = 0, height = 0, depth = 8;
    int color_type = 0;  // libpng's PNG_COLOR_TYPE_*
    bool interlaced = false;
    double gamma = 0;  // 0: no gAMA chunk
    bool palette_alpha = false;
};
/// Rows as PNG packs them. The palette's entry i is (i, 2 i, 3 i), its alpha 255 - i.
FileBytes make_png(const PngSettings& settings, const std::vector<std::vector<uint8_t>>& rows);

/// 8-bit grey or RGB; `progressive` and 4:2:0 for RGB.
FileBytes make_jpeg(const Image& image, int quality, bool progressive);
FileBytes make_cmyk_jpeg(int width, int height);

struct ExrSettings {
    int compression = 0;  // Imf::Compression
    int tile_side = 0;    // 0: scanlines
    bool float_channels = false;
    int offset_x = 0, offset_y = 0;               // of the data window
    std::array<int, 4> display = {0, 0, -1, -1};  // first and last column and row; empty: the data window
    std::vector<std::string> channels;
};
/// Channel c of texel (x, y) holds c + x/64 + y/4096 (exact in half for small pictures).
FileBytes make_exr(int width, int height, const ExrSettings& settings);

/// Flat images of one level with any texels, `stored` as they lie in the file.
struct Ktx2Settings {
    uint32_t vulkan = 0, width = 1, height = 1;
    std::vector<std::pair<std::string, std::string>> pairs;
};
FileBytes make_ktx2(const Ktx2Settings& settings, const std::vector<uint8_t>& stored);

struct DdsSettings {
    uint32_t width = 1, height = 1;
    uint32_t dxgi = 0;  // 0: no DX10 header, the fields below
    uint32_t flags = 0, bits = 0;
    std::array<uint32_t, 4> masks{};  // red, green, blue, alpha
};
FileBytes make_dds(const DdsSettings& settings, const std::vector<uint8_t>& stored);

}  // namespace dermis
