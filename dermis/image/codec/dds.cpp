// DirectDraw Surface with the DX10 header (Microsoft, "Programming Guide for DDS"): magic, a header of 124
// bytes, one of 20, then the texels. Written as RGBA16F without mips; read in any format of texel_format.h,
// plus the two float formats that older files name by a D3DFORMAT number.

#include "dermis/image/codec/codec.h"
#include "dermis/image/codec/texel_format.h"

namespace dermis::codec {
namespace {

constexpr uint32_t kMagic = 0x20534444;  // "DDS "
constexpr uint32_t kHeaderBytes = 124, kPixelFormatBytes = 32;
constexpr uint32_t kDx10 = 0x30315844;  // "DX10"
constexpr uint32_t kFourCcFlag = 0x4;
// caps | height | width | pitch | pixel format
constexpr uint32_t kHeaderFlags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;
constexpr uint32_t kTextureCaps = 0x1000, kCubeCaps2 = 0x200, kVolumeCaps2 = 0x200000;
constexpr uint32_t kDimension2d = 3, kCubeMisc = 0x4;
constexpr uint32_t kD3dA16B16G16R16F = 113, kD3dA32B32G32R32F = 116;

struct Header {
    uint32_t width = 0, height = 0, dxgi = 0;
};

Result<Header> read_header(ByteReader& in) {
    Header header;
    in.u32();  // magic
    const uint32_t size = in.u32();
    in.u32();  // flags
    header.height = in.u32();
    header.width = in.u32();
    in.take(4 * 3 + 4 * 11);  // pitch, depth, mips, reserved
    const uint32_t pixel_format_size = in.u32(), pixel_flags = in.u32(), four_cc = in.u32();
    in.take(4 * 5);  // bit count and masks
    in.u32();        // caps
    const uint32_t caps2 = in.u32();
    in.take(4 * 3);
    if (!in.ok()) return Error{"corrupt DDS: the file ends in the header"};
    if (size != kHeaderBytes || pixel_format_size != kPixelFormatBytes)
        return Error{"corrupt DDS: wrong header size"};
    if (caps2 & (kCubeCaps2 | kVolumeCaps2)) return Error{"DDS cube map or volume; dermis reads flat images"};
    if (!(pixel_flags & kFourCcFlag))
        return Error{"DDS without a DX10 header; dermis reads uncompressed DX10 files"};
    if (four_cc == kD3dA16B16G16R16F) header.dxgi = kDxgiRgba16Float;
    if (four_cc == kD3dA32B32G32R32F) header.dxgi = 2;
    if (header.dxgi != 0) return header;
    if (four_cc != kDx10) return Error{"compressed DDS; dermis reads uncompressed ones"};
    header.dxgi = in.u32();
    const uint32_t dimension = in.u32(), misc = in.u32(), layers = in.u32();
    in.u32();
    if (!in.ok()) return Error{"corrupt DDS: the file ends in the header"};
    if (dimension != kDimension2d || (misc & kCubeMisc) || layers > 1)
        return Error{"DDS array, cube map or volume; dermis reads flat images"};
    return header;
}

}  // namespace

bool is_dds(Bytes file) {
    return ByteReader(file).u32() == kMagic;
}

Result<LoadedImage> decode_dds(Bytes file, ImageUse) {
    ByteReader in(file);
    Result<Header> header = read_header(in);
    if (!header) return header.error();
    const TexelFormat* format = find_dxgi(header->dxgi);
    if (!format || header->dxgi == 0)
        return Error{"DDS of DXGI format " + std::to_string(header->dxgi) +
                     "; dermis reads uncompressed ones"};
    if (Result<void> size = check_image_size(header->width, header->height, format->channels, format->format);
        !size)
        return size.error();
    const uint64_t count = uint64_t(header->width) * header->height * uint64_t(format->channels) *
                           bytes_per_channel(format->format);
    const Bytes texels = in.take(count);
    if (!in.ok()) return Error{"corrupt DDS: the file ends early"};
    LoadedImage loaded;
    loaded.image =
        Image(int(header->width), int(header->height), format->channels, format->format, format->encoding);
    std::memcpy(loaded.image.bytes.data(), texels.data(), texels.size());
    return loaded;
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

}  // namespace dermis::codec
