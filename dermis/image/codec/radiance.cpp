// Radiance HDR (.hdr, .pic): RGB mantissas with one shared exponent (RGBE), run-length coded.
//
// G. Ward, "Real Pixels", Graphics Gems II, 1991: value = (mantissa + 0.5)/256 * 2^(exponent - 128) in the
// original; every reader in use leaves the 0.5 out, and so does this one. stb_image is not used because it
// reads a truncated file as if it were complete.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {
namespace {

// New-style scanlines: a marker of four bytes, then the four components, each run-length coded by itself.
constexpr int kShortestCodedRow = 8, kLongestCodedRow = 32767;
// The oldest coding stores a row like the last texel of the row before in 8 bytes (two repeat codes), at 12
// decoded bytes per texel.
constexpr uint64_t kMostRunRatio = kMaxImageSide * 12 / 8;

struct RadianceHeader {
    int width = 0, height = 0;
    bool bottom_up = false, right_to_left = false;
};

std::string_view take_line(Bytes& rest, bool& ok) {
    const void* end = rest.empty() ? nullptr : std::memchr(rest.data(), '\n', rest.size());
    if (!end) {
        ok = false;
        return {};
    }
    const size_t length = size_t(static_cast<const std::byte*>(end) - rest.data());
    const std::string_view line(reinterpret_cast<const char*>(rest.data()), length);
    rest = rest.subspan(length + 1);
    return line;
}

// "-Y 512 +X 1024": rows first, from the top, columns from the left. The forms that store columns first are
// not in use and not read.
Result<RadianceHeader> parse_resolution(std::string_view line) {
    const std::vector<std::string_view> words = split(trim(line), ' ');
    const Error wrong{"corrupt HDR: the resolution line '" + std::string(line.substr(0, 40)) +
                      "' should read like '-Y 512 +X 1024'"};
    if (words.size() != 4 || words[0].size() != 2 || words[2].size() != 2) return wrong;
    if (words[0][1] != 'Y' || words[2][1] != 'X') return wrong;
    const auto height = parse_number(words[1]), width = parse_number(words[3]);
    if (!height || !width || !(*height >= 1) || !(*width >= 1) || *height != std::floor(*height) ||
        *width != std::floor(*width))
        return wrong;
    const auto side = [](double value) { return uint64_t(std::min(value, 1e9)); };
    DERMIS_TRY(check_image_size(side(*width), side(*height), 3));
    return RadianceHeader{int(*width), int(*height), words[0][0] == '+', words[2][0] == '-'};
}

Result<RadianceHeader> parse_header(Bytes& rest) {
    bool ok = true;
    (void)take_line(rest, ok);  // "#?RADIANCE", seen by is_radiance
    bool rgbe = false;
    while (ok) {
        const std::string_view line = trim(take_line(rest, ok));
        if (line.empty()) break;
        if (line == "FORMAT=32-bit_rle_rgbe") rgbe = true;
        if (line == "FORMAT=32-bit_rle_xyze") return Error{"HDR in XYZ; dermis reads RGB"};
    }
    if (ok && !rgbe) return Error{"corrupt HDR: no line FORMAT=32-bit_rle_rgbe"};
    const std::string_view resolution = take_line(rest, ok);
    if (!ok) return Error{"corrupt HDR: the file ends in the header"};
    return parse_resolution(resolution);
}

// One component of a row: a count over 128 repeats the next byte count - 128 times; else `count` bytes
// follow.
bool read_runs(ByteReader& in, uint8_t* component, int width) {
    for (int x = 0; x < width;) {
        const int count = in.read<uint8_t>();
        const int run = count > 128 ? count - 128 : count;
        if (run == 0 || run > width - x || !in.ok()) return false;
        if (count > 128) {
            const uint8_t value = in.read<uint8_t>();
            for (int i = 0; i < run; ++i) component[4 * (x + i)] = value;
        } else {
            const Bytes raw = in.take(uint64_t(run));
            for (size_t i = 0; i < raw.size(); ++i) component[4 * (size_t(x) + i)] = uint8_t(raw[i]);
        }
        x += run;
    }
    return in.ok();
}

// Uncoded texels; in the oldest files (1,1,1,n) repeats the texel before it (at the start of a row the last
// of the row before, if there is one), and successive ones count in higher bytes, of which the lower may be
// 0.
bool read_flat(ByteReader& in, uint8_t* row, int width, bool first_row) {
    uint8_t before[4] = {row[4 * width - 4], row[4 * width - 3], row[4 * width - 2], row[4 * width - 1]};
    unsigned shift = 0;
    for (int x = 0; x < width;) {
        const Bytes raw = in.take(4);
        if (raw.empty()) return false;
        uint8_t texel[4];
        std::memcpy(texel, raw.data(), 4);
        const bool repeats = texel[0] == 1 && texel[1] == 1 && texel[2] == 1;
        const uint64_t run = !repeats ? 1 : shift < 32 ? uint64_t(texel[3]) << shift : 0;
        if (repeats && ((x == 0 && first_row) || shift >= 32)) return false;
        if (run > uint64_t(width - x)) return false;
        if (!repeats) std::memcpy(before, texel, 4);
        for (uint64_t i = 0; i < run; ++i, ++x) std::memcpy(row + 4 * x, before, 4);
        shift = repeats ? shift + 8 : 0;
    }
    return true;
}

// `row` holds the row before, unless this is the first.
bool read_row(ByteReader& in, uint8_t* row, int width, bool first_row) {
    const size_t start = in.position();
    const uint8_t a = in.read<uint8_t>(), b = in.read<uint8_t>(), high = in.read<uint8_t>(),
                  low = in.read<uint8_t>();
    if (!in.ok()) return false;
    const bool coded =
        width >= kShortestCodedRow && width <= kLongestCodedRow && a == 2 && b == 2 && high < 128;
    if (!coded) {
        in.seek(start);
        return read_flat(in, row, width, first_row);
    }
    if ((high << 8 | low) != width) return false;
    for (int component = 0; component < 4; ++component)
        if (!read_runs(in, row + component, width)) return false;
    return true;
}

void write_runs(ByteWriter& out, const uint8_t* component, int width) {
    const auto at = [&](int x) { return component[4 * x]; };
    const auto run_length = [&](int x) {
        int length = 1;
        while (x + length < width && length < 127 && at(x + length) == at(x)) ++length;
        return length;
    };
    for (int x = 0; x < width;) {
        const int run = run_length(x);
        if (run >= 4) {
            out.put(uint8_t(128 + run));
            out.put(at(x));
            x += run;
            continue;
        }
        int end = x;
        while (end < width && end - x < 128 && run_length(end) < 4) ++end;
        out.put(uint8_t(end - x));
        for (; x < end; ++x) out.put(at(x));
    }
}

// The largest component sets the exponent; mantissas are truncated as every writer does, so 1.0 stays 1.0.
// Negative values and NaN, which RGBE has no code for, become 0.
void to_rgbe(const float* from, uint8_t* rgbe) {
    float rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = from[c] > 0.0f ? from[c] : 0.0f;
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    if (!(largest > 1e-32f)) {
        std::memset(rgbe, 0, 4);
        return;
    }
    int exponent = 0;
    const float limited = std::min(largest, 0x1.fep126f);
    const float scale = std::frexp(limited, &exponent) * 256.0f / limited;
    for (int c = 0; c < 3; ++c) rgbe[c] = uint8_t(std::clamp(rgb[c] * scale, 0.0f, 255.0f));
    rgbe[3] = uint8_t(exponent + 128);
}

}  // namespace

bool is_radiance(Bytes file) {
    const auto starts = [&](std::string_view magic) {
        return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
    };
    return starts("#?RADIANCE") || starts("#?RGBE");
}

Result<LoadedImage> decode_radiance(Bytes file, ImageUse) {
    Bytes rest = file;
    DERMIS_TRY_ASSIGN(RadianceHeader header, parse_header(rest));
    const auto [width, height, bottom_up, right_to_left] = header;
    const uint64_t decoded = uint64_t(width) * uint64_t(height) * 12;
    DERMIS_TRY(check_ratio(decoded, rest.size(), kMostRunRatio));

    LoadedImage loaded;
    loaded.image = Image(width, height, 3, PixelFormat::f32, Encoding::linear);
    ByteReader in(rest);
    std::vector<uint8_t> row(size_t(width) * 4);
    for (int y = 0; y < height; ++y) {
        if (!read_row(in, row.data(), width, y == 0))
            return Error{fmt::format("corrupt HDR: row {} of {}{}", y, height,
                                     (in.ok() ? " is damaged" : ": the file ends early"))};
        float* to = loaded.image.floats().data() + size_t(bottom_up ? height - 1 - y : y) * size_t(width) * 3;
        for (int x = 0; x < width; ++x) {
            const uint8_t* rgbe = row.data() + 4 * (right_to_left ? width - 1 - x : x);
            const float scale = rgbe[3] == 0 ? 0.0f : std::ldexp(1.0f, int(rgbe[3]) - (128 + 8));
            for (int c = 0; c < 3; ++c) to[3 * x + c] = float(rgbe[c]) * scale;
        }
    }
    return loaded;
}

Buffer encode_radiance(const Image& image) {
    ByteWriter out;
    out.text(fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width));
    std::vector<uint8_t> row(size_t(image.width) * 4);
    for (int y = 0; y < image.height; ++y) {
        const float* from = image.floats().data() + size_t(y) * size_t(image.width) * 3;
        for (int x = 0; x < image.width; ++x) to_rgbe(from + 3 * x, row.data() + 4 * x);
        if (image.width < kShortestCodedRow) {
            out.raw(std::as_bytes(std::span(row)));
            continue;
        }
        for (const int marker : {2, 2, image.width >> 8, image.width & 255}) out.put(uint8_t(marker));
        for (int component = 0; component < 4; ++component)
            write_runs(out, row.data() + component, image.width);
    }
    return out.finish();
}

}  // namespace dermis::inline image::codec
