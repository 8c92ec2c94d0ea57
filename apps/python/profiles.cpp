// Diffusion profiles: presets, numbers of one's own, conversions, fits.

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/profile_file.h"
#include "module.h"
#include "profile_options.h"

namespace dermis::python {
namespace {

using Curve = double (*)(const Profile&, int, double);
using Property = double (*)(const Profile&, int);

// A function of a profile, and where its argument ends.
struct NamedCurve {
    std::string_view name;
    Curve at;
    double most = std::numeric_limits<double>::infinity();
};
constexpr NamedCurve kCurves[] = {{"reflectance_per_mm2", reflectance_per_mm2},
                                  {"cdf", cdf},
                                  {"inverse_cdf_mm", inverse_cdf_mm, 1},
                                  {"slab_transmittance", slab_transmittance}};
constexpr std::pair<std::string_view, Property> kProperties[] = {
    {"albedo", diffuse_albedo},
    {"mean_radius_mm", mean_radius_mm},
    {"mean_square_radius_mm2", mean_square_radius_mm2}};

py::array_t<double> channels_array(const Rgb& values) {
    return array_of(std::vector<double>(values.begin(), values.end()), {3});
}

// Packages have the name in comments of a line.
Profile checked(Profile profile) {
    if (std::ranges::any_of(profile.name, [](unsigned char c) { return c < ' '; }))
        throw Failure({"name: must be one line, without control characters"});
    check(dermis::check(profile));
    return profile;
}

Profile of_gaussians(const std::string& name, const py::object& variances_mm2, const py::object& weights) {
    const std::vector<double> variances = numbers_from(variances_mm2, "variances_mm2");
    const std::vector<Rgb> colours = triples_of(numbers_from(weights, "weights", 3));
    if (variances.size() != colours.size())
        throw Failure({"weights: " + std::to_string(colours.size()) + " rows for " +
                       std::to_string(variances.size()) + " variances"});
    GaussianSum sum{.name = name, .terms = {}};
    for (size_t i = 0; i < variances.size(); ++i) sum.terms.push_back({variances[i], colours[i]});
    return checked({name, name, std::move(sum)});
}

Profile of_burley(const std::string& name, const py::object& d_mm, const py::object& albedo) {
    return checked(
        {name, name,
         BurleyProfile{.albedo = triple_from(albedo, "albedo"), .d_mm = triple_from(d_mm, "d_mm")}});
}

Profile of_table(const std::string& name, const py::object& r_mm, const py::object& reflectance) {
    const std::vector<double> radii = numbers_from(r_mm, "r_mm");
    const std::vector<Rgb> values = triples_of(numbers_from(reflectance, "reflectance_per_mm2", 3));
    if (radii.size() != values.size())
        throw Failure({"reflectance_per_mm2: " + std::to_string(values.size()) + " rows for " +
                       std::to_string(radii.size()) + " radii"});
    return checked({name, name, value_of(TabulatedProfile::make(radii, values, name))});
}

// N x 3.
py::array_t<double> curve(const Profile& profile, const std::string& what, const std::string& argument,
                          const py::object& at) {
    const NamedCurve* found = std::ranges::find(kCurves, std::string_view(what), &NamedCurve::name);
    const std::vector<double> positions = numbers_from(at, argument);
    for (const double position : positions) {
        if (position < 0) throw Failure({argument + ": " + to_text(position) + " is below 0"});
        if (position > found->most)
            throw Failure({argument + ": " + to_text(position) + " is above " + to_text(found->most)});
    }
    std::vector<double> values(positions.size() * 3);
    unlocked([&] {
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = found->at(profile, int(i % 3), positions[i / 3]);
    });
    return array_of(std::move(values), {py::ssize_t(positions.size()), 3});
}

py::array_t<double> property(const Profile& profile, const std::string& what) {
    const auto found =
        std::ranges::find(kProperties, std::string_view(what), &std::pair<std::string_view, Property>::first);
    return channels_array(cli::of_channels(profile, found->second));
}

// variances_mm2, weights, largest and rms error, and the fit as a profile.
py::tuple fit_terms(const Profile& profile, int terms) {
    const GaussianFit fit = value_of(unlocked([&] { return cli::fit_gaussians(profile, terms); }));
    std::vector<double> variances, weights;
    for (const GaussianTerm& term : fit.sum.terms) {
        variances.push_back(term.variance_mm2);
        weights.insert(weights.end(), term.weight.begin(), term.weight.end());
    }
    const auto count = py::ssize_t(variances.size());
    return py::make_tuple(array_of(std::move(variances), {count}), array_of(std::move(weights), {count, 3}),
                          channels_array(fit.max_error), channels_array(fit.rms_error),
                          Profile{profile.name, profile.source, fit.sum});
}

std::string report(const Profile& profile, int terms) {
    return unlocked(
        [&] { return cli::profile_json(profile, value_of(cli::fit_gaussians(profile, terms))).dump(); });
}

std::string convert(const std::optional<Profile>& profile, const std::string& from, const std::string& to,
                    const std::string& albedo, const std::vector<std::string>& assignments) {
    const cli::ConversionChoice choice{
        .profile = profile, .name = {}, .from = from, .to = to, .albedo = albedo, .assignments = assignments};
    return cli::conversion_json(value_of(choice.convert())).dump();
}

Profile stretched(const Profile& profile, double factor) {
    if (!(factor > 0)) throw Failure({"factor: " + to_text(factor) + " must be above 0"});
    return checked(scaled(profile, finite("factor", factor)));
}

std::string csv(const Profile& profile, const py::object& radii_mm) {
    return profile_csv(profile, numbers_from(radii_mm, "r_mm"));
}

}  // namespace

void add_profiles(py::module_& module) {
    py::class_<Profile>(module, "Profile")
        .def_property_readonly("name", [](const Profile& profile) { return profile.name; })
        .def_property_readonly("source", [](const Profile& profile) { return profile.source; })
        .def_property_readonly("model", [](const Profile& profile) { return model_name(profile); });
    module.def("profile_names", profile_names);
    module.def("find_profile", [](const std::string& name) { return value_of(find_profile(name)); });
    module.def("keep_profile", keep_profile);
    module.def("profile_of_gaussians", of_gaussians);
    module.def("profile_of_burley", of_burley);
    module.def("profile_of_table", of_table);
    module.def("profile_curve", curve);
    module.def("profile_property", property);
    module.def("profile_burley_d_mm",
               [](const Profile& profile) { return channels_array(burley_equivalent(profile).d_mm); });
    module.def("fit_profile", fit_terms);
    module.def("profile_report", report);
    module.def("profile_csv", csv);
    module.def("stretch_profile", stretched);
    module.def("convert_profile", convert);
}

}  // namespace dermis::python
