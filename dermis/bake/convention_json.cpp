// The convention as JSON. Reading is strict: a missing key, an unknown value or one out of range is an error
// that names it, because a table must not be read with a guessed meaning.

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "dermis/bake/convention.h"
#include "dermis/base/text.h"
#include "dermis/image/image.h"

namespace dermis::inline bake {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kKinds[] = {"diffuse", "zonal_harmonics", "beckmann", "shadow"};
constexpr std::string_view kWarps[] = {"linear", "squared"};
constexpr std::string_view kSamplings[] = {"centre", "low_edge", "high_edge"};
constexpr std::string_view kOrigins[] = {"top", "bottom"};
constexpr std::string_view kEncodings[] = {"linear", "srgb", "range", "difference", "tenth_power"};
constexpr std::string_view kIntegrations[] = {"exact", "unity_taps", "faceworks_taps"};
constexpr std::string_view kConstructions[] = {"sphere", "full_ring", "half_ring"};
constexpr std::string_view kRingWeights[] = {"line", "area"};

template <class Enum>
Result<Enum> find_name(std::string_view what, std::span<const std::string_view> names,
                       std::string_view name) {
    for (size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return Enum(i);
    return Error{unknown_name(what, name, std::vector<std::string>(names.begin(), names.end()))};
}

struct Renamed {
    std::string_view before, now;
};

// Keeps the first error, so that the caller is a plain list of keys.
class Reader {
  public:
    Reader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {}

    std::string text(const char* key) {
        if (const Json* value = find(key)) {
            if (value->is_string()) return value->get<std::string>();
            fail(key, "must be text");
        }
        return {};
    }
    double number(const char* key, double min, double max) {
        if (const Json* value = find(key)) {
            const double number = value->is_number() ? value->get<double>() : NAN;
            if (number >= min && number <= max) return number;
            fail(key, "must be a number from " + to_text(min) + " to " + to_text(max));
        }
        return min;
    }
    template <class Enum>
    Enum name(const char* key, std::span<const std::string_view> names, Renamed renamed = {}) {
        const std::string found = text(key);
        if (error_) return Enum{};
        const Result<Enum> value =
            find_name<Enum>("value", names, found == renamed.before ? renamed.now : found);
        if (value) return *value;
        fail(key, value.error().message);
        return Enum{};
    }
    const Json* find(const char* key) {
        if (error_) return nullptr;
        if (object_.is_object() && object_.contains(key)) return &object_[key];
        fail(key, "is missing");
        return nullptr;
    }
    void fail(const char* key, const std::string& what) {
        if (!error_) error_ = Error{place_ + ": convention key '" + key + "' " + what};
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  private:
    const Json& object_;
    std::string place_;
    std::optional<Error> error_;
};

Json axis_json(const TableAxis& axis) {
    return {{"name", axis.name}, {"unit", axis.unit},          {"min", axis.min},
            {"max", axis.max},   {"warp", name_of(axis.warp)}, {"sampling", name_of(axis.sampling)}};
}

Result<TableAxis> parse_axis(const Json& json, const std::string& place) {
    Reader reader(json, place);
    constexpr double kMost = 1e6;
    TableAxis axis{.name = reader.text("name"),
                   .unit = reader.text("unit"),
                   .min = reader.number("min", -kMost, kMost),
                   .max = reader.number("max", -kMost, kMost),
                   .warp = reader.name<AxisWarp>("warp", kWarps),
                   .sampling = reader.name<TexelSampling>("sampling", kSamplings)};
    if (axis.min == axis.max) reader.fail("max", "must differ from 'min'");
    if (reader.error()) return *reader.error();
    return axis;
}

}  // namespace

std::string convention_json(const Convention& convention, int width, int height) {
    Json json = {
        {"kind", name_of(convention.kind)},
        {"width", width},
        {"height", height},
        {"axes", {axis_json(convention.axes[0]), axis_json(convention.axes[1])}},
        {"v_origin", name_of(convention.v_origin)},
        {"encoding", name_of(convention.encoding)},
    };
    if (convention.encoding == TableEncoding::range) {
        json["encoded_min"] = convention.encoded_min;
        json["encoded_max"] = convention.encoded_max;
    }
    if (convention.kind == TableKind::diffuse || convention.kind == TableKind::zonal_harmonics) {
        json["construction"] = name_of(convention.how.construction);
        json["ring_weights"] = name_of(convention.how.ring_weights);
        json["variance_scale"] = convention.how.variance_scale;
        json["integration"] = name_of(convention.integration);
    }
    if (convention.kind == TableKind::shadow) json["shadow_sharpening"] = convention.shadow_sharpening;
    json["profile"] = convention.profile;
    json["tool"] = convention.tool;
    return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

Result<ParsedConvention> parse_convention(std::string_view text, std::string_view place) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{std::string(place) + ": the convention is not a JSON object"};
    Reader reader(json, std::string(place));
    ParsedConvention parsed;
    Convention& convention = parsed.convention;
    convention.kind = reader.name<TableKind>("kind", kKinds);
    parsed.width = int(reader.number("width", 1, kMaxImageSide));
    parsed.height = int(reader.number("height", 1, kMaxImageSide));
    convention.v_origin = reader.name<VOrigin>("v_origin", kOrigins);
    convention.encoding = reader.name<TableEncoding>("encoding", kEncodings);
    if (convention.encoding == TableEncoding::range) {
        convention.encoded_min = reader.number("encoded_min", -1e6, 1e6);
        convention.encoded_max = reader.number("encoded_max", -1e6, 1e6);
        if (convention.encoded_min == convention.encoded_max)
            reader.fail("encoded_max", "must differ from 'encoded_min'");
    }
    if (convention.kind == TableKind::diffuse || convention.kind == TableKind::zonal_harmonics) {
        convention.how = {
            .construction = reader.name<Construction>("construction", kConstructions, {"ring", "full_ring"}),
            .ring_weights = reader.name<RingWeights>("ring_weights", kRingWeights),
            .variance_scale = reader.number("variance_scale", 1e-6, 1e6)};
        convention.integration = reader.name<Integration>("integration", kIntegrations);
    }
    if (convention.kind == TableKind::shadow)
        convention.shadow_sharpening = reader.number("shadow_sharpening", 1, 1000);
    convention.profile = reader.text("profile");
    convention.tool = reader.text("tool");
    const Json* axes = reader.find("axes");
    if (axes && !(axes->is_array() && axes->size() == 2)) reader.fail("axes", "must be a list of two");
    if (reader.error()) return *reader.error();
    for (size_t i = 0; i < 2; ++i) {
        DERMIS_TRY_ASSIGN(TableAxis axis,
                          parse_axis((*axes)[i], std::string(place) + ": axes[" + std::to_string(i) + "]"));
        convention.axes[i] = std::move(axis);
    }
    return parsed;
}

std::string_view name_of(TableKind kind) {
    return kKinds[size_t(kind)];
}
std::string_view name_of(AxisWarp warp) {
    return kWarps[size_t(warp)];
}
std::string_view name_of(TexelSampling sampling) {
    return kSamplings[size_t(sampling)];
}
std::string_view name_of(VOrigin origin) {
    return kOrigins[size_t(origin)];
}
std::string_view name_of(TableEncoding encoding) {
    return kEncodings[size_t(encoding)];
}
std::string_view name_of(Integration integration) {
    return kIntegrations[size_t(integration)];
}
std::string_view name_of(Construction construction) {
    return kConstructions[size_t(construction)];
}
std::string_view name_of(RingWeights weights) {
    return kRingWeights[size_t(weights)];
}

Result<Construction> find_construction(std::string_view name) {
    if (name == "ring")
        return Error{"construction 'ring' is either: full_ring or half_ring (-90 to 90 degrees)"};
    return find_name<Construction>("construction", kConstructions, name);
}
Result<AxisWarp> find_warp(std::string_view name) {
    return find_name<AxisWarp>("warp", kWarps, name);
}

}  // namespace dermis::inline bake
