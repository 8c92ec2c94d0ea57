// PNG by libpng: u8 or u16, with text as iTXt chunks (UTF-8, uncompressed, so that it can be searched for).

#include <png.h>

#include <csetjmp>

#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {
namespace {

// Level 4 writes a 2048x2048 picture about three times as fast as the default 6, for files a few per cent
// larger.
constexpr int kCompressionLevel = 4;

struct PngTarget {
    Buffer bytes;
    char message[160] = {};
};

void on_write_error(png_structp png, png_const_charp message) {
    auto* target = static_cast<PngTarget*>(png_get_error_ptr(png));
    std::snprintf(target->message, sizeof(target->message), "%s", message);
    png_longjmp(png, 1);
}
void on_write_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep from, size_t count) {
    auto* target = static_cast<PngTarget*>(png_get_io_ptr(png));
    const auto* bytes = reinterpret_cast<const std::byte*>(from);
    target->bytes.insert(target->bytes.end(), bytes, bytes + count);
}
void on_flush(png_structp) {}

struct Writer {
    PngTarget target;
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

int color_type(int channels) {
    constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                              PNG_COLOR_TYPE_RGB_ALPHA};
    return kTypes[channels - 1];
}

// All calls of libpng that may jump; owns nothing with a destructor.
void write_all(Writer* w, const Image* image, png_textp text, int text_count, png_bytepp rows) {
    png_set_write_fn(w->png, &w->target, on_write, on_flush);
    png_set_user_limits(w->png, kMaxImageSide, kMaxImageSide);
    png_set_compression_level(w->png, kCompressionLevel);
    const bool wide = image->format == PixelFormat::u16;
    png_set_IHDR(w->png, w->info, png_uint_32(image->width), png_uint_32(image->height), wide ? 16 : 8,
                 color_type(image->channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    // Linear data carries no gAMA chunk: tools that apply it would change normal maps and tables.
    if (image->encoding == Encoding::srgb) png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (text_count > 0) png_set_text(w->png, w->info, text, text_count);
    png_write_info(w->png, w->info);
    if (wide) png_set_swap(w->png);
    png_write_image(w->png, rows);
    png_write_end(w->png, w->info);
}

bool guarded_write(Writer& w, const Image& image, std::vector<png_text>& text, std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(w.png)) != 0) return false;
    write_all(&w, &image, text.data(), int(text.size()), rows.data());
    return true;
}

}  // namespace

Result<Buffer> encode_png(const Image& image, const ImageText& text) {
    std::vector<png_text> chunks;
    for (const auto& [key, value] : text) {
        png_text chunk{};
        chunk.compression = PNG_ITXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(key.c_str());
        chunk.text = const_cast<char*>(value.c_str());
        chunk.itxt_length = value.size();
        chunk.lang = const_cast<char*>("");
        chunk.lang_key = const_cast<char*>("");
        chunks.push_back(chunk);
    }
    std::vector<png_bytep> rows(size_t(image.height));
    const size_t row_bytes = image.bytes.size() / size_t(image.height);
    for (size_t y = 0; y < rows.size(); ++y)
        rows[y] = reinterpret_cast<png_bytep>(const_cast<std::byte*>(image.bytes.data())) + y * row_bytes;

    Writer w;
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w.target, on_write_error, on_write_warning);
    w.info = w.png ? png_create_info_struct(w.png) : nullptr;
    if (!w.info) return Error{"out of memory"};
    if (!guarded_write(w, image, chunks, rows)) return Error{std::string("libpng: ") + w.target.message};
    return std::move(w.target.bytes);
}

}  // namespace dermis::inline image::codec
