#include "dermis/engines/package.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/engines/engine.h"
#include "dermis/image/io.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/shading/skin_text.h"
#include "shaders/include/constants.h"

namespace dermis::inline engines {

std::vector<std::byte> to_bytes(std::string_view text) {
    const auto bytes = as_bytes(text);
    return {bytes.begin(), bytes.end()};
}

Result<std::string> filled(const PackageTemplate& file, const Words& words) {
    constexpr std::string_view kWord = "abcdefghijklmnopqrstuvwxyz_";
    std::string text;
    size_t at = 0;
    for (size_t start; (start = file.text.find('@', at)) != std::string::npos;) {
        text.append(file.text, at, start - at);
        const size_t end = file.text.find_first_not_of(kWord, start + 1);
        at = start + 1;
        if (end == std::string::npos || file.text[end] != '@' || end == at) {
            text += '@';
            continue;
        }
        const auto word = words.find(file.text.substr(at, end - at));
        if (word == words.end())
            return Error{file.path + ": unknown word '" + file.text.substr(at, end - at) + "'"};
        text += word->second;
        at = end + 1;
    }
    return text.append(file.text, at);
}

namespace {

Result<const Engine*> find_engine(std::string_view name) {
    const auto found = std::ranges::find(all_engines(), name, &Engine::name);
    if (found != all_engines().end()) return &*found;
    return Error{unknown_name("engine", name, engine_names())};
}

constexpr int kSide = 160, kColumns = 3, kRows = 2, kSamples = 3;
constexpr double kRadiiMm[kColumns] = {4, 8, 16};
constexpr double kToLight[3] = {0.88, 0.32, 0.35};  // normalised to 1 %, as the picture is
constexpr Rgb kAlbedo = {0.48, 0.19, 0.11}, kBackground = {0.02, 0.02, 0.02};

// One place of a sphere's square, -1 to 1 across it.
Rgb shaded(const Table& table, int column, int row, double x, double y) {
    const double z2 = 1 - (x * x + y * y) / (0.9 * 0.9);
    if (z2 < 0) return kBackground;
    const double n_dot_l = (x * kToLight[0] - y * kToLight[1]) / 0.9 + std::sqrt(z2) * kToLight[2];
    const double lambert = std::max(n_dot_l, 0.0);
    Rgb light = {lambert, lambert, lambert};
    if (row == 0) light = lookup(table, std::clamp(n_dot_l, -1.0, 1.0), 1 / kRadiiMm[column]);
    for (size_t c = 0; c < 3; ++c) light[c] *= kAlbedo[c];
    return light;
}

// The picture of a package's README, a PNG: spheres of 4, 8 and 16 mm lit from the right, above as the table
// has them, below Lambert's.
Result<std::vector<std::byte>> picture_of(const Table& table) {
    Image image(kColumns * kSide, kRows * kSide, 3, PixelFormat::f32, Encoding::linear);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            Rgb sum = {0, 0, 0};
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const double u = (x % kSide + (i % kSamples + 0.5) / kSamples) / kSide;
                const double v = (y % kSide + (i / kSamples + 0.5) / kSamples) / kSide;
                const Rgb value = shaded(table, x / kSide, y / kSide, 2 * u - 1, 2 * v - 1);
                for (size_t c = 0; c < 3; ++c) sum[c] += value[c] / (kSamples * kSamples);
            }
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float(sum[size_t(c)]));
        }
    return encode_image(".png", image);
}

// Baked from the Gaussians of the coefficients, so that table and functions agree.
Result<Table> diffuse_table(const Engine& engine, const Profile& profile) {
    DERMIS_TRY_ASSIGN(LutOptions options, lut_options("dermis"));
    options.profile = {.name = profile.name, .source = profile.source, .model = to_gaussian_sum(profile).sum};
    options.width = kTableWidth;
    options.height = kTableHeight;
    options.convention.axes[1] = curvature_axis(0, kTableMaxCurvaturePerMm);
    options.convention.v_origin = engine.v_origin;
    return bake_lut(options);
}

Result<void> add_table_and_picture(const Engine& engine, const Profile& profile,
                                   std::vector<PackageFile>& files) {
    DERMIS_TRY_ASSIGN(const Table table, diffuse_table(engine, profile));
    DERMIS_TRY_ASSIGN(std::vector<std::byte> picture, picture_of(table));
    files.push_back({std::string(engine.picture_path), std::move(picture)});
    if (engine.table_path.empty()) return {};
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, table_bytes(engine.table_path, table));
    files.push_back({std::string(engine.table_path), std::move(bytes)});
    return {};
}

// Seven numbers a place: two tangents, off the surface, red, green, blue, penumbra.
std::string shadow_places_text(std::span<const ShadowPlace> places) {
    std::string text;
    for (const ShadowPlace& place : places)
        text +=
            fmt::format("{}[{:.5g}, {:.5g}, {:.5g}, {:.5g}, {:.5g}, {:.5g}, {:.5g}]",
                        text.empty() ? "" : ",\n  ", place.offset_mm.x, place.offset_mm.y, place.offset_mm.z,
                        place.weight.x, place.weight.y, place.weight.z, place.penumbra);
    return text;
}

// The same as the initialisers of two arrays, in HLSL and in GLSL's dialects.
void add_shadow_place_words(std::span<const ShadowPlace> places, Words& words) {
    for (const auto& [type, ending] : {std::pair("float", ""), {"vec", "_glsl"}}) {
        std::string offsets, weights;
        for (const ShadowPlace& place : places) {
            const Vec3 &at = place.offset_mm, &weight = place.weight;
            const std::string_view separator = offsets.empty() ? "" : ",\n    ";
            offsets += fmt::format("{}{}4({:.5g}, {:.5g}, {:.5g}, {:.5g})", separator, type, at.x, at.y, at.z,
                                   place.penumbra);
            weights +=
                fmt::format("{}{}3({:.5g}, {:.5g}, {:.5g})", separator, type, weight.x, weight.y, weight.z);
        }
        words[std::string("shadow_place_offsets") + ending] = offsets;
        words[std::string("shadow_place_weights") + ending] = weights;
    }
    words["shadow_place_count"] = std::to_string(places.size());
}

// Shading languages do not take a whole number for a float.
std::string decimal(double whole) {
    return to_text(whole) + ".0";
}

// The components of a vector, whole or not.
std::string components(const Rgb& rgb) {
    return fmt::format("{:.6f}, {:.6f}, {:.6f}", rgb[0], rgb[1], rgb[2]);
}

Words gain_words(const PackageGain& gain) {
    return {{"gain_slope_mm", components(gain.of_curvature.slope_mm)},
            {"gain_length_mm", components(gain.of_curvature.length_mm)},
            {"gain_bend_mm", components(gain.of_curvature.bend_mm)},
            {"gain_of_slabs", components(gain.of_slabs)}};
}

Words common_words(const PackageInput& input) {
    const Profile& profile = input.profile;
    const std::string tool = tool_version();
    Words words = {{"profile", printable_line(profile.name)},
                   {"shadow_places", shadow_places_text(input.shadow_places.all)},
                   {"first_shadow_places", std::to_string(input.shadow_places.first)},
                   {"shadow_taps", std::to_string(kShadowTaps)},
                   {"outer_shadow_taps", std::to_string(kShadowOuterTaps)},
                   {"shadow_concavity", to_text(kShadowConcavity)},
                   {"shadow_facet_lift", to_text(kShadowFacetLift)},
                   {"shadow_max_slope", decimal(kShadowMaxSlope)},
                   {"golden_angle", to_text(kGoldenAngle)},
                   {"source", printable_line(profile.source)},
                   {"version", tool.substr(tool.find(' ') + 1)},
                   {"table_width", std::to_string(kTableWidth)},
                   {"table_height", std::to_string(kTableHeight)},
                   {"max_curvature_per_mm", decimal(kTableMaxCurvaturePerMm)}};
    words.merge(gain_words(input.gain));
    add_shadow_place_words(input.shadow_places.all, words);
    return words;
}

constexpr std::string_view kCommonFolder = "engines/common/", kGainFile = "engines/common/gain.glsl";

// engines/common/*.glsl: functions for the packages alone, which are printed with the skin's.
Result<std::vector<shading::Source>> printed_functions(const PackageInput& input) {
    std::vector<shading::Source> sources(input.functions.begin(), input.functions.end());
    const Words words = common_words(input);
    for (const PackageTemplate& file : input.templates) {
        if (!file.path.starts_with(kCommonFolder) || !file.path.ends_with(".glsl")) continue;
        DERMIS_TRY_ASSIGN(const std::string text, filled(file, words));
        sources.push_back({file.path, text});
    }
    return sources;
}

// Where a template of engines/common is in the package.
std::string common_path(const Engine& engine, std::string_view path) {
    path.remove_prefix(kCommonFolder.size());
    if (engine.takes_scripts && path.ends_with(".js")) return std::string(path);
    if (engine.hlsl_path.empty() || !path.ends_with(".hlsl")) return "";
    path.remove_suffix(std::string_view(".hlsl").size());
    return std::string(engine.hlsl_path).append(path).append(engine.hlsl_extension);
}

// Where a template is in the package; empty: it is not for this engine.
std::string template_path(const Engine& engine, const PackageInput& input, std::string_view path) {
    const std::string folder = "engines/" + std::string(engine.name) + "/";
    if (path == "LICENSE") return std::string(engine.license_path);
    const bool is_common = path.starts_with(kCommonFolder);
    if (!is_common && !path.starts_with(folder)) return "";
    const std::string to = is_common ? common_path(engine, path) : std::string(path.substr(folder.size()));
    return input.head.empty() && to.starts_with(engine.head_path) ? "" : to;
}

Result<void> add_templates(const Engine& engine, const PackageInput& input, std::vector<PackageFile>& files) {
    Words words = common_words(input);
    if (engine.add_words) engine.add_words(input, words);
    for (const PackageTemplate& file : input.templates) {
        const std::string path = template_path(engine, input, file.path);
        if (path.empty()) continue;
        DERMIS_TRY_ASSIGN(const std::string text, filled(file, words));
        files.push_back({path, to_bytes(text)});
    }
    return {};
}

// A text between backticks: what JavaScript reads as something else there gets a backslash.
std::string javascript_constant(std::string_view name, std::string_view text) {
    std::string constant = "export const " + std::string(name) + " = `\n";
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '`' || text[i] == '\\' || text.substr(i, 2) == "${") constant += '\\';
        constant += text[i];
    }
    return constant + "`;\n";
}

Result<void> add_skin_texts(const Engine& engine, const PackageInput& input,
                            std::vector<PackageFile>& files) {
    DERMIS_TRY_ASSIGN(const std::vector<shading::Source> functions, printed_functions(input));
    for (const Engine::SkinText& skin : engine.texts) {
        DERMIS_TRY_ASSIGN(const std::string text, skin_text(input.profile, functions, skin.language));
        const std::vector<std::byte> bytes =
            to_bytes(skin.constant.empty() ? text : javascript_constant(skin.constant, text));
        const auto same = std::ranges::find(files, skin.path, &PackageFile::path);
        if (same == files.end())
            files.push_back({std::string(skin.path), bytes});
        else
            same->bytes.insert(same->bytes.end(), bytes.begin(), bytes.end());
    }
    return {};
}

}  // namespace

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const Engine& engine : all_engines()) names.emplace_back(engine.name);
    return names;
}

Result<void> check_engine(std::string_view name) {
    DERMIS_TRY(find_engine(name));
    return {};
}

HeadFormat head_format(std::string_view engine) {
    const auto found = find_engine(engine);
    return found ? (*found)->head_format : HeadFormat{};
}

Result<shading::Source> gain_source(std::span<const PackageTemplate> templates, const PackageGain& gain) {
    const auto file = std::ranges::find(templates, kGainFile, &PackageTemplate::path);
    if (file == templates.end()) return Error{"no template " + std::string(kGainFile)};
    DERMIS_TRY_ASSIGN(std::string text, filled(*file, gain_words(gain)));
    return shading::Source{file->path, std::move(text)};
}

Result<std::vector<PackageFile>> make_package(std::string_view name, const PackageInput& input) {
    DERMIS_TRY_ASSIGN(const Engine* found, find_engine(name));
    const Engine& engine = *found;
    std::vector<PackageFile> files;
    DERMIS_TRY(add_skin_texts(engine, input, files));
    DERMIS_TRY(add_table_and_picture(engine, input.profile, files));
    DERMIS_TRY(add_templates(engine, input, files));
    for (const PackageFile& file : input.head)
        files.push_back({std::string(engine.head_path) + file.path, file.bytes});
    if (engine.add_files) DERMIS_TRY(engine.add_files(input, files));
    std::ranges::sort(files, {}, &PackageFile::path);
    return files;
}

}  // namespace dermis::inline engines
