// PNG (ISO/IEC 15948) by libpng: any depth and colour type to u8 or u16 with 1 to 4 channels.
//
// libpng reports errors by longjmp. Each step that may jump is one call of a plain function through
// guarded(), and owns nothing with a destructor, so that a jump skips none.

#include <fmt/core.h>
#include <png.h>

#include <csetjmp>

#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {
namespace {

// Deflate reaches 1032:1 (a match of 258 bytes in two bits), and a 1-bit palette with transparency expands to
// 32 bits per texel.
constexpr uint64_t kMostPngRatio = 1032 * 32;
constexpr size_t kMostTextBytes = size_t{16} << 20;

struct Source {
    Bytes rest;
    char message[160] = {};
};

void on_read_error(png_structp png, png_const_charp message) {
    auto* source = static_cast<Source*>(png_get_error_ptr(png));
    std::snprintf(source->message, sizeof(source->message), "%s", message);
    png_longjmp(png, 1);
}
void on_read_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->rest.size()) png_error(png, "the file ends early");
    std::memcpy(to, source->rest.data(), count);
    source->rest = source->rest.subspan(count);
}

struct Reader {
    Source source;
    png_structp png = nullptr;
    png_infop info = nullptr;
    bool srgb = true;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

template <class Step, class... Arguments>
bool guarded(png_structp png, Step step, Arguments... arguments) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    step(arguments...);
    return true;
}

// Whether the file states linear light: an explicit gamma of 1 without an sRGB chunk.
bool says_linear(png_structp png, png_infop info) {
    png_fixed_point gamma = 0;
    return !png_get_valid(png, info, PNG_INFO_sRGB) && png_get_gAMA_fixed(png, info, &gamma) != 0 &&
           gamma == PNG_FP_1;
}

void read_png_header(Reader* r, ImageUse use) {
    png_set_read_fn(r->png, &r->source, on_read);
    png_set_user_limits(r->png, kMaxImageSide, kMaxImageSide);
    png_set_chunk_malloc_max(r->png, kMostTextBytes);
    png_read_info(r->png, r->info);
    png_set_expand(r->png);  // palettes to RGB, 1 to 4 bits to 8, tRNS to alpha
    if (png_get_bit_depth(r->png, r->info) == 16) png_set_swap(r->png);
    png_set_interlace_handling(r->png);
    r->srgb = use == ImageUse::color && !says_linear(r->png, r->info);
    // Two linear channels would be red and green.
    const bool grey = (png_get_color_type(r->png, r->info) & PNG_COLOR_MASK_COLOR) == 0;
    const bool alpha = (png_get_color_type(r->png, r->info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                       png_get_valid(r->png, r->info, PNG_INFO_tRNS) != 0;
    if (grey && alpha && !r->srgb) png_set_gray_to_rgb(r->png);
    png_read_update_info(r->png, r->info);
}

void read_rows(Reader* r, png_bytepp rows) {
    png_read_image(r->png, rows);
    png_read_end(r->png, r->info);
}

ImageText read_text(Reader& r) {
    ImageText text;
    png_textp chunks = nullptr;
    int count = 0;
    png_get_text(r.png, r.info, &chunks, &count);
    for (int i = 0; i < count; ++i) {
        const bool international = chunks[i].compression >= PNG_ITXT_COMPRESSION_NONE;
        const size_t length = international ? chunks[i].itxt_length : chunks[i].text_length;
        text[chunks[i].key] = std::string(chunks[i].text ? chunks[i].text : "", chunks[i].text ? length : 0);
    }
    return text;
}

// libpng allocates a chunk's stated length before it reads. Every chunk must end within the file.
Result<void> check_chunks(Bytes file) {
    ByteReader in(file, 8);
    for (;;) {
        const Bytes length = in.take(4), type = in.take(4);
        if (!in.ok()) return {};  // libpng says what is missing
        uint64_t bytes = 0;
        for (const std::byte b : length) bytes = bytes << 8 | uint64_t(b);
        const std::string_view name(reinterpret_cast<const char*>(type.data()), 4);
        if (bytes + 4 > file.size() - in.position())
            return Error{fmt::format("corrupt PNG: the file ends early: a chunk of {} bytes with {} left",
                                     bytes, file.size() - in.position())};
        in.take(bytes + 4);
        if (name == "IEND") return {};
    }
}

Error corrupt(const Reader& r) {
    return Error{std::string("corrupt PNG: ") + r.source.message};
}

}  // namespace

Result<LoadedImage> decode_png(Bytes file, ImageUse use) {
    DERMIS_TRY(check_chunks(file));
    Reader r;
    r.source.rest = file;
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r.source, on_read_error, on_read_warning);
    r.info = r.png ? png_create_info_struct(r.png) : nullptr;
    if (!r.info) return Error{"out of memory"};
    if (!guarded(r.png, read_png_header, &r, use)) return corrupt(r);

    const uint32_t width = png_get_image_width(r.png, r.info), height = png_get_image_height(r.png, r.info);
    const int channels = png_get_channels(r.png, r.info);
    const PixelFormat format = png_get_bit_depth(r.png, r.info) == 16 ? PixelFormat::u16 : PixelFormat::u8;
    DERMIS_TRY(check_image_size(width, height, channels));
    const uint64_t stored_row = png_get_rowbytes(r.png, r.info);
    DERMIS_TRY(check_ratio(stored_row * height, file.size(), kMostPngRatio));

    LoadedImage loaded;
    loaded.image =
        Image(int(width), int(height), channels, format, r.srgb ? Encoding::srgb : Encoding::linear);
    std::vector<png_bytep> rows(height);
    for (size_t y = 0; y < height; ++y)
        rows[y] = reinterpret_cast<png_bytep>(loaded.image.bytes.data()) + y * stored_row;
    if (!guarded(r.png, read_rows, &r, rows.data())) return corrupt(r);
    loaded.text = read_text(r);
    return loaded;
}

}  // namespace dermis::inline image::codec
