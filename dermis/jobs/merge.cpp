#include "dermis/jobs/merge.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dermis::inline jobs {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string range_text(SampleRange range) {
    return std::to_string(range.begin) + ":" + std::to_string(range.end);
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
                 ": it states other settings"};
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
    text += " of 0:" + std::to_string(facts.samples) + " are in no part; run: " + facts.command +
            " --sample-range " + range_text(holes[0]) + " -o FILE.exr";
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
    if (parts.empty()) return Error{damaged[0] + "; no other part is readable"};
    const std::vector<SampleRange> holes = holes_of(parts, facts.samples);
    if (!damaged.empty() || !holes.empty()) return incomplete(damaged, holes, facts);
    return MergedPicture{picture_of(sums), std::move(facts)};
}

}  // namespace dermis::inline jobs
