#include "dermis/optics/mtlx.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <sstream>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/check_value.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/primaries.h"

namespace dermis::inline optics {
namespace {

constexpr const char* kSurface = "open_pbr_surface";
constexpr const char *kWeight = "subsurface_weight", *kColor = "subsurface_color", *kBaseColor = "base_color",
                     *kRadius = "subsurface_radius", *kScale = "subsurface_radius_scale",
                     *kAnisotropy = "subsurface_scatter_anisotropy";

struct Unit {
    std::string_view name;
    double cm;
};
constexpr Unit kUnits[] = {{"micron", 1e-4}, {"millimeter", 0.1}, {"centimeter", 1}, {"meter", 100},
                           {"inch", 2.54},   {"foot", 30.48},     {"yard", 91.44}};

double linear_of_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
Rgb rec709_itself(const Rgb& c) {
    return c;
}
Rgb rec709_from_srgb(const Rgb& c) {
    return {linear_of_srgb(c[0]), linear_of_srgb(c[1]), linear_of_srgb(c[2])};
}

// MaterialX's names, those of its version 1.39 and of OpenColorIO's studio configuration.
struct ColorSpace {
    std::string_view name;
    Rgb (*to_rec709)(const Rgb&);
};
constexpr ColorSpace kColorSpaces[] = {
    {"lin_rec709", rec709_itself},          {"lin_rec709_scene", rec709_itself},
    {"acescg", rec709_from_acescg},         {"lin_ap1", rec709_from_acescg},
    {"lin_ap1_scene", rec709_from_acescg},  {"srgb_texture", rec709_from_srgb},
    {"srgb_rec709_scene", rec709_from_srgb}};

template <class Row>
Result<const Row*> row_named(std::span<const Row> rows, std::string_view what, std::string_view name) {
    std::vector<std::string> names;
    for (const Row& row : rows) {
        if (row.name == name) return &row;
        names.emplace_back(row.name);
    }
    return Error{unknown_name(what, printable_line(name, 40), names)};
}

// The attribute of the node, or of the closest of its parents that has it; "" without.
std::string_view inherited(pugi::xml_node node, const char* attribute) {
    for (; node; node = node.parent())
        if (const pugi::xml_attribute found = node.attribute(attribute)) return found.value();
    return {};
}

class SurfaceReader {
  public:
    SurfaceReader(std::string_view text, std::string_view place) : text_(text), place_(place) {}

    Result<Profile> read() {
        DERMIS_TRY(open());
        DERMIS_TRY(read_weight());
        DERMIS_TRY(read_color());
        DERMIS_TRY(read_lengths());
        DERMIS_TRY_ASSIGN(const double g, anisotropy());
        DERMIS_TRY(surface());
        note_what_is_left();
        const Result<BurleyProfile> burley = to_canonical(settings_);
        if (!burley) return Error{at_surface() + burley.error().message};
        return Profile{utf8_path(place_).stem().string(), printable_line(place_ + ": " + join(notes_, "; ")),
                       g == 0 ? *burley : with_anisotropy(*burley, g)};
    }

    Result<MtlxSurface> read_surface() {
        DERMIS_TRY(open());
        return surface();
    }

  private:
    Result<void> open() {
        const pugi::xml_parse_result parsed =
            document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!parsed)
            return Error{at(parsed.offset) + "no complete XML: " + printable_line(parsed.description())};
        return find_surface();
    }
    std::string at(ptrdiff_t offset) const {
        const auto end = text_.begin() + std::clamp<ptrdiff_t>(offset, 0, ptrdiff_t(text_.size()));
        return place_ + ":" + std::to_string(1 + std::count(text_.begin(), end, '\n')) + ": ";
    }
    std::string at_surface() const { return at(surface_.offset_debug()); }

    Result<void> find_surface() {
        const auto is_surface = [](const pugi::xml_node& node) {
            return std::string_view(node.name()) == kSurface;
        };
        surface_ = document_.find_node(is_surface);
        if (!surface_)
            return Error{place_ + ": no " + kSurface + "; only OpenPBR surfaces are read from MaterialX"};
        const auto is_another = [&](const pugi::xml_node& node) {
            return node != surface_ && is_surface(node);
        };
        if (const pugi::xml_node other = document_.find_node(is_another))
            return Error{at(other.offset_debug()) + "a second " + kSurface + "; keep one in the file"};
        return {};
    }

    pugi::xml_node input(std::string_view name) const {
        return surface_.find_child([&](const pugi::xml_node& node) {
            return std::string_view(node.name()) == "input" && node.attribute("name").value() == name;
        });
    }

    static bool is_connected(const pugi::xml_node& input) {
        static constexpr std::array kLinks = {"nodename", "nodegraph", "interfacename", "output"};
        return std::ranges::any_of(kLinks, [&](const char* link) { return bool(input.attribute(link)); });
    }

    // Nothing where the surface does not have the input, or has it without a value.
    Result<std::optional<std::vector<double>>> numbers(const char* name) const {
        const pugi::xml_node found = input(name);
        if (!found) return std::optional<std::vector<double>>();
        if (is_connected(found))
            return Error{at(found.offset_debug()) + name +
                         " is connected to a node; a profile has one value: write it as value=\"...\""};
        const std::string_view text = found.attribute("value").value();
        std::vector<double> read;
        for (const std::string_view part : split(text, ',')) {
            const std::optional<double> number = parse_number(trim(part));
            if (!number)
                return Error{at(found.offset_debug()) + name + ": '" + printable_line(part, 40) +
                             "' is not a number"};
            read.push_back(*number);
        }
        return std::optional(read);
    }

    Result<double> scalar(const char* name, double fallback, double low, double high) const {
        DERMIS_TRY_ASSIGN(const auto read, numbers(name));
        if (!read) return fallback;
        if (read->size() != 1)
            return Error{at_surface() + name + " has " + std::to_string(read->size()) +
                         " numbers; it takes one"};
        const double value = (*read)[0];
        if (!(value >= low && value <= high))
            return out_of_range(at_surface() + name, value, to_text(low) + " to " + to_text(high));
        return value;
    }

    // Nothing where a map has the place of the number.
    Result<std::optional<double>> number_or_map(const char* name, double low, double high) const {
        const pugi::xml_node found = input(name);
        if (!found || is_connected(found)) return std::optional<double>();
        DERMIS_TRY_ASSIGN(const double number, scalar(name, low, low, high));
        return std::optional(number);
    }

    Result<MtlxSurface> surface() const {
        DERMIS_TRY_ASSIGN(const auto roughness, number_or_map("specular_roughness", 0, 1));
        DERMIS_TRY_ASSIGN(const auto ior, number_or_map("specular_ior", 1, 3));
        return MtlxSurface{roughness, ior};
    }

    Result<void> set(const char* key, const std::vector<double>& values) {
        if (const auto set = set_value(settings_, key, values); !set)
            return Error{at_surface() + set.error().message};
        return {};
    }

    Result<void> read_weight() {
        const Result<double> weight = scalar(kWeight, 0, 0, 1);  // OpenPBR's default: no subsurface
        if (!weight) return weight.error();
        if (*weight == 0)
            return Error{at_surface() + kWeight + " is 0: the surface has no subsurface; 1 is all of it"};
        if (*weight < 1) notes_.push_back(std::string(kWeight) + " " + to_text(*weight) + " is read as 1");
        return {};
    }

    Result<void> read_color() {
        DERMIS_TRY_ASSIGN(const auto read, numbers(kColor));
        Rgb color = settings_.values[0];  // OpenPBR's default
        if (!read) {
            notes_.push_back(std::string(kColor) + " is not in the file: " + to_text(color[0]));
            return {};
        }
        if (read->size() != 3) return set(kColor, *read);
        std::ranges::copy(*read, color.begin());
        if (const std::string_view name = inherited(input(kColor), "colorspace"); name.empty()) {
            notes_.push_back(std::string(kColor) + " names no colour space: taken as linear Rec. 709");
        } else {
            const auto space = row_named(std::span<const ColorSpace>(kColorSpaces), "colour space", name);
            if (!space) return Error{at_surface() + kColor + ": " + space.error().message};
            color = (*space)->to_rec709(color);
            const bool is_rec709 = (*space)->to_rec709 == rec709_itself;
            notes_.push_back(kColor + (is_rec709
                                           ? std::string(" is linear Rec. 709")
                                           : " converted from " + std::string(name) + " to linear Rec. 709"));
        }
        return set(kColor, {color.begin(), color.end()});
    }

    Result<void> read_lengths() {
        DERMIS_TRY_ASSIGN(const auto radius, scalar(kRadius, settings_.values[1][0], 1e-9, 1e9));
        double cm = 1;
        if (const std::string_view name = inherited(input(kRadius), "unit"); !name.empty()) {
            const auto unit = row_named(std::span<const Unit>(kUnits), "unit of length", name);
            if (!unit) return Error{at_surface() + kRadius + ": " + unit.error().message};
            cm = (*unit)->cm;
        } else {
            notes_.push_back(std::string(kRadius) + " has no unit: taken as cm");
        }
        notes_.push_back(std::string(kRadius) + " is the mean free path, as OpenPBR 1.1 defines it");
        DERMIS_TRY_ASSIGN(const auto scale, numbers(kScale));
        if (scale)
            if (const auto done = set(kScale, *scale); !done) return done;
        return set(kRadius, {radius * cm});
    }

    // Burley's d is that of isotropic scattering with the same reduced mean free path 1 / sigma_t', which is
    // the mean free path over 1 - alpha g.
    Result<double> anisotropy() {
        DERMIS_TRY_ASSIGN(const double g, scalar(kAnisotropy, 0, -0.99, 0.99));
        if (g != 0)
            notes_.push_back(std::string(kAnisotropy) + " " + to_text(g) +
                             ": the profile is that of isotropic scattering of the same reduced mean free "
                             "path; walks keep g");
        return g;
    }

    void note_what_is_left() {
        // The base's colour is not seen where all of the surface is subsurface.
        constexpr std::string_view kRead[] = {kWeight, kColor, kBaseColor, kRadius, kScale, kAnisotropy};
        constexpr size_t kMostNames = 8;
        std::vector<std::string> left;
        for (const pugi::xml_node node : surface_.children("input")) {
            const std::string_view name = node.attribute("name").value();
            if (std::ranges::find(kRead, name) == std::end(kRead)) left.push_back(printable_line(name, 40));
        }
        if (left.empty()) return;
        const size_t count = left.size();
        left.resize(std::min(count, kMostNames));
        notes_.push_back("not in a profile: " + join(left, ", ") + (count > kMostNames ? ", ..." : ""));
    }

    std::string_view text_;
    std::string place_;
    pugi::xml_document document_;
    pugi::xml_node surface_;
    ToolSettings settings_ = default_settings(ToolId::openpbr);
    std::vector<std::string> notes_;
};

// MaterialX's names are letters, digits and underscores, and do not begin with a digit.
std::string element_name(std::string_view name) {
    std::string out = "skin_" + std::string(name);
    for (char& c : out) {
        const bool is_allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!is_allowed) c = '_';
    }
    return out;
}

pugi::xml_node add_input(pugi::xml_node surface, const char* name, const char* type,
                         const std::string& value) {
    pugi::xml_node input = surface.append_child("input");
    input.append_attribute("name") = name;
    input.append_attribute("type") = type;
    input.append_attribute("value") = value.c_str();
    return input;
}

std::string color_text(const Rgb& color) {
    return to_text(color[0]) + ", " + to_text(color[1]) + ", " + to_text(color[2]);
}

}  // namespace

Result<Profile> parse_mtlx(std::string_view text, std::string_view place) {
    return SurfaceReader(text, place).read();
}

Result<Profile> read_mtlx(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
    return parse_mtlx(text, path.string());
}

Result<MtlxSurface> read_mtlx_surface(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
    return SurfaceReader(text, path.string()).read_surface();
}

std::string mtlx_text(const Profile& profile) {
    const BurleyProfile burley = burley_equivalent(profile);
    const std::vector<Rgb> values = to_tool(ToolId::openpbr, without_anisotropy(burley)).values;
    const std::string name = element_name(profile.name);
    pugi::xml_document document;
    pugi::xml_node root = document.append_child("materialx");
    root.append_attribute("version") = "1.39";
    root.append_attribute("colorspace") = "lin_rec709";
    pugi::xml_node surface = root.append_child(kSurface);
    surface.append_attribute("name") = name.c_str();
    surface.append_attribute("type") = "surfaceshader";
    add_input(surface, kWeight, "float", "1");
    add_input(surface, kColor, "color3", color_text(values[0])).append_attribute("colorspace") = "lin_rec709";
    // For readers without subsurface, which draw the base: three.js is one.
    add_input(surface, kBaseColor, "color3", color_text(values[0])).append_attribute("colorspace") =
        "lin_rec709";
    pugi::xml_node radius = add_input(surface, kRadius, "float", to_text(values[1][0]));
    radius.append_attribute("unittype") = "distance";
    radius.append_attribute("unit") = "centimeter";
    add_input(surface, kScale, "color3", color_text(values[2]));
    add_input(surface, kAnisotropy, "float", to_text(burley.g));
    add_input(surface, "specular_ior", "float", to_text(ScatteringMedium{}.eta));
    pugi::xml_node material = root.append_child("surfacematerial");
    material.append_attribute("name") = (name + "_material").c_str();
    material.append_attribute("type") = "material";
    pugi::xml_node shader = material.append_child("input");
    shader.append_attribute("name") = "surfaceshader";
    shader.append_attribute("type") = "surfaceshader";
    shader.append_attribute("nodename") = name.c_str();
    std::ostringstream out;
    document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
}

std::vector<std::string> mtlx_notes(const Profile& profile, const Profile& written) {
    std::vector<std::string> notes;
    if (!std::holds_alternative<BurleyProfile>(profile.model))
        notes.push_back("the shape of " + profile.name + " (" + model_name(profile) +
                        ") is lost: the file holds the albedo and the mean radius");
    notes.push_back(
        "subsurface_radius times subsurface_radius_scale is the mean free path in cm, not the diffuse mean "
        "free path and not Burley's d");
    notes.push_back("subsurface_color is linear Rec. 709 (lin_rec709)");
    if (burley_equivalent(written).albedo == Rgb{1, 1, 1})
        notes.push_back("the albedo is 1: a blur without absorption; --albedo gives it that of the surface");
    notes.push_back("roughness and maps are not part of a profile: OpenPBR's defaults hold");
    return notes;
}

}  // namespace dermis::inline optics
