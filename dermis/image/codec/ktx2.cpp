// KTX 2.0 (Khronos, "KTX File Format Specification" 2.0.4): identifier, header, index, one level, data format
// descriptor, key/value pairs, texels. Written as VK_FORMAT_R16G16B16A16_SFLOAT without mips; read in any
// format of texel_format.h without supercompression.

#include <algorithm>
#include <array>

#include "dermis/image/codec/codec.h"
#include "dermis/image/codec/texel_format.h"

namespace dermis::inline image::codec {
namespace {

constexpr std::array<uint8_t, 12> kIdentifier = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                                 '0',  0xbb, '\r', '\n', 0x1a, '\n'};
constexpr size_t kKtx2HeaderBytes = 80, kLevelBytes = 24;
constexpr std::string_view kWriter = "KTXwriter", kOrientation = "KTXorientation", kSwizzle = "KTXswizzle";

// Khronos Data Format Specification 1.3, basic descriptor block: model RGBSDA (1), primaries BT.709 (1),
// transfer linear (1), one sample per channel: 16 bits, signed float, -1 to 1 being the nominal range.
std::array<uint32_t, 23> rgba16f_descriptor() {
    constexpr uint32_t kBlockBytes = 24 + 4 * 16, kVersion = 2;
    constexpr uint32_t kModelRgbsda = 1, kPrimariesBt709 = 1, kTransferLinear = 1;
    constexpr uint32_t kSigned = 0x40, kFloat = 0x80;
    constexpr uint32_t kChannels[] = {0, 1, 2, 15};  // red, green, blue, alpha
    std::array<uint32_t, 23> words{};
    words[0] = kBlockBytes + 4;
    words[2] = kVersion | kBlockBytes << 16;
    words[3] = kModelRgbsda | kPrimariesBt709 << 8 | kTransferLinear << 16;
    words[5] = 8;  // bytes of plane 0
    for (uint32_t c = 0; c < 4; ++c) {
        uint32_t* sample = words.data() + 7 + 4 * c;
        sample[0] = c * 16 | 15u << 16 | (kChannels[c] | kSigned | kFloat) << 24;
        sample[2] = 0xbf800000u;  // -1
        sample[3] = 0x3f800000u;  // 1
    }
    return words;
}

// Pairs are sorted by key (std::map's order is that of the bytes), each padded to four bytes.
Buffer key_values(const ImageText& text) {
    ImageText all = text;
    all[std::string(kWriter)] = "dermis";
    all[std::string(kOrientation)] = "rd";  // x to the right, y down
    ByteWriter out;
    for (const auto& [key, value] : all) {
        out.u32(uint32_t(key.size() + 1 + value.size() + 1));
        out.text(key);
        out.put(uint8_t(0));
        out.text(value);
        out.put(uint8_t(0));
        out.align(4);
    }
    return out.finish();
}

// All pairs; the caller removes those of the format itself.
Result<ImageText> read_key_values(Bytes bytes) {
    const Error cut{"corrupt KTX2: the key/value data is cut short"};
    ImageText text;
    ByteReader in(bytes);
    while (in.position() < bytes.size()) {
        const uint32_t length = in.u32();
        const Bytes pair = in.take(length);
        in.take((4 - length % 4) % 4);
        if (!in.ok()) return cut;
        ByteReader fields(pair);
        const std::string_view key = fields.text();
        if (!fields.ok()) return cut;
        const Bytes rest = pair.subspan(fields.position());
        std::string_view value(reinterpret_cast<const char*>(rest.data()), rest.size());
        if (value.ends_with('\0')) value.remove_suffix(1);
        text[std::string(key)] = value;
    }
    return text;
}

// Removes a pair; its value, or `fallback`.
std::string take_value(ImageText& text, std::string_view key, std::string_view fallback) {
    const auto found = text.find(std::string(key));
    if (found == text.end()) return std::string(fallback);
    std::string value = std::move(found->second);
    text.erase(found);
    return value;
}

// Applies KTXswizzle and KTXorientation: "rd" has its first texel at the top left, "ru" at the bottom left.
Result<Image> as_oriented(Image stored, const TexelFormat& format, ImageText& text) {
    const std::string orientation = take_value(text, kOrientation, "rd");
    const std::string swizzle = take_value(text, kSwizzle, "rgba");
    (void)take_value(text, kWriter, "");
    if (orientation.size() != 2 || std::string_view("rl").find(orientation[0]) == std::string_view::npos ||
        std::string_view("du").find(orientation[1]) == std::string_view::npos)
        return Error{"corrupt KTX2: the orientation '" + orientation.substr(0, 20) +
                     "' is not rd, ru, ld or lu"};
    Result<Image> image = apply_swizzle(std::move(stored), format.swizzle);
    if (image) image = apply_swizzle(*std::move(image), swizzle);
    if (!image) return Error{"KTX2: " + image.error().message};
    if (orientation[0] == 'l') image = mirror_columns(*image);
    if (orientation[1] == 'u') image = mirror_rows(*image);
    return image;
}

struct Ktx2Header {
    uint32_t format = 0, width = 0, height = 0;
    uint32_t text_offset = 0, text_bytes = 0;
    uint64_t level_offset = 0, level_bytes = 0;
};

Result<Ktx2Header> read_header(Bytes file) {
    ByteReader in(file, kIdentifier.size());
    Ktx2Header header;
    header.format = in.u32();
    in.u32();  // type size
    header.width = in.u32();
    header.height = in.u32();
    const uint32_t depth = in.u32(), layers = in.u32(), faces = in.u32();
    in.u32();  // levels
    const uint32_t supercompression = in.u32();
    in.take(8);  // descriptor
    header.text_offset = in.u32();
    header.text_bytes = in.u32();
    in.take(16);  // supercompression data
    header.level_offset = in.u64();
    header.level_bytes = in.u64();
    if (!in.ok()) return Error{"corrupt KTX2: the file ends in the header"};
    if (depth > 1 || layers > 1 || faces != 1)
        return Error{"KTX2 array, cube map or volume; dermis reads flat images"};
    if (supercompression != 0) return Error{"supercompressed KTX2; dermis reads plain ones"};
    return header;
}

Error unread_vulkan_format(uint32_t vulkan) {
    // VK_FORMAT_BC1_RGB_UNORM_BLOCK to VK_FORMAT_ASTC_12x12_SRGB_BLOCK; VK_FORMAT_UNDEFINED is Basis
    // Universal.
    const bool compressed = vulkan == 0 || (vulkan >= 131 && vulkan <= 184);
    return Error{(compressed ? "block-compressed KTX2 (VkFormat " : "KTX2 of VkFormat ") +
                 std::to_string(vulkan) + (compressed ? "); " : "; ") + kReadTexelFormats};
}

}  // namespace

bool is_ktx2(Bytes file) {
    return file.size() >= kIdentifier.size() &&
           std::memcmp(file.data(), kIdentifier.data(), kIdentifier.size()) == 0;
}

Result<LoadedImage> decode_ktx2(Bytes file, ImageUse) {
    DERMIS_TRY_ASSIGN(Ktx2Header header, read_header(file));
    const TexelFormat* format = find_vulkan(header.format);
    if (!format) return unread_vulkan_format(header.format);
    DERMIS_TRY(check_image_size(header.width, header.height, format->channels));
    const uint64_t count = uint64_t(header.width) * header.height * uint64_t(format->channels) *
                           bytes_per_channel(format->format);
    if (header.level_bytes != count) return Error{"corrupt KTX2: the level has not the size of its texels"};
    ByteReader level(file, size_t(header.level_offset)), pairs(file, header.text_offset);
    const Bytes texels = level.take(count), text = pairs.take(header.text_bytes);
    if (!level.ok() || !pairs.ok()) return Error{"corrupt KTX2: the file ends early"};

    LoadedImage loaded;
    DERMIS_TRY_ASSIGN(loaded.text, read_key_values(text));
    Image stored(int(header.width), int(header.height), format->channels, format->format, format->encoding);
    std::memcpy(stored.bytes.data(), texels.data(), texels.size());
    DERMIS_TRY_ASSIGN(loaded.image, as_oriented(std::move(stored), *format, loaded.text));
    return loaded;
}

Buffer encode_ktx2(const Image& image, const ImageText& text) {
    const std::array<uint32_t, 23> descriptor = rgba16f_descriptor();
    const Buffer pairs = key_values(text);
    const size_t descriptor_at = kKtx2HeaderBytes + kLevelBytes,
                 pairs_at = descriptor_at + sizeof(descriptor);
    const size_t texels_at = (pairs_at + pairs.size() + 7) / 8 * 8;  // a multiple of the texel's size

    ByteWriter out;
    out.raw(std::as_bytes(std::span(kIdentifier)));
    for (const uint32_t value :
         {kVulkanRgba16Float, 2u, uint32_t(image.width), uint32_t(image.height), 0u, 0u, 1u, 1u, 0u,
          uint32_t(descriptor_at), uint32_t(sizeof(descriptor)), uint32_t(pairs_at), uint32_t(pairs.size())})
        out.u32(value);
    out.u64(0);
    out.u64(0);
    for (const uint64_t value :
         {uint64_t(texels_at), uint64_t(image.bytes.size()), uint64_t(image.bytes.size())})
        out.u64(value);
    out.raw(std::as_bytes(std::span(descriptor)));
    out.raw(pairs);
    out.align(8);
    out.raw(image.bytes);
    return out.finish();
}

}  // namespace dermis::inline image::codec
