// DDS and KTX2.

#include <gtest/gtest.h>

#include <cstring>

#include "dermis/base/vec.h"
#include "dermis/image/io.h"
#include "image/test_files.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

uint32_t word(const FileBytes& file, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, file.data() + offset, 4);
    return value;
}
void set_word(FileBytes& file, size_t offset, uint32_t value) {
    std::memcpy(file.data() + offset, &value, 4);
}

Result<LoadedImage> decode_container(const FileBytes& file) {
    return decode_image(file, "table", ImageUse::data);
}

const Image kTable = convert(test_pattern(6, 3, 4), PixelFormat::f16, Encoding::linear);

}  // namespace

TEST(GpuContainer, half_rgba_reads_back_exactly_from_both) {
    for (const char* extension : {".dds", ".ktx2"}) {
        const Result<LoadedImage> loaded = decode_container(*encode_image(extension, kTable));
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->image.bytes, kTable.bytes) << extension;
        EXPECT_EQ(loaded->image.format, PixelFormat::f16);
        EXPECT_EQ(loaded->image.channels, 4);
    }
}

TEST(GpuContainer, missing_channels_are_filled_in) {
    Image grey(1, 1, 1), two(1, 1, 2);
    grey.set(0, 0, 0, 0.5f);
    two.set(0, 0, 1, 0.25f);
    const auto texel = [](const Image& i) {
        return Vec4{i.at(0, 0, 0), i.at(0, 0, 1), i.at(0, 0, 2), i.at(0, 0, 3)};
    };
    EXPECT_EQ(texel(decode_container(*encode_image(".dds", grey))->image), (Vec4{0.5f, 0.5f, 0.5f, 1}));
    EXPECT_EQ(texel(decode_container(*encode_image(".ktx2", two))->image), (Vec4{0, 0.25f, 0, 1}));
    two.encoding = Encoding::srgb;  // grey and alpha
    EXPECT_EQ(texel(decode_container(*encode_image(".ktx2", two))->image), (Vec4{0, 0, 0, 0.25f}));
}

TEST(GpuContainer, the_dds_header_has_the_fields_at_the_documented_offsets) {
    const FileBytes file = *encode_image(".dds", kTable);
    EXPECT_EQ(std::memcmp(file.data(), "DDS ", 4), 0);
    EXPECT_EQ(word(file, 4), 124u);
    EXPECT_EQ(word(file, 12), 3u);       // height
    EXPECT_EQ(word(file, 16), 6u);       // width
    EXPECT_EQ(word(file, 20), 6u * 8u);  // bytes a row
    EXPECT_EQ(word(file, 28), 1u);       // mips
    EXPECT_EQ(word(file, 76), 32u);
    EXPECT_EQ(std::memcmp(file.data() + 84, "DX10", 4), 0);
    EXPECT_EQ(word(file, 128), 10u);  // DXGI_FORMAT_R16G16B16A16_FLOAT
    EXPECT_EQ(word(file, 132), 3u);   // two dimensions
    EXPECT_EQ(word(file, 140), 1u);   // one layer
    EXPECT_EQ(file.size(), 148u + kTable.bytes.size());
}

TEST(GpuContainer, the_ktx2_header_index_and_descriptor_follow_the_specification) {
    const FileBytes file =
        *encode_image(".ktx2", kTable, {{"dermis.sidecar", "{}"}, {"Z", "last but dermis"}});
    EXPECT_EQ(word(file, 12), 97u);  // VK_FORMAT_R16G16B16A16_SFLOAT
    EXPECT_EQ(word(file, 16), 2u);   // bytes of a component
    EXPECT_EQ(word(file, 20), 6u);
    EXPECT_EQ(word(file, 24), 3u);
    EXPECT_EQ(word(file, 36), 1u);  // faces
    EXPECT_EQ(word(file, 40), 1u);  // levels
    const size_t descriptor = word(file, 48), pairs = word(file, 56), level = word(file, 80);
    EXPECT_EQ(descriptor, 104u);
    EXPECT_EQ(word(file, 52), 92u);
    EXPECT_EQ(word(file, descriptor), 92u);                 // its own size
    EXPECT_EQ(word(file, descriptor + 8), 2u | 88u << 16);  // version and block size
    EXPECT_EQ(word(file, descriptor + 12), 1u | 1u << 8 | 1u << 16);
    EXPECT_EQ(word(file, descriptor + 20), 8u);  // bytes a texel
    EXPECT_EQ(word(file, descriptor + 28), 15u << 16 | 0xc0u << 24);
    EXPECT_EQ(word(file, descriptor + 28 + 48), 48u | 15u << 16 | 0xcfu << 24);
    EXPECT_EQ(pairs, 196u);
    EXPECT_EQ(level % 8, 0u);
    EXPECT_EQ(level + kTable.bytes.size(), file.size());

    // Keys in the order of their code points.
    const std::string_view text(reinterpret_cast<const char*>(file.data()) + pairs, word(file, 60));
    EXPECT_LT(text.find("KTXorientation"), text.find("KTXwriter"));
    EXPECT_LT(text.find("KTXwriter"), text.find("dermis.sidecar"));
}

TEST(GpuContainer, ktx2_carries_text) {
    const ImageText text = {{"dermis.sidecar", "{\"v\": 1}"}, {"a", ""}, {"odd", "abc"}};
    EXPECT_EQ(decode_container(*encode_image(".ktx2", kTable, text))->text, text);
}

TEST(GpuContainer, other_uncompressed_formats_are_read) {
    // RGBA16F relabelled as RGBA16_UNORM: the same bytes, other numbers.
    FileBytes dds = *encode_image(".dds", kTable), ktx2 = *encode_image(".ktx2", kTable);
    set_word(dds, 128, 11);
    set_word(ktx2, 12, 91);
    EXPECT_EQ(decode_container(dds)->image.format, PixelFormat::u16);
    EXPECT_EQ(decode_container(ktx2)->image.format, PixelFormat::u16);
    EXPECT_EQ(decode_container(dds)->image.bytes, kTable.bytes);
    // Twice as many texels of half the size.
    set_word(dds, 128, 29);
    set_word(dds, 16, 12);
    EXPECT_EQ(decode_container(dds)->image.encoding, Encoding::srgb);
    EXPECT_EQ(decode_container(dds)->image.width, 12);
}

TEST(GpuContainer, what_is_not_a_flat_plain_image_is_refused) {
    const FileBytes dds = *encode_image(".dds", kTable), ktx2 = *encode_image(".ktx2", kTable);
    const auto refused = [](FileBytes file, size_t offset, uint32_t value) {
        set_word(file, offset, value);
        return !decode_container(file);
    };
    EXPECT_TRUE(refused(dds, 128, 98));         // BC7
    EXPECT_TRUE(refused(dds, 136, 4));          // cube map
    EXPECT_TRUE(refused(dds, 140, 6));          // array
    EXPECT_TRUE(refused(dds, 84, 0x31545844));  // DXT1
    EXPECT_TRUE(refused(dds, 16, 20000));
    EXPECT_TRUE(refused(dds, 16, 0));
    EXPECT_TRUE(refused(ktx2, 12, 145));         // BC7
    EXPECT_TRUE(refused(ktx2, 36, 6));           // cube map
    EXPECT_TRUE(refused(ktx2, 32, 2));           // array
    EXPECT_TRUE(refused(ktx2, 44, 2));           // Zstandard
    EXPECT_TRUE(refused(ktx2, 20, 5));           // narrower than its texels
    EXPECT_TRUE(refused(ktx2, 20, 7));           // wider than its texels
    EXPECT_TRUE(refused(ktx2, 84, 1));           // texels beyond 4 GiB
    EXPECT_TRUE(refused(ktx2, 60, 0xffffffff));  // key/value data beyond the end
}
