#include "image/test_files.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <png.h>
#include <turbojpeg.h>

#include <csetjmp>
#include <memory>
#include <stdexcept>

#include "dermis/image/codec/exr.h"

namespace dermis {
namespace {

void append(png_structp png, png_bytep from, size_t count) {
    auto* out = static_cast<FileBytes*>(png_get_io_ptr(png));
    const auto* bytes = reinterpret_cast<const std::byte*>(from);
    out->insert(out->end(), bytes, bytes + count);
}

FileBytes compress_jpeg(const uint8_t* texels, int width, int height, int pixel_format, int subsampling,
                        int quality, int flags) {
    const tjhandle handle = tjInitCompress();
    unsigned char* out = nullptr;
    unsigned long size = 0;
    if (tjCompress2(handle, texels, width, 0, height, pixel_format, &out, &size, subsampling, quality,
                    flags) != 0)
        throw std::runtime_error(tjGetErrorStr2(handle));
    const auto* bytes = reinterpret_cast<const std::byte*>(out);
    FileBytes file(bytes, bytes + size);
    tjFree(out);
    tjDestroy(handle);
    return file;
}

}  // namespace

FileBytes make_png(const PngSettings& s, const std::vector<std::vector<uint8_t>>& rows) {
    FileBytes file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)) != 0) std::abort();
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, png_uint_32(s.width), png_uint_32(s.height), s.depth, s.color_type,
                 s.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (s.gamma > 0) png_set_gAMA(png, info, s.gamma);
    std::vector<png_color> palette;
    std::vector<png_byte> alpha;
    for (int i = 0; i < 1 << std::min(s.depth, 8); ++i) {
        palette.push_back({png_byte(i), png_byte(2 * i), png_byte(3 * i)});
        alpha.push_back(png_byte(255 - i));
    }
    if (s.color_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), int(palette.size()));
    if (s.palette_alpha) png_set_tRNS(png, info, alpha.data(), int(alpha.size()), nullptr);
    png_write_info(png, info);
    std::vector<png_bytep> pointers;
    for (const auto& row : rows) pointers.push_back(const_cast<png_bytep>(row.data()));
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

FileBytes make_jpeg(const Image& image, int quality, bool progressive) {
    const Image codes = convert(to_linear_float(image), PixelFormat::u8, Encoding::srgb);
    const bool grey = image.channels == 1;
    return compress_jpeg(codes.values<uint8_t>().data(), image.width, image.height,
                         grey ? TJPF_GRAY : TJPF_RGB, grey ? TJSAMP_GRAY : TJSAMP_420, quality,
                         progressive ? TJFLAG_PROGRESSIVE : 0);
}

FileBytes make_cmyk_jpeg(int width, int height) {
    const std::vector<uint8_t> texels(size_t(width) * size_t(height) * 4, 100);
    return compress_jpeg(texels.data(), width, height, TJPF_CMYK, TJSAMP_444, 90, 0);
}

FileBytes make_exr(int width, int height, const ExrSettings& s) {
    const Imath::Box2i window({s.offset_x, s.offset_y}, {s.offset_x + width - 1, s.offset_y + height - 1});
    const auto [x0, y0, x1, y1] = s.display;
    const Imath::Box2i display = x1 < x0 ? window : Imath::Box2i({x0, y0}, {x1, y1});
    Imf::Header header(display, window, 1, {0, 0}, 1, Imf::INCREASING_Y, Imf::Compression(s.compression));
    const Imf::PixelType type = s.float_channels ? Imf::FLOAT : Imf::HALF;
    std::vector<std::unique_ptr<float[]>> wide;
    std::vector<std::unique_ptr<Imath::half[]>> narrow;
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < s.channels.size(); ++c) {
        const size_t count = size_t(width) * size_t(height);
        wide.emplace_back(new float[count]);
        narrow.emplace_back(new Imath::half[count]);
        for (size_t i = 0; i < count; ++i) {
            wide[c][i] = float(c) + float(i % size_t(width)) / 64.0f + float(i / size_t(width)) / 4096.0f;
            narrow[c][i] = wide[c][i];
        }
        void* base =
            s.float_channels ? static_cast<void*>(wide[c].get()) : static_cast<void*>(narrow[c].get());
        const size_t value = s.float_channels ? 4 : 2;
        header.channels().insert(s.channels[c], Imf::Channel(type));
        buffer.insert(s.channels[c], Imf::Slice::Make(type, base, window, value, value * size_t(width)));
    }
    codec::ExrOutput stream;
    if (s.tile_side > 0) {
        header.setTileDescription({unsigned(s.tile_side), unsigned(s.tile_side), Imf::MIPMAP_LEVELS});
        Imf::TiledOutputFile file(stream, header, 0);
        for (int level = 0; level < file.numLevels(); ++level) {
            file.setFrameBuffer(buffer);
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
    } else {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(height);
    }
    return stream.finish();
}

FileBytes make_ktx2(const Ktx2Settings& s, const std::vector<uint8_t>& stored) {
    codec::ByteWriter pairs, out;
    for (const auto& [key, value] : s.pairs) {
        pairs.u32(uint32_t(key.size() + value.size() + 2));
        for (const std::string& text : {key, value}) pairs.text(text), pairs.put(uint8_t(0));
        pairs.align(4);
    }
    const auto pairs_bytes = uint32_t(pairs.size());
    for (const uint32_t word : {0x58544babu, 0xbb303220u, 0x0a1a0a0du}) out.u32(word);
    for (const uint32_t word :
         {s.vulkan, 1u, s.width, s.height, 0u, 0u, 1u, 1u, 0u, 0u, 0u, 104u, pairs_bytes})
        out.u32(word);
    for (const uint64_t word : {uint64_t{0}, uint64_t{0}, uint64_t{104} + pairs_bytes,
                                uint64_t{stored.size()}, uint64_t{stored.size()}})
        out.u64(word);
    out.raw(pairs.finish());
    out.raw(std::as_bytes(std::span(stored)));
    return out.finish();
}

FileBytes make_dds(const DdsSettings& s, const std::vector<uint8_t>& stored) {
    codec::ByteWriter out;
    for (const uint32_t word : {0x20534444u, 124u, 0x1007u, s.height, s.width}) out.u32(word);
    for (int i = 0; i < 14; ++i) out.u32(0);
    out.u32(32);
    out.u32(s.dxgi != 0 ? 4 : s.flags);
    out.u32(s.dxgi != 0 ? 0x30315844 : 0);
    out.u32(s.bits);
    for (const uint32_t mask : s.masks) out.u32(mask);
    for (const uint32_t word : {0x1000u, 0u, 0u, 0u, 0u}) out.u32(word);
    if (s.dxgi != 0)
        for (const uint32_t word : {s.dxgi, 3u, 0u, 1u, 0u}) out.u32(word);
    out.raw(std::as_bytes(std::span(stored)));
    return out.finish();
}

}  // namespace dermis
