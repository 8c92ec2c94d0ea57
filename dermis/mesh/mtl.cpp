// Wavefront MTL with the usual PBR additions (Pr, Pm, norm). Blinn-Phong exponents become GGX roughness.

#include <algorithm>
#include <array>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/mesh/obj.h"
#include "dermis/mesh/text_cursor.h"

namespace dermis {
namespace {

constexpr size_t kMaxMaterials = 65536;

std::optional<float> finite(std::optional<float> value) {
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<Vec3> read_color(TextCursor& cursor) {
    const auto r = finite(cursor.number());
    if (!r) return std::nullopt;  // "spectral" and "xyz" forms
    const auto g = finite(cursor.number()), b = finite(cursor.number());
    return Vec3{*r, g.value_or(*r), b.value_or(*r)};
}

// Words before the file name: options and how many values each may take.
struct MapOption {
    std::string_view name;
    int values;
};
constexpr std::array<MapOption, 13> kMapOptions = {{{"-blendu", 1},
                                                    {"-blendv", 1},
                                                    {"-boost", 1},
                                                    {"-mm", 2},
                                                    {"-o", 3},
                                                    {"-s", 3},
                                                    {"-t", 3},
                                                    {"-texres", 1},
                                                    {"-clamp", 1},
                                                    {"-bm", 1},
                                                    {"-imfchan", 1},
                                                    {"-type", 1},
                                                    {"-cc", 1}}};

struct MapLine {
    std::string file;
    float bump_scale = 1;
};

MapLine read_map(TextCursor cursor) {
    MapLine map;
    for (;;) {
        TextCursor ahead = cursor;
        const std::string_view word = ahead.word();
        const auto option = std::ranges::find(kMapOptions, word, &MapOption::name);
        if (option == kMapOptions.end()) break;
        cursor = ahead;
        for (int i = 0; i < option->values; ++i) {
            TextCursor value_ahead = cursor;
            const auto number = finite(value_ahead.number());
            const bool takes_words = option->values == 1;
            if (!number && !takes_words) break;  // -o, -s and -t may leave v and w out
            if (!number) value_ahead.word();
            if (number && option->name == "-bm") map.bump_scale = *number;
            cursor = value_ahead;
        }
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
        if (keyword == "kd" || keyword == "ke") {
            if (const auto color = read_color(cursor))
                (keyword == "kd" ? material.base_color_linear : material.emission_linear) = *color;
            return true;
        }
        static constexpr std::array kNumbers = {"ns", "ni", "d", "tr", "pr", "pm"};
        if (std::ranges::find(kNumbers, keyword) == kNumbers.end()) return false;
        const auto value = finite(cursor.number());
        if (!value) return true;
        if (keyword == "ns") material.roughness = roughness_of_exponent(*value);
        if (keyword == "ni" && *value >= 1) material.ior = *value;
        if (keyword == "d") set_opacity(*value);
        if (keyword == "tr") set_opacity(1 - *value);
        if (keyword == "pr") material.roughness = std::clamp(*value, 0.0f, 1.0f);
        if (keyword == "pm") material.metallic = std::clamp(*value, 0.0f, 1.0f);
        return true;
    }

    void set_opacity(float opacity) {
        Material& material = materials_.back();
        material.opacity = std::clamp(opacity, 0.0f, 1.0f);
        material.alpha_mode = material.opacity < 1 ? AlphaMode::blend : AlphaMode::opaque;
    }

    void read_map_line(std::string_view keyword, const TextCursor& cursor) {
        Material& material = materials_.back();
        ImageSource* target = nullptr;
        if (keyword == "map_kd") target = &material.base_color_map;
        if (keyword == "map_ks") target = &material.specular_map;
        if (keyword == "norm" || keyword == "map_kn") target = &material.normal_map;
        if (keyword == "disp") target = &material.displacement_map;
        if (keyword == "map_d") target = &material.opacity_map;
        // "bump" holds heights by the book and tangent-space normals in half of all files: the name decides.
        const bool bump = keyword == "map_bump" || keyword == "bump";
        const MapLine map = read_map(cursor);
        if (bump) {
            const std::string lower = to_lower(map.file);
            const bool is_normal =
                lower.find("norm") != std::string::npos || lower.find("nrm") != std::string::npos;
            target = is_normal ? &material.normal_map : &material.displacement_map;
            if (is_normal) material.normal_scale = map.bump_scale;
        }
        if (!target || map.file.empty()) return;
        if (!stays_inside(map.file))
            warnings_.push_back(name_ + ": map '" + map.file +
                                "' lies outside the mesh's directory; not used");
        else
            target->name = (directory_ / map.file).string();
    }

    std::string name_;
    std::filesystem::path directory_;
    std::vector<std::string>& warnings_;
    std::vector<Material> materials_;
};

}  // namespace

std::vector<Material> parse_mtl(std::string_view text, const std::string& name,
                                const std::filesystem::path& directory, std::vector<std::string>& warnings) {
    return MtlParser(name, directory, warnings).run(text);
}

}  // namespace dermis
