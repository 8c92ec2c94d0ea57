#include "dermis/jobs/part.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"

namespace dermis::inline jobs {
namespace {

namespace fs = std::filesystem;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Sums = std::array<ExactSum, kSumCount>;

constexpr int kFormat = 1;
constexpr std::string_view kHeaderKey = "dermis_part";
// 128 bits are six floats of 24.
constexpr size_t kMostLayers = 6;

std::string layer_name(const SumLayout& layout, size_t index) {
    return std::string(layout.name) + (index == 0 ? "" : "." + std::to_string(index + 1));
}

// The largest sum that so many samples can have.
double most_of(const SumLayout& layout, int samples) {
    const bool squares = layout.first >= kBlockSquaresSum.first;
    return squares ? double(kBrightest) * double(kBrightest) * samples / kSampleBlock
                   : double(kBrightest) * samples;
}

// Layer by layer takes the nearest float of what is left of each sum.
std::vector<ImageLayer> layers_of(const PictureSums& sums, const SumLayout& layout) {
    std::vector<ExactSum> left;
    left.reserve(sums.pixels.size() * layout.channels);
    for (const PixelState& pixel : sums.pixels)
        for (size_t c = 0; c < layout.channels; ++c) left.push_back(pixel.sums[layout.first + c]);
    std::vector<ImageLayer> layers;
    do {
        ImageLayer& layer = layers.emplace_back(ImageLayer{
            layer_name(layout, layers.size()), Image(sums.width, sums.height, int(layout.channels))});
        for (size_t i = 0; i < left.size(); ++i) layer.image.floats()[i] = left[i].take_float();
    } while (std::ranges::any_of(left, [](const ExactSum& sum) { return !sum.is_zero(); }));
    return layers;
}

void add(Hasher& hasher, const Sums& sums) {
    hasher.add(std::as_bytes(std::span(sums)));
}

// File names may be no UTF-8, and JSON has to be.
std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// No part has deeper levels; those of a file made by others are left out, as dump() recurses.
Json parse_header(const std::string& text) {
    constexpr int kLevels = 3;
    return Json::parse(
        text, [](int level, Json::parse_event_t, Json&) { return level <= kLevels; }, false);
}

Json header_of(const PartFacts& facts) {
    return {{"format", kFormat},
            {"begin", facts.range.begin},
            {"end", facts.range.end},
            {"samples", facts.samples},
            {"version", facts.version},
            {"content", facts.content},
            {"command", facts.command},
            {"picture", Json::parse(facts.picture.description, nullptr, false)},
            {"credit", facts.picture.credit},
            {"scene_warnings", facts.picture.scene_warnings},
            {"tone_map", tone_map_names()[size_t(facts.picture.tone_map)]},
            {"exposure_ev", facts.picture.exposure_ev},
            {"walks", facts.walks},
            {"lost_walks", facts.lost_walks},
            {"cut_channels", facts.cut_channels}};
}

// Reads the header's values; `missing` is the first that is not there or of another type.
struct HeaderReader {
    const Json& json;
    std::string missing;

    const Json* find(const char* key, bool (Json::*is_type)() const noexcept) {
        const auto at = json.find(key);
        if (at != json.end() && ((*at).*is_type)()) return &*at;
        if (missing.empty()) missing = key;
        return nullptr;
    }
    std::string text(const char* key) {
        const Json* value = find(key, &Json::is_string);
        return value ? value->get<std::string>() : std::string();
    }
    double number(const char* key) {
        const Json* value = find(key, &Json::is_number);
        return value ? value->get<double>() : 0;
    }
    // 0 to 2^53.
    size_t count(const char* key) {
        const double value = number(key);
        if (value >= 0 && value <= 0x1p53 && value == std::floor(value)) return size_t(value);
        if (missing.empty()) missing = key;
        return 0;
    }
    int samples(const char* key) { return int(std::min(count(key), size_t(kMostSamples) + 1)); }
};

Result<PartFacts> facts_of(const Json& json) {
    HeaderReader in{json, {}};
    if (const size_t format = in.count("format"); in.missing.empty() && format != kFormat)
        return Error{fmt::format(
            "is a part of format {}, and this program reads format {}: make it again with this version",
            format, kFormat)};
    PartFacts facts{.version = in.text("version"),
                    .content = in.text("content"),
                    .command = in.text("command"),
                    .range = {in.samples("begin"), in.samples("end")},
                    .samples = in.samples("samples"),
                    .walks = in.count("walks"),
                    .lost_walks = in.count("lost_walks"),
                    .cut_channels = in.count("cut_channels"),
                    .checksum = in.text("checksum")};
    facts.picture.credit = in.text("credit");
    facts.picture.exposure_ev = float(in.number("exposure_ev"));
    if (const Json* picture = in.find("picture", &Json::is_object))
        facts.picture.description = text_of(*picture);
    if (const Json* warnings = in.find("scene_warnings", &Json::is_array))
        for (const Json& warning : *warnings) {
            if (!warning.is_string()) return Error{"is damaged: a warning in its header is not text"};
            facts.picture.scene_warnings.push_back(warning.get<std::string>());
        }
    const Result<ToneMap> tone_map = parse_tone_map(in.text("tone_map"));
    if (!in.missing.empty()) return Error{"is damaged: its header has no " + in.missing};
    if (!tone_map) return Error{"is damaged: " + tone_map.error().message};
    facts.picture.tone_map = *tone_map;
    if (Result<void> good = check_range({.samples = facts.samples}, facts.range);
        !good || facts.samples > kMostSamples)
        return Error{"is damaged: its range of samples is none"};
    return facts;
}

// The layers of one sum, the first at least; null after the last.
using SumLayers = std::array<const Image*, kMostLayers>;

Result<std::array<SumLayers, std::size(kSumLayouts)>> find_layers(const LayeredImage& file) {
    std::array<SumLayers, std::size(kSumLayouts)> found{};
    size_t used = 0;
    for (size_t s = 0; s < std::size(kSumLayouts); ++s)
        for (size_t k = 0; k < kMostLayers; ++k) {
            const SumLayout& layout = kSumLayouts[s];
            const auto layer = std::ranges::find(file.layers, layer_name(layout, k), &ImageLayer::name);
            if (layer == file.layers.end() && k == 0)
                return Error{"is damaged: it has no layer " + std::string(layout.name)};
            if (layer == file.layers.end()) break;
            if (layer->image.channels != int(layout.channels) || layer->image.format != PixelFormat::f32)
                return Error{"is damaged: its layer " + layer->name + " is of another kind"};
            found[s][k] = &layer->image;
            ++used;
        }
    if (used != file.layers.size()) return Error{"is damaged: it has layers that no part has"};
    return found;
}

// The sums of one pixel. False when a float is beyond what a sum takes.
bool sums_of(const std::array<SumLayers, std::size(kSumLayouts)>& layers, size_t pixel, Sums& sums) {
    for (size_t s = 0; s < std::size(kSumLayouts); ++s) {
        const SumLayout& layout = kSumLayouts[s];
        for (const Image* layer : layers[s]) {
            if (!layer) break;
            for (size_t c = 0; c < layout.channels; ++c) {
                const double value = layer->floats()[pixel * layout.channels + c];
                if (!(std::abs(value) <= ExactSum::kMost)) return false;
                sums[layout.first + c].add(value);
            }
        }
    }
    return true;
}

bool within_limits(const Sums& sums, int samples) {
    for (const SumLayout& layout : kSumLayouts)
        for (size_t c = 0; c < layout.channels; ++c)
            if (!(std::abs(sums[layout.first + c].value()) <= most_of(layout, samples))) return false;
    return true;
}

Result<void> check_sums(const LayeredImage& file, const PartFacts& facts) {
    DERMIS_TRY_ASSIGN(const auto layers, find_layers(file));
    const size_t pixels = size_t(facts.width) * size_t(facts.height);
    Hasher hasher;
    for (size_t i = 0; i < pixels; ++i) {
        Sums sums;
        if (!sums_of(layers, i, sums) || !within_limits(sums, facts.range.end - facts.range.begin))
            return Error{"is damaged: it has sums that no samples have"};
        add(hasher, sums);
    }
    hasher.add(text_of(header_of(facts)));
    if (hasher.hex() != facts.checksum) return Error{"is damaged: its content is not what its checksum says"};
    return {};
}

}  // namespace

Result<void> write_part(const std::filesystem::path& path, PartFacts facts, const PictureSums& sums) {
    facts.walks = sums.walks;
    facts.lost_walks = sums.lost_walks;
    facts.cut_channels = sums.cut_channels;
    Json header = header_of(facts);
    Hasher hasher;
    for (const PixelState& pixel : sums.pixels) add(hasher, pixel.sums);
    hasher.add(text_of(header));
    header["checksum"] = hasher.hex();
    std::vector<ImageLayer> layers;
    for (const SumLayout& layout : kSumLayouts)
        std::ranges::move(layers_of(sums, layout), std::back_inserter(layers));
    ImageText text = {{std::string(kHeaderKey), text_of(header)}};
    if (!facts.picture.credit.empty()) text["credit"] = facts.picture.credit;
    return write_layered_exr(path, layers, text);
}

void Part::add_to(PictureSums& sums) const {
    const auto found = find_layers(layers);
    PixelState pixel;
    pixel.count = uint32_t(facts.range.end - facts.range.begin);
    for (size_t i = 0; found && i < sums.pixels.size(); ++i) {
        pixel.sums = {};
        sums_of(*found, i, pixel.sums);
        sums.pixels[i].add(pixel);
    }
    sums.walks += facts.walks;
    sums.lost_walks += facts.lost_walks;
    sums.cut_channels += facts.cut_channels;
}

Result<Part> part_of(LayeredImage file, std::string_view name) {
    const auto wrong = [&](const Error& error) { return Error{std::string(name) + " " + error.message}; };
    const auto text = file.text.find(std::string(kHeaderKey));
    if (text == file.text.end() || file.layers.empty())
        return Error{std::string(name) +
                     " is not a part of a picture: dermis reference --sample-range BEGIN:END writes parts"};
    const Json json = parse_header(text->second);
    if (!json.is_object()) return Error{std::string(name) + " is damaged: its header is not readable"};
    Result<PartFacts> facts = facts_of(json);
    if (!facts) return wrong(facts.error());
    facts->width = file.layers[0].image.width;
    facts->height = file.layers[0].image.height;
    if (Result<void> good = check_sums(file, *facts); !good) return wrong(good.error());
    return Part{std::move(*facts), std::move(file)};
}

Result<Part> read_part(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(LayeredImage file, read_layered_exr(path));
    return part_of(std::move(file), path.string());
}

namespace {

std::string range_text(SampleRange range) {
    return fmt::format("{}:{}", range.begin, range.end);
}

struct ReadPart {
    fs::path file;
    SampleRange range;
};

// A name and a value for everything that parts of one picture have in common. The content comes last: where a
// setting differs, that says more.
std::vector<std::pair<std::string, std::string>> common_facts(const PartFacts& facts) {
    std::vector<std::pair<std::string, std::string>> all = {{"version of dermis", facts.version}};
    const Json description = Json::parse(facts.picture.description, nullptr, false);
    for (const auto& [key, value] : description.items()) all.emplace_back(key, value.dump());
    all.emplace_back("width in pixels", std::to_string(facts.width));
    all.emplace_back("height in pixels", std::to_string(facts.height));
    all.emplace_back("tone map", tone_map_names()[size_t(facts.picture.tone_map)]);
    all.emplace_back("exposure", Json(facts.picture.exposure_ev).dump());
    all.emplace_back("credit", facts.picture.credit);
    all.emplace_back("list of the scene's warnings", Json(facts.picture.scene_warnings).dump());
    all.emplace_back("content of the scene (meshes, maps, lights, profile)", facts.content);
    return all;
}

Result<void> check_same(const fs::path& first_file, const PartFacts& first, const fs::path& file,
                        const PartFacts& facts) {
    const auto wanted = common_facts(first), found = common_facts(facts);
    for (size_t i = 0; i < std::min(wanted.size(), found.size()); ++i)
        if (wanted[i] != found[i])
            return Error{file.string() + " is a part of another picture than " + first_file.string() +
                         ": its " + found[i].first + " is " + found[i].second + ", there it is " +
                         wanted[i].second + "; merge only parts that differ in --sample-range"};
    if (wanted.size() == found.size()) return {};
    return Error{file.string() + " is a part of another picture than " + first_file.string() +
                 ": its header has other settings"};
}

Result<void> check_overlap(const std::vector<ReadPart>& parts, const fs::path& file, SampleRange range) {
    for (const ReadPart& other : parts)
        if (range.begin < other.range.end && other.range.begin < range.end)
            return Error{file.string() + " (samples " + range_text(range) + ") and " + other.file.string() +
                         " (samples " + range_text(other.range) + ") have samples in common: leave one out"};
    return {};
}

std::vector<SampleRange> holes_of(std::vector<ReadPart> parts, int samples) {
    std::ranges::sort(parts, {}, [](const ReadPart& part) { return part.range.begin; });
    std::vector<SampleRange> holes;
    int covered = 0;
    for (const ReadPart& part : parts) {
        if (part.range.begin > covered) holes.push_back({covered, part.range.begin});
        covered = part.range.end;
    }
    if (covered < samples) holes.push_back({covered, samples});
    return holes;
}

// Everything that has to be done again, and how.
Error incomplete(const std::vector<std::string>& damaged, const std::vector<SampleRange>& holes,
                 const PartFacts& facts) {
    std::string text;
    for (const std::string& one : damaged) text += (text.empty() ? "" : "; ") + one;
    if (holes.empty())
        return Error{text + "; all samples are in the other parts: leave " +
                     (damaged.size() == 1 ? "it" : "them") + " out"};
    text += (text.empty() ? "samples " : "; samples ");
    for (const SampleRange& hole : holes) text += (&hole == holes.data() ? "" : ", ") + range_text(hole);
    text += fmt::format(" of 0:{} are in no part; run: {} --sample-range {} -o FILE.exr", facts.samples,
                        facts.command, range_text(holes[0]));
    if (holes.size() > 1) text += ", and so for each range";
    return Error{text};
}

}  // namespace

Result<MergedPicture> merge_parts(std::span<const fs::path> files,
                                  const std::function<void(double)>& progress) {
    PictureSums sums;
    PartFacts facts;
    std::vector<ReadPart> parts;
    std::vector<std::string> damaged;
    for (const fs::path& file : files) {
        const Result<Part> part = read_part(file);
        if (!part) {
            damaged.push_back(part.error().message);
            continue;
        }
        if (parts.empty()) {
            facts = part->facts;
            sums = {.width = facts.width,
                    .height = facts.height,
                    .pixels = std::vector<PixelState>(size_t(facts.width) * size_t(facts.height))};
        } else if (Result<void> same = check_same(parts[0].file, facts, file, part->facts); !same) {
            return same.error();
        }
        DERMIS_TRY(check_overlap(parts, file, part->facts.range));
        // A picture can get more samples later: the part that says so knows of all.
        if (part->facts.samples > facts.samples) {
            facts.samples = part->facts.samples;
            facts.command = part->facts.command;
        }
        part->add_to(sums);
        parts.push_back({file, part->facts.range});
        if (progress) progress(double(&file + 1 - files.data()) / double(files.size()));
    }
    if (parts.empty() && damaged.empty()) return Error{"no part is named"};
    if (parts.empty())
        return Error{damaged[0] + (damaged.size() > 1 ? "; none of the others is readable either" : "")};
    const std::vector<SampleRange> holes = holes_of(parts, facts.samples);
    if (!damaged.empty() || !holes.empty()) return incomplete(damaged, holes, facts);
    return MergedPicture{picture_of(sums), std::move(facts)};
}

}  // namespace dermis::inline jobs
