// Wavefront MTL with the usual PBR additions (Pr, Pm, Ke, norm and their maps). Blinn-Phong exponents become
// GGX roughness.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/obj.h"
#include "dermis/mesh/text_cursor.h"

namespace dermis::inline mesh {
namespace {

constexpr size_t kMaxMaterials = 65536;

std::optional<float> finite(std::optional<float> value) {
    return value && std::isfinite(*value) ? value : std::nullopt;
}

// Refuses NaN; accepts infinity, which is clamped.
std::optional<float> number_of(TextCursor& cursor) {
    const std::optional<float> value = cursor.number();
    return value && !std::isnan(*value) ? value : std::nullopt;
}

std::optional<Vec3> read_color(TextCursor& cursor) {
    const auto r = number_of(cursor);
    if (!r) return std::nullopt;  // "spectral" and "xyz" forms
    const auto g = number_of(cursor), b = number_of(cursor);
    return Vec3{*r, g.value_or(*r), b.value_or(*r)};
}

// Words before the file name: options, how many values each may take, and the values that change nothing
// (others are warned of; none: it never matters here).
struct MapOption {
    std::string_view name;
    int values;
    std::string_view neutral;
};
constexpr std::array<MapOption, 14> kMapOptions = {{{"-blendu", 1, ""},
                                                    {"-blendv", 1, ""},
                                                    {"-boost", 1, "0"},
                                                    {"-mm", 2, "0 1"},
                                                    {"-o", 3, "0 0 0"},
                                                    {"-s", 3, "1 1 1"},
                                                    {"-t", 3, "0 0 0"},
                                                    {"-texres", 1, ""},
                                                    {"-clamp", 1, ""},
                                                    {"-bm", 1, ""},
                                                    {"-imfchan", 1, ""},
                                                    {"-type", 1, ""},
                                                    {"-cc", 1, "off"},
                                                    {"-colorspace", 1, ""}}};

struct MapLine {
    std::string file, color_space, channel;
    bool clamps = false;
    std::optional<float> bump_scale;
    std::vector<std::string_view> ignored;  // options with a value that would change the map
};

// Whether the values are the neutral ones, or fewer of them.
bool is_neutral(std::string_view neutral, std::span<const std::string_view> values) {
    const std::vector<std::string_view> words = split(neutral, ' ');
    for (size_t i = 0; i < values.size() && i < words.size(); ++i)
        if (parse_number(values[i]) ? parse_number(values[i]) != parse_number(words[i])
                                    : values[i] != words[i])
            return false;
    return true;
}

MapLine read_map(TextCursor cursor) {
    MapLine map;
    for (;;) {
        TextCursor ahead = cursor;
        const std::string_view word = ahead.word();
        const auto option = std::ranges::find(kMapOptions, word, &MapOption::name);
        if (option == kMapOptions.end()) break;
        cursor = ahead;
        std::vector<std::string_view> values;
        for (int i = 0; i < option->values; ++i) {
            TextCursor value_ahead = cursor;
            const std::string_view value = value_ahead.word();
            const auto number = parse_number(value);
            const bool takes_words = option->values == 1;
            if (!number && !takes_words) break;  // -o, -s and -t may leave v and w out
            if (option->name == "-bm")
                map.bump_scale = finite(number ? std::optional(float(*number)) : std::nullopt);
            if (option->name == "-clamp") map.clamps = to_lower(value) == "on";
            if (option->name == "-colorspace") map.color_space = to_lower(value);
            if (option->name == "-imfchan") map.channel = to_lower(value);
            values.push_back(value);
            cursor = value_ahead;
        }
        if (!option->neutral.empty() && !is_neutral(option->neutral, values))
            map.ignored.push_back(option->name);
    }
    cursor.skip_blanks();
    map.file = trim(cursor.rest());
    std::ranges::replace(map.file, '\\', '/');  // written on Windows
    return map;
}

// The exponent whose Blinn-Phong lobe is as wide as GGX of alpha = roughness^2: alpha^2 = 2 / (n + 2)
// (Walter et al. 2007, "Microfacet Models for Refraction", section 5.2).
float roughness_of_exponent(float exponent) {
    return std::pow(2 / (std::max(exponent, 0.0f) + 2), 0.25f);
}

class MtlParser {
  public:
    MtlParser(const std::string& name, const std::filesystem::path& directory,
              std::vector<std::string>& warnings)
        : name_(name), directory_(directory), warnings_(warnings) {}

    std::vector<Material> run(std::string_view text) {
        LineReader lines(text);
        while (!lines.done()) {
            TextCursor cursor(lines.next());
            const std::string keyword = to_lower(cursor.word());
            if (keyword == "newmtl") {
                if (materials_.size() >= kMaxMaterials) break;
                materials_.emplace_back().name = trim(cursor.rest());
            } else if (!materials_.empty() && !read_value(keyword, cursor)) {
                read_map_line(keyword, cursor);
            }
        }
        return std::move(materials_);
    }

  private:
    bool read_value(std::string_view keyword, TextCursor& cursor) {
        Material& material = materials_.back();
        if (keyword == "tf") return warn_of_filter(cursor), true;
        if (keyword == "kd" || keyword == "ke") {
            const float most = keyword == "kd" ? 1 : kMostEmission;
            Vec3& color = keyword == "kd" ? material.base_color_linear : material.emission_linear;
            if (const auto read = read_color(cursor))
                color = {clamped(keyword, read->x, most), clamped(keyword, read->y, most),
                         clamped(keyword, read->z, most)},
                material.base_color_stated |= keyword == "kd";
            else
                warn_once(std::string(keyword) + " is not a number; not used");
            return true;
        }
        static constexpr std::array kNumbers = {"ns", "ni", "d", "tr", "pr", "pm"};
        if (std::ranges::find(kNumbers, keyword) == kNumbers.end()) return false;
        const auto value = number_of(cursor);
        if (!value)
            warn_once(std::string(keyword) + " is not a number; not used");
        else if (keyword == "ns" || keyword == "ni")
            set_reflection(keyword, *value);
        else if (const float share = clamped(keyword, *value, 1); keyword == "d" || keyword == "tr")
            set_opacity(keyword == "d" ? share : 1 - share);
        else
            (keyword == "pr" ? material.roughness : material.metallic) = share;
        return true;
    }

    float clamped(std::string_view keyword, float value, float most) {
        if (!(value >= 0 && value <= most))
            warn_once(std::string(keyword) + " is outside of its range, 0 to " + to_text(most) + "; clamped");
        return std::clamp(value, 0.0f, most);
    }

    void set_reflection(std::string_view keyword, float value) {
        Material& material = materials_.back();
        if (keyword == "ns") {
            if (value < 0) warn_once("ns is below 0; read as 0");
            material.roughness = roughness_of_exponent(value);
        } else if (value >= 1 && std::isfinite(value)) {
            material.ior = value;
        } else {
            warn_once(value < 1 ? "ni is below 1; not used" : "ni is infinite; not used");
        }
    }

    // The colour of what passes through a surface; nothing here reads it.
    void warn_of_filter(TextCursor& cursor) {
        if (read_color(cursor) != Vec3{1, 1, 1}) warn_once("tf is not used");
    }

    void set_opacity(float opacity) {
        Material& material = materials_.back();
        if (material.alpha_map.present()) return;
        material.opacity = opacity;
        material.alpha_mode = material.opacity < 1 ? AlphaMode::blend : AlphaMode::opaque;
    }

    // The member that takes a keyword's map; null for unused maps.
    ImageSource* target_of(std::string_view keyword, const MapLine& map) {
        Material& material = materials_.back();
        if (keyword == "map_kd") return &material.base_color_map;
        if (keyword == "map_ks") return &material.specular_map;
        if (keyword == "map_ke") return &material.emission_map;
        if (keyword == "map_pr") return &material.roughness_map;
        if (keyword == "map_pm") return &material.metallic_map;
        if (keyword == "norm" || keyword == "map_kn") return &material.normal_map;
        if (keyword == "disp" || keyword == "map_disp") return &material.displacement_map;
        if (keyword == "map_d") return &material.alpha_map;
        if (keyword != "map_bump" && keyword != "bump") return nullptr;
        // "bump" means heights in the specification, but often holds tangent-space normals: the name decides.
        const std::string lower = to_lower(map.file);
        const bool is_normal =
            lower.find("norm") != std::string::npos || lower.find("nrm") != std::string::npos;
        return is_normal ? &material.normal_map : &material.displacement_map;
    }

    // Maps multiply the constant beside them, but exporters write a map beside the 0 (or nothing at all) that
    // their program shows while a map is linked.
    void set_constant_beside(std::string_view keyword) {
        Material& material = materials_.back();
        if (keyword == "map_ke" && material.emission_linear == Vec3{}) material.emission_linear = {1, 1, 1};
        if (keyword == "map_pr") material.roughness = 1;
        if (keyword == "map_pm") material.metallic = 1;
        if (keyword == "map_d") {
            material.alpha_mode = AlphaMode::mask;
            material.opacity = 1;
        }
    }

    // Matte for opacity, else red; luminance is red in a picture of grey, and what all maps of numbers are.
    static bool is_channel_read(std::string_view keyword, std::string_view channel) {
        return channel.empty() || (keyword == "map_d" ? channel == "m" : channel == "r" || channel == "l");
    }

    void read_map_line(std::string_view keyword, const TextCursor& cursor) {
        const bool is_map = keyword.starts_with("map_") || keyword == "norm" || keyword == "disp" ||
                            keyword == "bump" || keyword == "decal" || keyword == "refl";
        if (!is_map) return;
        const MapLine map = read_map(cursor);
        if (map.file.empty()) return;
        ImageSource* target = target_of(keyword, map);
        // The renderer has no ambient colour; every other map left out may be missed.
        if (!target) return keyword == "map_ka" ? void() : warn_once(std::string(keyword) + " is not used");
        if (!stays_inside(map.file))
            return warn_once("map '" + map.file + "' lies outside the mesh's directory; not used");
        for (const std::string_view option : map.ignored)
            warn_once("the option " + std::string(option) + " of " + std::string(keyword) + " is ignored");
        if (!is_channel_read(keyword, map.channel))
            warn_once("the option -imfchan of " + std::string(keyword) + " is ignored");
        const bool is_color =
            target == &materials_.back().base_color_map || target == &materials_.back().emission_map;
        const bool linear =
            map.color_space == "linear" || map.color_space == "raw" || map.color_space == "non-color";
        if (!map.color_space.empty() && map.color_space != "auto" && is_color == linear)
            warn_once("-colorspace " + map.color_space + " of " + std::string(keyword) +
                      " is ignored: colours are read as sRGB, all else as data");
        if (target == &materials_.back().normal_map && map.bump_scale)
            materials_.back().normal_scale = *map.bump_scale;
        set_constant_beside(keyword);
        target->name = (directory_ / utf8_path(map.file)).generic_string();
        target->named_by = name_;
        target->wrap_u = target->wrap_v = map.clamps ? TextureWrap::clamp : TextureWrap::repeat;
    }

    void warn_once(const std::string& text) {
        if (warned_.insert(text).second) warnings_.push_back(name_ + ": " + text);
    }

    std::string name_;
    std::filesystem::path directory_;
    std::vector<std::string>& warnings_;
    std::set<std::string> warned_;
    std::vector<Material> materials_;
};

}  // namespace

std::vector<Material> parse_mtl(std::string_view text, const std::string& name,
                                const std::filesystem::path& directory, std::vector<std::string>& warnings) {
    return MtlParser(name, directory, warnings).run(text);
}

}  // namespace dermis::inline mesh
