#pragma once
// Inside dermis/image only: one decoder and encoder per file format, from bytes to bytes. Errors carry the
// reason alone; io.cpp puts the file's name before it.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/image/io.h"

namespace dermis::inline image::codec {

using Bytes = std::span<const std::byte>;
using Buffer = std::vector<std::byte>;

[[nodiscard]] bool is_radiance(Bytes file);
[[nodiscard]] bool is_dds(Bytes file);
[[nodiscard]] bool is_ktx2(Bytes file);

[[nodiscard]] Result<LoadedImage> decode_png(Bytes file, ImageUse use);
[[nodiscard]] Result<LoadedImage> decode_jpeg(Bytes file, ImageUse use);
[[nodiscard]] Result<LoadedImage> decode_radiance(Bytes file, ImageUse use);
[[nodiscard]] Result<LoadedImage> decode_exr(Bytes file, ImageUse use);
[[nodiscard]] Result<LoadedImage> decode_dds(Bytes file, ImageUse use);
[[nodiscard]] Result<LoadedImage> decode_ktx2(Bytes file, ImageUse use);

[[nodiscard]] Result<LayeredImage> decode_layered_exr(Bytes file);

/// `image` is u8 or u16.
[[nodiscard]] Result<Buffer> encode_png(const Image& image, const ImageText& text);
/// Every image f16 or f32 and linear, all of one size.
[[nodiscard]] Result<Buffer> encode_exr(std::span<const ImageLayer> layers, const ImageText& text);
/// `image` is f32, linear, of three channels.
[[nodiscard]] Buffer encode_radiance(const Image& image);
/// `image` is f16, linear, of four channels.
[[nodiscard]] Buffer encode_dds(const Image& image);
[[nodiscard]] Buffer encode_ktx2(const Image& image, const ImageText& text);

/// A decoded size that no file of this length can hold is a lie or a bomb: `most` is the largest ratio of
/// decoded to stored bytes that the format's compression reaches.
[[nodiscard]] Result<void> check_ratio(uint64_t decoded_bytes, uint64_t file_bytes, uint64_t most);

/// Little-endian numbers out of untrusted bytes: reading past the end gives zeros and clears ok().
class ByteReader {
  public:
    explicit ByteReader(Bytes bytes, size_t at = 0) : bytes_(bytes), at_(at) {}

    template <class T>
    T read() {
        T value{};
        if (const Bytes raw = take(sizeof(T)); !raw.empty()) std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }
    uint32_t u32() { return read<uint32_t>(); }
    uint64_t u64() { return read<uint64_t>(); }

    /// The next `count` bytes, or none of them.
    Bytes take(uint64_t count) {
        if (!ok_ || at_ > bytes_.size() || count > bytes_.size() - at_) {
            ok_ = false;
            return {};
        }
        const Bytes part = bytes_.subspan(at_, size_t(count));
        at_ += size_t(count);
        return part;
    }
    /// Text up to and past a zero byte; the zero must exist.
    std::string_view text() {
        const Bytes rest = ok_ && at_ <= bytes_.size() ? bytes_.subspan(at_) : Bytes{};
        const void* end = rest.empty() ? nullptr : std::memchr(rest.data(), 0, rest.size());
        if (!end) {
            ok_ = false;
            return {};
        }
        const size_t length = size_t(static_cast<const std::byte*>(end) - rest.data());
        at_ += length + 1;
        return {reinterpret_cast<const char*>(rest.data()), length};
    }
    void seek(size_t at) { at_ = at; }
    [[nodiscard]] size_t position() const { return at_; }
    [[nodiscard]] bool ok() const { return ok_; }

  private:
    Bytes bytes_;
    size_t at_;
    bool ok_ = true;
};

/// Appends little-endian numbers.
class ByteWriter {
  public:
    template <class T>
    void put(T value) {
        const size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &value, sizeof(T));
    }
    void u32(uint32_t value) { put(value); }
    void u64(uint64_t value) { put(value); }
    void text(std::string_view text) { raw(std::as_bytes(std::span(text.data(), text.size()))); }
    void raw(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    /// Zeros up to a multiple of `alignment`.
    void align(size_t alignment) { bytes_.resize((bytes_.size() + alignment - 1) / alignment * alignment); }
    [[nodiscard]] size_t size() const { return bytes_.size(); }
    [[nodiscard]] Buffer finish() { return std::move(bytes_); }

  private:
    Buffer bytes_;
};

static_assert(std::endian::native == std::endian::little, "the codecs copy little-endian numbers");

}  // namespace dermis::inline image::codec
