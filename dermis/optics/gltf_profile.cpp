#include "dermis/optics/gltf_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {
namespace {

// The profile as JSON, to the last bit: what a material keeps beside the volume, which is Burley's. "model"
// is gaussians, burley, dipole or table; lengths in mm, as the members of the models are named.

using Json = nlohmann::json;

Json model_json(const GaussianSum& sum) {
    Json json = {{"model", "gaussians"}, {"variance_mm2", Json::array()}, {"weight", Json::array()}};
    for (const GaussianTerm& term : sum.terms) {
        json["variance_mm2"].push_back(term.variance_mm2);
        json["weight"].push_back(term.weight);
    }
    return json;
}
Json model_json(const BurleyProfile& burley) {
    Json json = {{"model", "burley"}, {"albedo", burley.albedo}, {"d_mm", burley.d_mm}};
    if (burley.g != 0) json["g"] = burley.g;
    return json;
}
Json model_json(const DipoleProfile& dipole) {
    const ScatteringMedium& medium = dipole.medium;
    return {{"model", "dipole"},
            {"sigma_s_per_mm", medium.sigma_s_per_mm},
            {"sigma_a_per_mm", medium.sigma_a_per_mm},
            {"g", medium.g},
            {"eta", medium.eta}};
}
Json model_json(const TabulatedProfile& table) {
    return {{"model", "table"}, {"r_mm", table.r_mm()}, {"reflectance_per_mm2", table.reflectance_per_mm2()}};
}

// Members as they are asked for; the first that is missing or of another type is remembered.
class Members {
  public:
    explicit Members(const Json& json) : json_(json) {}

    template <class T>
    T value(const char* key) {
        try {
            return json_.at(key).get<T>();
        } catch (const Json::exception&) {  // the library's only way to say so
            if (!error_) error_ = Error{std::string(key) + " is missing or of another type"};
            return T{};
        }
    }
    template <class T>
    T value_or(const char* key, T missing) {
        return json_.contains(key) ? value<T>(key) : missing;
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  private:
    const Json& json_;
    std::optional<Error> error_;
};

Result<GaussianSum> gaussians_of(Members& members) {
    const auto variances = members.value<std::vector<double>>("variance_mm2");
    const auto weights = members.value<std::vector<Rgb>>("weight");
    if (!members.error() && variances.size() != weights.size())
        return Error{"variance_mm2 and weight differ in number"};
    GaussianSum sum;
    for (size_t i = 0; i < std::min(variances.size(), weights.size()); ++i)
        sum.terms.push_back({variances[i], weights[i]});
    return sum;
}

Result<TabulatedProfile> table_of(Members& members) {
    const auto radii = members.value<std::vector<double>>("r_mm");
    const auto values = members.value<std::vector<Rgb>>("reflectance_per_mm2");
    if (members.error()) return *members.error();
    if (radii.size() != values.size()) return Error{"r_mm and reflectance_per_mm2 differ in number"};
    return TabulatedProfile::make(radii, values, "table");
}

Result<Profile> profile_of(Members& members, const std::string& model) {
    Profile profile;
    if (model == "gaussians") {
        DERMIS_TRY_ASSIGN(const GaussianSum sum, gaussians_of(members));
        profile.model = sum;
    } else if (model == "burley") {
        profile.model = BurleyProfile{members.value<Rgb>("albedo"), members.value<Rgb>("d_mm"),
                                      members.value_or("g", 0.0)};
    } else if (model == "dipole") {
        profile.model = DipoleProfile{{.sigma_s_per_mm = members.value<Rgb>("sigma_s_per_mm"),
                                       .sigma_a_per_mm = members.value<Rgb>("sigma_a_per_mm"),
                                       .g = members.value<double>("g"),
                                       .eta = members.value<double>("eta")}};
    } else if (model == "table") {
        DERMIS_TRY_ASSIGN(const TabulatedProfile table, table_of(members));
        profile.model = table;
    } else {
        return Error{unknown_name("model", printable_line(model, 40),
                                  std::vector<std::string>{"gaussians", "burley", "dipole", "table"})};
    }
    return profile;
}

std::string exact_profile_json(const Profile& profile) {
    Json json = std::visit([](const auto& model) { return model_json(model); }, profile.model);
    json["name"] = profile.name;
    json["source"] = profile.source;
    // The JSON library throws for names that are not UTF-8, such as those of files.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Profile> parse_exact_profile(std::string_view text) {
    const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
    if (json.is_discarded()) return Error{"no JSON"};
    Members members(json);
    const auto model = members.value<std::string>("model");
    const auto name = members.value<std::string>("name"), source = members.value<std::string>("source");
    if (members.error()) return *members.error();
    Result<Profile> profile = profile_of(members, model);
    if (!profile) return profile;
    if (members.error()) return *members.error();
    profile->name = printable_line(name, 60);
    profile->source = printable_line(source);
    if (auto* sum = std::get_if<GaussianSum>(&profile->model)) sum->name = profile->name;
    DERMIS_TRY(check(*profile));
    return profile;
}

using Json = nlohmann::json;

// The JSON of a GLB (glTF 2.0, section 4.4), or the whole of a file that is none.
Result<std::string_view> json_of(std::span<const std::byte> file) {
    constexpr uint32_t kJsonChunk = 0x4E4F534A;
    constexpr size_t kHeader = 20;
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    if (!text.starts_with("glTF")) return text;
    if (file.size() < kHeader) return Error{"truncated: a GLB has at least 20 bytes"};
    uint32_t size = 0, type = 0;
    std::memcpy(&size, file.data() + 12, sizeof size);
    std::memcpy(&type, file.data() + 16, sizeof type);
    if (type != kJsonChunk) return Error{"the first chunk of a GLB must be its JSON"};
    if (size > file.size() - kHeader) return Error{"truncated: its JSON passes the end of the file"};
    return text.substr(kHeader, size);
}

// Parses only the materials of the document, because the rest may be large.
Json materials_of(std::string_view text) {
    constexpr int kDeepest = 16;
    const auto keep = [](int depth, Json::parse_event_t event, const Json& parsed) {
        if (depth > kDeepest) return false;
        return depth != 1 || event != Json::parse_event_t::key || parsed == "materials";
    };
    Json document = Json::parse(text.begin(), text.end(), keep, false);
    if (!document.is_object() || !document.contains("materials")) return Json::array();
    return std::move(document["materials"]);
}

const Json* member(const Json* object, const char* key) {
    if (!object || !object->is_object()) return nullptr;
    const auto found = object->find(key);
    return found == object->end() ? nullptr : &*found;
}

class MaterialReader {
  public:
    MaterialReader(const Json& material, std::string place) : place_(std::move(place)) {
        const Json* extensions = member(&material, "extensions");
        volume_ = member(extensions, "KHR_materials_volume");
        old_scatter_ = member(extensions, "KHR_materials_volume_scatter");
        scatter_ = member(extensions, "KHR_materials_scatter");
        exact_ = member(member(&material, "extras"), kGltfExactProfile);
        if (const Json* name = member(&material, "name"); name && name->is_string())
            name_ = printable_line(name->get<std::string>(), 60);
    }

    [[nodiscard]] bool scatters() const { return old_scatter_ || scatter_; }

    Result<Profile> read() {
        // As the loader of meshes: the newer extension wins where a file has both.
        const Json* scatter = scatter_ ? scatter_ : old_scatter_;
        const char* extension = scatter_ ? "KHR_materials_scatter" : "KHR_materials_volume_scatter";
        if (!volume_) return fail("has " + std::string(extension) + " without KHR_materials_volume");
        notes_.push_back("material '" + name_ + "', " + extension +
                         " with KHR_materials_volume: 1/sigma_t is the mean free path in m, "
                         "multiscatterColorFactor linear Rec. 709");
        DERMIS_TRY(read_color(scatter));
        DERMIS_TRY(read_lengths());
        Result<BurleyProfile> burley = to_canonical(settings_);
        if (!burley) return fail(burley.error().message);
        DERMIS_TRY(apply_anisotropy(scatter, *burley));
        if (scatter_) {
            DERMIS_TRY_ASSIGN(const auto strength, numbers(scatter_, "scatterStrengthFactor", 1, {0}));
            if (!(strength[0] > 0)) return fail("has scatterStrengthFactor 0: it does not scatter");
            if (strength[0] < 1) notes_.emplace_back("scatterStrengthFactor is read as 1");
        }
        for (const char* texture : {"multiscatterColorTexture", "scatterColorTexture"})
            if (member(scatter, texture)) notes_.push_back(std::string(texture) + " is not read");
        Profile profile{name_.empty() ? "gltf_material" : name_, "", *burley};
        if (exact_) profile = exact_or(profile);
        profile.source = printable_line(place_ + ": " + join(notes_, "; "));
        return profile;
    }

  private:
    // The exact profile is that of the volume unless another program has changed one of them.
    Profile exact_or(const Profile& of_volume) {
        constexpr double kRounding = 1e-4;  // the volume's numbers are written as floats
        const std::string place = "extras." + std::string(kGltfExactProfile);
        const Result<Profile> exact = parse_exact_profile(exact_->dump());
        if (!exact) {
            notes_.push_back(place + " is not read: " + exact.error().message);
            return of_volume;
        }
        const bool is_blur = burley_equivalent(*exact).albedo == Rgb{1, 1, 1};
        for (int c = 0; c < 3; ++c) {
            const double radius = mean_radius_mm(*exact, c), albedo = diffuse_albedo(*exact, c);
            if (std::abs(mean_radius_mm(of_volume, c) - radius) <= kRounding * radius &&
                (is_blur || std::abs(diffuse_albedo(of_volume, c) - albedo) <= kRounding))
                continue;
            notes_.push_back(place + " is not read: the volume was changed since");
            return of_volume;
        }
        notes_ = {"material '" + name_ + "', " + place + ", the exact profile: " + model_name(*exact)};
        if (!exact->source.empty()) notes_.push_back("from " + exact->source);
        return *exact;
    }

    Error fail(const std::string& what) const { return Error{place_ + ": material '" + name_ + "' " + what}; }

    // `count` finite numbers, or the fallback where the key is missing; an empty fallback makes that an
    // error.
    Result<std::vector<double>> numbers(const Json* object, const char* key, size_t count,
                                        std::vector<double> fallback) const {
        const Json* found = member(object, key);
        if (!found && !fallback.empty()) return fallback;
        if (!found) return fail("has no " + std::string(key));
        std::vector<double> values;
        if (found->is_number()) values.push_back(found->get<double>());
        if (found->is_array())
            for (const Json& value : *found)
                if (value.is_number()) values.push_back(value.get<double>());
        if (values.size() != count || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
            return fail(std::string(key) + " must be " + std::to_string(count) + " finite number(s)");
        return values;
    }

    Result<void> set(const char* key, const std::vector<double>& values) {
        if (const auto set = set_value(settings_, key, values); !set) return fail(set.error().message);
        return {};
    }

    Result<void> read_color(const Json* scatter) {
        // The key of the first draft; files keep it.
        const bool old_key =
            !member(scatter, "multiscatterColorFactor") && member(scatter, "multiscatterColor");
        const auto color =
            numbers(scatter, old_key ? "multiscatterColor" : "multiscatterColorFactor", 3,
                    scatter == scatter_ ? std::vector<double>{1, 1, 1} : std::vector<double>());
        return color ? set("multiscatterColorFactor", *color) : color.error();
    }

    Result<void> read_lengths() {
        DERMIS_TRY_ASSIGN(const auto distance, numbers(volume_, "attenuationDistance", 1, {}));
        DERMIS_TRY_ASSIGN(const auto color, numbers(volume_, "attenuationColor", 3, {}));
        if (const auto done = set("attenuationDistance", distance); !done) return done;
        return set("attenuationColor", color);
    }

    // Burley's d is that of isotropic scattering with the same reduced mean free path, which is the mean free
    // path over 1 - alpha g.
    Result<void> apply_anisotropy(const Json* scatter, BurleyProfile& burley) {
        DERMIS_TRY_ASSIGN(const auto read, numbers(scatter, "scatterAnisotropy", 1, {0}));
        const double g = read[0];
        if (!(std::abs(g) <= 0.99)) return fail("scatterAnisotropy must be -0.99 to 0.99");
        if (g == 0) return {};
        notes_.push_back("scatterAnisotropy " + to_text(g) +
                         ": the profile is that of isotropic scattering of the same reduced mean free path; "
                         "walks keep g");
        burley = with_anisotropy(burley, g);
        return {};
    }

    std::string place_, name_;
    const Json *volume_, *old_scatter_, *scatter_, *exact_;
    ToolSettings settings_ = default_settings(ToolId::gltf_volume_scatter);
    std::vector<std::string> notes_;
};

}  // namespace

Result<Profile> parse_gltf_profile(std::span<const std::byte> file, std::string_view place) {
    const Result<std::string_view> text = json_of(file);
    if (!text) return Error{std::string(place) + ": " + text.error().message};
    const Json materials = materials_of(*text);
    if (materials.is_array())
        for (const Json& material : materials) {
            MaterialReader reader(material, std::string(place));
            if (reader.scatters()) return reader.read();
        }
    return Error{std::string(place) +
                 ": no material that scatters (KHR_materials_volume_scatter or KHR_materials_scatter)"};
}

Result<Profile> read_gltf_profile(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
    return parse_gltf_profile(file, path.string());
}

GltfVolume gltf_volume(const Profile& profile, const Rgb& surface_albedo) {
    BurleyProfile burley = burley_equivalent(profile);
    if (burley.albedo == Rgb{1, 1, 1}) burley.albedo = surface_albedo;
    const std::vector<Rgb> values = to_tool(ToolId::gltf_volume_scatter, burley).values;
    return {values[0], values[1], values[2][0]};
}

std::string gltf_extras(const Profile& profile) {
    return "{\"" + std::string(kGltfExactProfile) + "\":" + exact_profile_json(profile) + "}";
}

std::string gltf_note(const Profile& profile) {
    std::string note = profile.name + " as KHR_materials_volume_scatter, linear Rec. 709: ";
    note += std::holds_alternative<BurleyProfile>(profile.model)
                ? "albedo and length are kept"
                : "its mean radius is kept, its shape (" + model_name(profile) + ") is lost";
    if (burley_equivalent(profile).albedo == Rgb{1, 1, 1})
        note += "; its albedo of 1 becomes that of the map";
    return note + ". Dermis reads it exactly, from the material's extras." + kGltfExactProfile;
}

}  // namespace dermis::inline optics
