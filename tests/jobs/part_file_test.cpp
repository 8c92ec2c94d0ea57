// Part files from outside: cut off, changed, or no parts. None of it crashes, and none of it is taken for a
// part.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "dermis/base/file.h"
#include "jobs/parts.h"

using namespace dermis;
using namespace dermis::test;
using testing::HasSubstr;

namespace {

std::vector<std::byte> bytes_of(const std::filesystem::path& file) {
    return *read_file(file);
}

bool is_part(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    const Result<Part> part = read_part(file);
    if (!part) {
        EXPECT_THAT(part.error().message, HasSubstr(file.filename().string()));
        EXPECT_EQ(part.error().message.find('\n'), std::string::npos);
    }
    return bool(part);
}

// A file of the same layers with another header or other layers.
template <class Change>
std::string refused(PartFiles& files, Change change) {
    Result<LayeredImage> file = read_layered_exr(files.write({0, 8}));
    EXPECT_TRUE(file);
    change(*file);
    const Result<Part> part = part_of(std::move(*file), "p.exr");
    return part ? "" : part.error().message;
}

std::string with_header(PartFiles& files, const std::string& from, const std::string& to) {
    return refused(files, [&](LayeredImage& file) {
        std::string& header = file.text["dermis_part"];
        const size_t at = header.find(from);
        EXPECT_NE(at, std::string::npos) << header;
        header.replace(at, from.size(), to);
    });
}

}  // namespace

TEST(PartFiles, a_part_comes_back_as_it_was) {
    PartFiles files;
    const Result<Part> part = read_part(files.write({8, 20}));
    ASSERT_TRUE(part) << part.error().message;
    const PartFacts &facts = part->facts, wanted = part_facts({8, 20});
    EXPECT_EQ(facts.range, wanted.range);
    EXPECT_EQ(facts.samples, wanted.samples);
    EXPECT_EQ(facts.width, 11);
    EXPECT_EQ(facts.height, 9);
    EXPECT_EQ(facts.picture.description, wanted.picture.description);
    EXPECT_EQ(facts.picture.credit, wanted.picture.credit);
    EXPECT_EQ(facts.picture.exposure_ev, wanted.picture.exposure_ev);
    EXPECT_EQ(facts.picture.tone_map, wanted.picture.tone_map);
    EXPECT_EQ(facts.picture.scene_warnings, wanted.picture.scene_warnings);
    EXPECT_EQ(facts.command, wanted.command);
    const Result<PictureSums> sums = sum_samples(lit_sphere(), part_settings(), {8, 20});
    PictureSums back{.width = 11, .height = 9, .pixels = std::vector<PixelState>(99)};
    part->add_to(back);
    for (size_t i = 0; i < back.pixels.size(); ++i) {
        EXPECT_EQ(back.pixels[i].sums, sums->pixels[i].sums) << i;
        EXPECT_EQ(back.pixels[i].count, 12u);
    }
}

TEST(PartFiles, names_that_are_no_utf_8_are_no_obstacle) {
    PartFiles files;
    PartFacts facts = part_facts({0, 8});
    facts.command = "dermis reference \xff.toml";
    const Result<Part> part = read_part(files.write({0, 8}, facts));
    ASSERT_TRUE(part) << part.error().message;
    EXPECT_THAT(part->facts.command, HasSubstr("\xef\xbf\xbd.toml"));
}

TEST(PartFiles, no_prefix_of_a_part_is_a_part) {
    PartFiles files;
    const std::vector<std::byte> whole = bytes_of(files.write({0, 8}));
    ASSERT_TRUE(is_part(files.path("cut.exr"), whole));
    for (size_t size = 0; size < whole.size(); size += std::max<size_t>(1, whole.size() / 97))
        EXPECT_FALSE(is_part(files.path("cut.exr"), {whole.begin(), whole.begin() + std::ptrdiff_t(size)}))
            << size;
    EXPECT_FALSE(is_part(files.path("cut.exr"), {whole.begin(), whole.end() - 1}));
}

TEST(PartFiles, changed_bytes_are_found_or_change_nothing) {
    PartFiles files;
    const std::filesystem::path file = files.write({0, 8});
    const std::vector<std::byte> whole = bytes_of(file);
    const Result<Part> part = read_part(file);
    std::mt19937 random(11);
    int found = 0;
    for (int run = 0; run < 300; ++run) {
        std::vector<std::byte> changed = whole;
        changed[random() % changed.size()] ^= std::byte(1 << random() % 8);
        if (!is_part(files.path("changed.exr"), changed)) {
            ++found;
            continue;
        }
        // A byte of the EXR container that no value depends on.
        const Result<Part> same = read_part(files.path("changed.exr"));
        EXPECT_EQ(same->facts.checksum, part->facts.checksum);
        EXPECT_EQ(same->facts.range, part->facts.range);
    }
    EXPECT_GT(found, 250);
}

TEST(PartFiles, a_header_that_was_edited_is_damage) {
    PartFiles files;
    EXPECT_EQ(with_header(files, "\"seed\":1", "\"seed\":1"), "");
    EXPECT_THAT(with_header(files, "\"seed\":1", "\"seed\":2"), HasSubstr("p.exr is damaged"));
    EXPECT_THAT(with_header(files, "\"walks\":0", "\"walks\":1"), HasSubstr("checksum"));
    EXPECT_THAT(with_header(files, "\"begin\":0", "\"begin\":3"), HasSubstr("range of samples"));
    EXPECT_THAT(with_header(files, "\"end\":8", "\"end\":1e300"), HasSubstr("no end"));
    EXPECT_THAT(with_header(files, "\"samples\":28", "\"samples\":65540"), HasSubstr("range of samples"));
    EXPECT_THAT(with_header(files, "\"samples\":28", "\"samples\":-4"), HasSubstr("no samples"));
    EXPECT_THAT(with_header(files, "\"version\":\"v1\"", "\"version\":7"), HasSubstr("no version"));
    EXPECT_THAT(with_header(files, "\"aces\"", "\"acez\""), HasSubstr("acez"));
    EXPECT_THAT(with_header(files, "\"format\":1", "\"format\":2"), HasSubstr("format 2"));
    EXPECT_THAT(with_header(files, "{\"format\"", "\"format\""), HasSubstr("header is not readable"));
    EXPECT_THAT(
        with_header(files, "\"seed\":1", "\"seed\":" + std::string(200'000, '[') + std::string(200'000, ']')),
        HasSubstr("damaged"));
}

TEST(PartFiles, other_layers_are_damage) {
    PartFiles files;
    EXPECT_THAT(
        refused(files,
                [](LayeredImage& f) { std::erase_if(f.layers, [](auto& l) { return l.name == "skin"; }); }),
        HasSubstr("no layer skin"));
    EXPECT_THAT(refused(files,
                        [](LayeredImage& f) {
                            f.layers.push_back({"more", Image(11, 9, 1)});
                        }),
                HasSubstr("layers that no part has"));
    const auto with_value = [&](float value) {
        return refused(files, [&](LayeredImage& f) {
            for (ImageLayer& layer : f.layers)
                if (layer.name == "radiance") layer.image.floats()[5] = value;
        });
    };
    EXPECT_THAT(with_value(NAN), HasSubstr("sums that no samples have"));
    EXPECT_THAT(with_value(INFINITY), HasSubstr("sums that no samples have"));
    EXPECT_THAT(with_value(1e30f), HasSubstr("sums that no samples have"));
    EXPECT_THAT(with_value(9 * kBrightest), HasSubstr("sums that no samples have"));
    EXPECT_THAT(with_value(1), HasSubstr("checksum"));
    EXPECT_THAT(refused(files, [](LayeredImage& f) { f.text.clear(); }),
                HasSubstr("is not a part of a picture"));
}
