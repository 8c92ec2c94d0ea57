#include "shading/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace dermis::shading {
namespace {

struct Domain {
    enum class Kind { even, logarithmic, direction };
    double min = 0, max = 1;
    Kind kind = Kind::even;
};

constexpr Domain kDirection = {.kind = Domain::Kind::direction};

Domain logarithmic(double min, double max) {
    return {min, max, Domain::Kind::logarithmic};
}

// By parameter, or by "function.parameter" where a function has a domain of its own.
const std::map<std::string, Domain>& domains() {
    static const std::map<std::string, Domain> kDomains = {
        {"n_dot_l", {-1, 1}},
        {"skin_ggx.n_dot_l", {0, 1}},
        {"skin_two_lobe_ggx.n_dot_l", {0, 1}},
        {"n_dot_h", {0, 1}},
        {"n_dot_v", {0.001, 1}},
        {"h_dot_v", {0, 1}},
        {"cos_theta", {0, 1}},
        {"occlusion", {0, 1}},
        {"f0", {0, 1}},
        {"alpha", {0.0009, 1}},
        {"skin_blinn_phong.alpha", {0.03, 1}},
        {"roughness", {0.03, 1}},
        {"distribution", {0, 1000}},
        {"curvature_per_mm", {0, 1}},
        {"max_curvature_per_mm", {0.1, 2}},
        {"size", {2, 1024}},
        {"x", {-0.5, 1.5}},
        {"root", {0, 1.5}},
        {"w", {0, 1}},
        {"second_moment_mm2", {0, 20}},
        {"bend_mm2", {0, 20}},
        {"slope_mm", {0, 6}},
        {"length_mm", {0, 9}},
        {"bend_mm", {-2, 0.9}},
        {"gain_of_place", {0, 2}},
        {"gain_of_slabs", {1, 4}},
        {"here", {0, 1}},
        {"behind", {0, 1}},
        {"share_behind", {0, 0.5}},
        {"diagonal_per_mm", {-1, 1}},
        {"mixed_per_mm", {-1, 1}},
        {"per_mm", {-1, 1}},
        {"t", kDirection},
        {"b", kDirection},
        {"d", kDirection},
        {"n", kDirection},
        {"to_light", kDirection},
        {"n_sharp", kDirection},
        {"n_smooth", {0.2, 1}},
        {"fwidth_n", {0, 1}},
        {"fwidth_p_mm", {0.01, 2}},
        {"p_dx", {-1, 1}},
        {"p_dy", {-1, 1}},
        {"texel_dx", {-4, 4}},
        {"texel_dy", {-4, 4}},
        {"of_sharp_read", {0.2, 1}},
        {"of_smooth_read", {0.1, 1}},
        {"variance", {0, 1}},
        {"mean_n_dot_l", {-1, 1}},
        {"of_sharp_normal", {0, 1}},
        {"of_smooth_normal", {0, 1}},
        {"smooth_weight", {0, 1}},
        {"knee", {0.1, 1}},
        {"skin_line_and_hyperbola.a", {0, 1}},
        {"skin_line_and_hyperbola.s", {0, 1}},
        {"q", {0, 2}},
        {"k0", {-1, 1}},
        {"k1", {-1, 1}},
        {"p0", {-1, 1}},
        {"p1", {-1, 1}},
        {"p2", {-1, 1}},
        {"p3", {-1, 1}},
        {"p4", {-1, 1}},
        {"p5", {-1, 1}},
        {"visibility", {0, 1}},
        {"slope", {-1, 1}},
        {"cubic", {-1, 1}},
        {"quintic", {-1, 1}},
        {"skin_edge_of_hyperbolas.root", {-1, 1}},
        {"narrow", {-1, 1}},
        {"narrow2", {0.01, 1}},
        {"wide", {-1, 1}},
        {"wide2", {0.01, 9}},
        {"distance_mm", {0, 10}},
        {"thickness_mm", {0, 20}},
        {"exponent_per_mm2", {-100, -0.01}},
        {"kappa", logarithmic(1e-3, 1e8)},
        {"variance_mm2", logarithmic(1e-3, 100)},
        {"red_texel", {0.7, 1}},
        {"green_texel", {0.4, 0.6}},
        {"spread_texel", {0, 1}},
        {"n_red", kDirection},
        {"n_own", kDirection},
        {"n_baked", kDirection},
        {"across", kDirection},
        {"skin_gather_bends.x", kDirection},
        {"skin_gather_bends.y", kDirection},
        {"shorter", {0, 0.4}},
        {"own_weight", {0, 1}},
        {"mean_length", {0.5, 1}},
        {"uneven", {-1, 1}},
        {"map_texel_mm", {0, 2}},
        {"place_mm", {-5, 5}},
        {"lift_mm", {0, 2}},
        {"bends_per_mm", {-1, 1}},
        {"cosine", {-1, 1}},
        {"sine", {0, 1}},
        {"lit", {0, 64}},
        {"all", {0.1, 64}},
        {"penumbra", {0, 64}},
        {"gathered", {0, 1}},
        {"trusted", {0, 1}},
        {"red_sums", {0.1, 64}},
        {"count", {64, 64}},
    };
    return kDomains;
}

// Differences of near numbers and steep powers lose digits; everything else agrees to 1e-5.
double bound_of(const std::string& function) {
    static const std::map<std::string, double> kBounds = {
        {"skin_blinn_phong", 5e-4},       {"skin_lobe_band_2", 1e-4},    {"skin_baked_level", 1e-3},
        {"skin_curvature_of_mean", 1e-4}, {"skin_spread_towards", 1e-3}, {"skin_vertex_tangent", 1e-3},
    };
    const auto found = kBounds.find(function);
    return found == kBounds.end() ? 1e-5 : found->second;
}

void add_sample(const Domain& domain, Type type, std::mt19937& random, std::vector<float>& inputs) {
    const int count = component_count(type);
    const size_t start = inputs.size();
    // A tenth of the samples are at the ends of the domain.
    const bool at_end = random() % 10 == 0;
    for (int i = 0; i < count; ++i) {
        const double even = double(random()) / double(std::mt19937::max());
        const double u = at_end ? std::round(even) : even;
        if (domain.kind == Domain::Kind::direction)
            inputs.push_back(float(std::normal_distribution<double>()(random)));
        else if (domain.kind == Domain::Kind::logarithmic)
            inputs.push_back(float(domain.min * std::pow(domain.max / domain.min, u)));
        else
            inputs.push_back(float(domain.min + (domain.max - domain.min) * u));
    }
    if (domain.kind != Domain::Kind::direction) return;
    double square = 0;
    for (size_t i = start; i < inputs.size(); ++i) square += double(inputs[i]) * double(inputs[i]);
    for (size_t i = start; i < inputs.size(); ++i) inputs[i] = float(double(inputs[i]) / std::sqrt(square));
}

Result<Sampled> sample(const Item& item) {
    Sampled sampled{.name = item.name,
                    .result = item.type,
                    .arguments = {},
                    .inputs = {},
                    .relative_bound = bound_of(item.name)};
    std::vector<Domain> own;
    for (const Parameter& parameter : item.parameters) {
        auto found = domains().find(item.name + "." + parameter.name);
        if (found == domains().end()) found = domains().find(parameter.name);
        if (found == domains().end())
            return Error{item.name + ": no domain for '" + parameter.name + "' in tests/shading/samples.cpp"};
        own.push_back(found->second);
        sampled.arguments.push_back(parameter.type);
        sampled.argument_floats += size_t(component_count(parameter.type));
    }
    std::mt19937 random(12345);
    for (size_t s = 0; s < kSampleCount; ++s)
        for (size_t i = 0; i < own.size(); ++i)
            add_sample(own[i], sampled.arguments[i], random, sampled.inputs);
    return sampled;
}

}  // namespace

Result<std::vector<Sampled>> sample_functions(const std::vector<Unit>& units) {
    std::vector<Sampled> all;
    for (const Unit& unit : units)
        for (const Item& item : unit.items) {
            if (item.name.empty()) continue;
            Result<Sampled> sampled = sample(item);
            if (!sampled) return sampled.error();
            all.push_back(std::move(*sampled));
        }
    return all;
}

double worst_difference(const Sampled& function, const std::vector<float>& a, const std::vector<float>& b) {
    const size_t count = std::min(a.size(), b.size());
    if (count == 0) return std::numeric_limits<double>::infinity();
    double worst = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) return std::numeric_limits<double>::infinity();
        const double scale = std::max({std::abs(double(a[i])), std::abs(double(b[i])), 0.1});
        worst = std::max(worst, std::abs(double(a[i]) - double(b[i])) / scale / function.relative_bound);
    }
    return worst;
}

}  // namespace dermis::shading
