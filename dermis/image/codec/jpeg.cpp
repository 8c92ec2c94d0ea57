// JPEG by libjpeg-turbo, straight into u8: grey as one channel, all else as RGB.

#include <turbojpeg.h>

#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {
namespace {

// A flat 4:2:0 picture spends at least one bit on each of the six blocks of 768 decoded bytes: 1024:1. Twice
// that leaves room for what progressive end-of-band runs save.
constexpr uint64_t kMostJpegRatio = 2048;

struct Compressor {
    tjhandle handle = tjInitCompress();
    unsigned char* bytes = nullptr;
    ~Compressor() {
        tjFree(bytes);
        if (handle) tjDestroy(handle);
    }
};

struct Decompressor {
    tjhandle handle = tjInitDecompress();
    ~Decompressor() {
        if (handle) tjDestroy(handle);
    }
    [[nodiscard]] Error error() const { return {std::string("corrupt JPEG: ") + tjGetErrorStr2(handle)}; }

    // After a warning libjpeg goes on and fills missing texels with grey. Accepted are only warnings that
    // leave all texels intact (junk between markers, unusual application data).
    [[nodiscard]] bool passes(int status) const {
        if (status == 0) return true;
        if (tjGetErrorCode(handle) != TJERR_WARNING) return false;
        const std::string_view warning = tjGetErrorStr2(handle);
        return warning.find("extraneous bytes") != warning.npos || warning.find("Adobe") != warning.npos ||
               warning.find("JFIF") != warning.npos;
    }
};

}  // namespace

Result<LoadedImage> decode_jpeg(Bytes file, ImageUse use) {
    const Decompressor decompressor;
    if (!decompressor.handle) return Error{"libjpeg-turbo has no memory"};
    const auto* data = reinterpret_cast<const unsigned char*>(file.data());
    int width = 0, height = 0, subsampling = 0, color_space = 0;
    if (!decompressor.passes(tjDecompressHeader3(decompressor.handle, data, file.size(), &width, &height,
                                                 &subsampling, &color_space)))
        return decompressor.error();
    if (color_space == TJCS_CMYK || color_space == TJCS_YCCK)
        return Error{"CMYK JPEG; dermis reads grey and RGB"};

    const int channels = color_space == TJCS_GRAY ? 1 : 3;
    if (width <= 0 || height <= 0) return Error{"corrupt JPEG: no texels"};
    DERMIS_TRY(check_image_size(uint64_t(width), uint64_t(height), channels));
    const uint64_t decoded = uint64_t(width) * uint64_t(height) * uint64_t(channels);
    DERMIS_TRY(check_ratio(decoded, file.size(), kMostJpegRatio));

    LoadedImage loaded;
    loaded.image = Image(width, height, channels, PixelFormat::u8,
                         use == ImageUse::color ? Encoding::srgb : Encoding::linear);
    const int status = tjDecompress2(
        decompressor.handle, data, file.size(), reinterpret_cast<unsigned char*>(loaded.image.bytes.data()),
        width, 0, height, channels == 1 ? TJPF_GRAY : TJPF_RGB, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
    if (!decompressor.passes(status)) return decompressor.error();
    return loaded;
}

}  // namespace dermis::inline image::codec

namespace dermis::inline image {

Result<std::vector<std::byte>> encode_jpeg(const Image& image, int quality) {
    if (image.format != PixelFormat::u8 || (image.channels != 1 && image.channels != 3) || image.empty())
        return Error{"a JPEG has one or three channels of 8 bits"};
    codec::Compressor compressor;
    const bool grey = image.channels == 1;
    const int sampling = grey ? TJSAMP_GRAY : image.encoding == Encoding::srgb ? TJSAMP_420 : TJSAMP_444;
    unsigned long size = 0;
    if (!compressor.handle || tjCompress2(compressor.handle, image.values<uint8_t>().data(), image.width, 0,
                                          image.height, grey ? TJPF_GRAY : TJPF_RGB, &compressor.bytes, &size,
                                          sampling, quality, TJFLAG_ACCURATEDCT) != 0)
        return Error{std::string("cannot write a JPEG: ") + tjGetErrorStr2(compressor.handle)};
    const auto* bytes = reinterpret_cast<const std::byte*>(compressor.bytes);
    return std::vector(bytes, bytes + size);
}

}  // namespace dermis::inline image
