// DirectDraw Surface with the DX10 header (Microsoft, "Programming Guide for DDS"): magic, a header of 124
// bytes, one of 20, then the texels. Written as RGBA16F without mips; read in any format of texel_format.h,
// plus what older files, without the second header, describe: two float formats by a D3DFORMAT number, and 8
// bits per channel by masks.

#include <fmt/core.h>

#include <array>

#include "dermis/image/codec/codec.h"
#include "dermis/image/codec/texel_format.h"

namespace dermis::inline image::codec {
namespace {

constexpr uint32_t kMagic = 0x20534444;  // "DDS "
constexpr uint32_t kHeaderBytes = 124, kPixelFormatBytes = 32;
constexpr uint32_t kDx10 = 0x30315844;  // "DX10"
constexpr uint32_t kAlphaFlag = 0x1, kFourCcFlag = 0x4, kRgbFlag = 0x40, kLuminanceFlag = 0x20000;
// caps | height | width | pitch | pixel format
constexpr uint32_t kHeaderFlags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;
constexpr uint32_t kTextureCaps = 0x1000, kCubeCaps2 = 0x200, kVolumeCaps2 = 0x200000;
constexpr uint32_t kDimension2d = 3, kCubeMisc = 0x4;
constexpr uint32_t kD3dA16B16G16R16F = 113, kD3dA32B32G32R32F = 116;

struct Header {
    uint32_t width = 0, height = 0;
    TexelFormat format{};
    std::string swizzle;
    Encoding encoding = Encoding::linear;  // after the swizzle
};

struct Masks {
    uint32_t flags = 0, bits = 0;
    std::array<uint32_t, 4> of{};  // red, green, blue, alpha
};

// The byte that an 8-bit channel's mask selects: 'r', 'g', 'b', 'a' for the first to the fourth in the file.
char channel_under(uint32_t mask) {
    for (uint32_t byte = 0; byte < 4; ++byte)
        if (mask == 0xffu << (8 * byte)) return "rgba"[byte];
    return '0';
}

// Files of Direct3D 9. They do not state whether colours are sRGB-encoded; the image's use decides.
Result<void> read_masked_format(const Masks& masks, ImageUse use, Header& header) {
    const bool grey = (masks.flags & kLuminanceFlag) != 0;
    const char red = channel_under(masks.of[0]), green = channel_under(masks.of[1]),
               blue = channel_under(masks.of[2]), alpha = channel_under(masks.of[3]);
    const bool has_alpha = (masks.flags & kAlphaFlag) != 0;
    const bool whole_bytes = masks.bits % 8 == 0 && masks.bits >= 8 && masks.bits <= 32;
    const bool known = red != '0' && (grey || (green != '0' && blue != '0')) && (!has_alpha || alpha != '0');
    if (!whole_bytes || !known || !(masks.flags & (kRgbFlag | kLuminanceFlag)))
        return Error{
            fmt::format("DDS of {} bits a texel without a DX10 header; of these dermis reads 8 bits a "
                        "channel, grey or colour, with or without alpha",
                        masks.bits)};
    // Linear while the channels are sorted: sRGB treats the last of two or four channels as alpha.
    header.format = {0, 0, PixelFormat::u8, int(masks.bits / 8), Encoding::linear};
    header.encoding = use == ImageUse::color ? Encoding::srgb : Encoding::linear;
    header.swizzle = {red, grey ? red : green, grey ? red : blue, has_alpha ? alpha : '1'};
    // A grey image stays one channel.
    if (header.swizzle == "rrr1" && header.format.channels == 1) header.swizzle = "r001";
    return {};
}

Error unread_format(uint32_t dxgi) {
    const bool compressed = (dxgi >= 70 && dxgi <= 84) || (dxgi >= 94 && dxgi <= 99);  // BC1 to BC7
    return Error{(compressed ? "block-compressed DDS (DXGI format " : "DDS of DXGI format ") +
                 std::to_string(dxgi) + (compressed ? "); " : "; ") + kReadTexelFormats};
}

Result<void> set_format(uint32_t dxgi, Header& header) {
    const TexelFormat* format = find_dxgi(dxgi);
    if (!format) return unread_format(dxgi);
    header.format = *format;
    header.swizzle = format->swizzle;
    header.encoding = format->encoding;
    return {};
}

// The header of 20 bytes, into `header`.
Result<void> read_dx10_header(ByteReader& in, Header& header) {
    const uint32_t dxgi = in.u32(), dimension = in.u32(), misc = in.u32(), layers = in.u32();
    in.u32();
    if (!in.ok()) return Error{"corrupt DDS: the file ends in the header"};
    if (dimension != kDimension2d || (misc & kCubeMisc) || layers > 1)
        return Error{"DDS array, cube map or volume; dermis reads flat images"};
    return set_format(dxgi, header);
}

Result<Header> read_header(ByteReader& in, ImageUse use) {
    Header header;
    in.u32();  // magic
    const uint32_t size = in.u32();
    in.u32();  // flags
    header.height = in.u32();
    header.width = in.u32();
    in.take(4 * 3 + 4 * 11);  // pitch, depth, mips, reserved
    const uint32_t pixel_format_size = in.u32();
    Masks masks{.flags = in.u32()};
    const uint32_t four_cc = in.u32();
    masks.bits = in.u32();
    for (uint32_t& mask : masks.of) mask = in.u32();
    in.u32();  // caps
    const uint32_t caps2 = in.u32();
    in.take(4 * 3);
    if (!in.ok()) return Error{"corrupt DDS: the file ends in the header"};
    if (size != kHeaderBytes || pixel_format_size != kPixelFormatBytes)
        return Error{"corrupt DDS: wrong header size"};
    if (caps2 & (kCubeCaps2 | kVolumeCaps2)) return Error{"DDS cube map or volume; dermis reads flat images"};
    Result<void> known;
    if (!(masks.flags & kFourCcFlag))
        known = read_masked_format(masks, use, header);
    else if (four_cc == kDx10)
        known = read_dx10_header(in, header);
    else if (four_cc == kD3dA16B16G16R16F)
        known = set_format(kDxgiRgba16Float, header);
    else if (four_cc == kD3dA32B32G32R32F)
        known = set_format(kDxgiRgba32Float, header);
    else
        known = Error{"block-compressed DDS; dermis reads uncompressed ones"};
    if (!known) return known.error();
    return header;
}

}  // namespace

bool is_dds(Bytes file) {
    return ByteReader(file).u32() == kMagic;
}

Result<LoadedImage> decode_dds(Bytes file, ImageUse use) {
    ByteReader in(file);
    DERMIS_TRY_ASSIGN(Header header, read_header(in, use));
    const TexelFormat& format = header.format;
    DERMIS_TRY(check_image_size(header.width, header.height, format.channels));
    const uint64_t count =
        uint64_t(header.width) * header.height * uint64_t(format.channels) * bytes_per_channel(format.format);
    const Bytes texels = in.take(count);
    if (!in.ok()) return Error{"corrupt DDS: the file ends early"};
    Image stored(int(header.width), int(header.height), format.channels, format.format, format.encoding);
    std::memcpy(stored.bytes.data(), texels.data(), texels.size());
    Result<Image> image = apply_swizzle(std::move(stored), header.swizzle);
    if (!image) return Error{"DDS: " + image.error().message};
    image->encoding = header.encoding;
    return LoadedImage{*std::move(image), {}};
}

Buffer encode_dds(const Image& image) {
    ByteWriter out;
    const auto zeros = [&](int count) {
        for (int i = 0; i < count; ++i) out.u32(0);
    };
    for (const uint32_t value : {kMagic, kHeaderBytes, kHeaderFlags, uint32_t(image.height),
                                 uint32_t(image.width), uint32_t(image.width) * 8})
        out.u32(value);
    zeros(1);    // depth
    out.u32(1);  // mips
    zeros(11);
    for (const uint32_t value : {kPixelFormatBytes, kFourCcFlag, kDx10}) out.u32(value);
    zeros(5);
    out.u32(kTextureCaps);
    zeros(4);
    for (const uint32_t value : {kDxgiRgba16Float, kDimension2d, 0u, 1u, 0u}) out.u32(value);
    out.raw(image.bytes);
    return out.finish();
}

}  // namespace dermis::inline image::codec
