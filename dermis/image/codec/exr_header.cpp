// The check of an EXR header before OpenEXR reads it; layout: "OpenEXR File Layout", Academy Software
// Foundation. A header is a list of attributes (name, type, size, value) ended by an empty name; a file of
// several parts has several headers ended by an empty one.

#include <fmt/core.h>

#include <algorithm>

#include "dermis/image/codec/exr.h"

namespace dermis::inline image::codec {
namespace {

constexpr uint32_t kDeepFlag = 0x800, kMultiPartFlag = 0x1000;
constexpr int kMostChannels = 256;
// A chunk (a tile, or the scanlines of one compressed block) is decoded whole, in a buffer of its size.
constexpr uint64_t kMostChunkBytes = uint64_t{512} << 20;

struct Part {
    int64_t width = 0, height = 0;                  // of the data window
    int64_t display_width = 1, display_height = 1;  // OpenEXR asks for the attribute
    int64_t tile_width = 0, tile_height = 0;        // 0: scanlines
    int64_t lines_per_chunk = 1;
    uint64_t bytes_per_texel = 0;
    int channels = 0;
    bool bounded = true;  // false: the compression has no useful largest ratio
    bool deep = false;
};

// Lines in one compressed chunk, by the number of the compression (OpenEXR File Layout, "Compression").
Result<int64_t> lines_of(uint8_t compression) {
    constexpr int64_t kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    if (compression >= std::size(kLines))
        return Error{"corrupt EXR: compression " + std::to_string(compression)};
    return kLines[compression];
}

bool ratio_is_bounded(uint8_t compression) {
    constexpr uint8_t kPiz = 4, kDwaa = 8, kDwab = 9;
    return compression != kPiz && compression != kDwaa && compression != kDwab;
}

Result<void> read_attribute(std::string_view name, Bytes value, Part& part) {
    ByteReader in(value);
    if (name == "dataWindow" || name == "displayWindow") {
        const int64_t x0 = in.read<int32_t>(), y0 = in.read<int32_t>();
        const int64_t x1 = in.read<int32_t>(), y1 = in.read<int32_t>();
        const bool data = name == "dataWindow";
        (data ? part.width : part.display_width) = x1 - x0 + 1;
        (data ? part.height : part.display_height) = y1 - y0 + 1;
    } else if (name == "compression") {
        const uint8_t compression = in.read<uint8_t>();
        DERMIS_TRY_ASSIGN(part.lines_per_chunk, lines_of(compression));
        part.bounded = ratio_is_bounded(compression);
    } else if (name == "tiles") {
        part.tile_width = in.u32();
        part.tile_height = in.u32();
        if (part.tile_width == 0 || part.tile_height == 0) return Error{"corrupt EXR: tiles without texels"};
    } else if (name == "channels") {
        // Name, type (0 uint, 1 half, 2 float), linearity, x and y sampling; fills_its_value() saw the end.
        while (!in.text().empty()) {
            part.bytes_per_texel += in.u32() == 1 ? 2 : 4;
            in.take(12);
            ++part.channels;
        }
    } else if (name == "type") {
        const std::string_view type(reinterpret_cast<const char*>(value.data()), value.size());
        part.deep = type.starts_with("deep");
    }
    if (!in.ok()) return Error{"corrupt EXR: the attribute '" + std::string(name) + "' is cut short"};
    return {};
}

// OpenEXR reads names of up to 255 bytes; what is longer it reads in pieces.
constexpr size_t kLongestName = 255;

// The size of a value of a type that always has the same one; 0: of another type.
uint32_t fixed_size_of(std::string_view type) {
    struct Size {
        std::string_view type;
        uint32_t bytes;
    };
    constexpr Size kSizes[] = {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
                               {"compression", 1}, {"double", 8},   {"envmap", 1},
                               {"float", 4},       {"int", 4},      {"keycode", 28},
                               {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
                               {"m44f", 64},       {"m44d", 128},   {"rational", 8},
                               {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
                               {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
                               {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};
    const auto* found = std::ranges::find(kSizes, type, &Size::type);
    return found == std::end(kSizes) ? 0 : found->bytes;
}

// OpenEXR reads a value by its type, whatever size the attribute states; where the two differ, what follows
// would be read at another place than here, and memory asked for by numbers that are none.
bool fills_its_value(std::string_view type, Bytes value) {
    ByteReader in(value);
    if (type == "chlist") {
        for (std::string_view name = in.text(); in.ok() && !name.empty(); name = in.text()) {
            if (name.size() > kLongestName) return false;
            in.take(16);
        }
    } else if (type == "preview") {  // width, height, 8-bit RGBA
        const uint64_t width = in.u32(), height = in.u32();
        if (width > kMaxImageSide || height > kMaxImageSide) return false;
        in.take(size_t(4 * width * height));
    } else if (type == "stringvector") {
        while (in.ok() && in.position() < value.size()) in.take(in.u32());
    } else if (type == "floatvector") {
        return value.size() % sizeof(float) == 0;
    } else {
        const uint32_t fixed_size = fixed_size_of(type);
        return fixed_size == 0 || value.size() == fixed_size;
    }
    return in.ok() && in.position() == value.size();
}

// OpenEXR takes the last of several attributes of one name or the first, so a repeated one is refused.
Result<Part> read_part(ByteReader& in, std::string_view first_name) {
    Part part;
    std::vector<std::string> seen;
    for (std::string_view name = first_name; !name.empty(); name = in.text()) {
        const std::string_view type = in.text();
        const Bytes value = in.take(in.u32());
        if (!in.ok()) break;
        if (name.size() > kLongestName || type.size() > kLongestName)
            return Error{"corrupt EXR: a name of more than 255 bytes"};
        if (!fills_its_value(type, value))
            return Error{fmt::format("corrupt EXR: the attribute '{}' has {} bytes, not those of its type {}",
                                     name.substr(0, 40), value.size(), type.substr(0, 40))};
        if (std::ranges::find(seen, name) != seen.end())
            return Error{"corrupt EXR: the attribute '" + std::string(name.substr(0, 40)) +
                         "' is there twice"};
        seen.emplace_back(name);
        DERMIS_TRY(read_attribute(name, value, part));
    }
    if (!in.ok()) return Error{"corrupt EXR: the file ends in the header"};
    return part;
}

Result<void> check_part(const Part& part, uint64_t file_bytes) {
    if (part.deep) return Error{"deep EXR; dermis reads flat images"};
    if (part.width <= 0 || part.height <= 0) return Error{"corrupt EXR: a data window without texels"};
    DERMIS_TRY(check_image_size(uint64_t(part.width), uint64_t(part.height), 1));
    if (part.display_width <= 0 || part.display_height <= 0)
        return Error{"corrupt EXR: a display window without texels"};
    DERMIS_TRY(check_image_size(uint64_t(part.display_width), uint64_t(part.display_height), 1));
    if (part.channels == 0 || part.channels > kMostChannels)
        return Error{fmt::format("EXR of {} channels; dermis reads 1 to {}", part.channels, kMostChannels)};
    const bool tiled = part.tile_width > 0;
    if (tiled && (part.tile_width > kMaxImageSide || part.tile_height > kMaxImageSide))
        return Error{"corrupt EXR: tiles larger than any image"};
    const auto blocks = [](int64_t side, int64_t block) { return (side + block - 1) / block; };
    const int64_t chunks = tiled ? blocks(part.width, part.tile_width) * blocks(part.height, part.tile_height)
                                 : blocks(part.height, part.lines_per_chunk);
    const int64_t chunk_texels =
        tiled ? part.tile_width * part.tile_height : part.width * part.lines_per_chunk;
    if (uint64_t(chunk_texels) * part.bytes_per_texel > kMostChunkBytes)
        return Error{"EXR in blocks larger than 512 MiB"};
    // A table has 8 bytes for each chunk.
    if (uint64_t(chunks) * 8 > file_bytes) return Error{"corrupt EXR: the file is too short for its size"};
    constexpr uint64_t kMostZipRatio = 1032;
    if (!part.bounded) return {};
    return check_ratio(uint64_t(part.width * part.height) * part.bytes_per_texel, file_bytes, kMostZipRatio);
}

}  // namespace

Result<void> check_exr_header(Bytes file) {
    ByteReader in(file, 4);
    const uint32_t version = in.u32();
    if (version & kDeepFlag) return Error{"deep EXR; dermis reads flat images"};
    for (bool more = true; more;) {
        const std::string_view first_name = in.text();
        if (!in.ok()) return Error{"corrupt EXR: the file ends in the header"};
        if (first_name.empty()) break;
        DERMIS_TRY_ASSIGN(Part part, read_part(in, first_name));
        DERMIS_TRY(check_part(part, file.size()));
        more = (version & kMultiPartFlag) != 0;
    }
    return {};
}

}  // namespace dermis::inline image::codec
