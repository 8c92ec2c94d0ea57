#include "dermis/optics/exact_profile.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "dermis/base/text.h"
#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {
namespace {

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
    return {{"model", "burley"}, {"albedo", burley.albedo}, {"d_mm", burley.d_mm}};
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
        profile.model = BurleyProfile{members.value<Rgb>("albedo"), members.value<Rgb>("d_mm")};
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

}  // namespace

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

}  // namespace dermis::inline optics
