#include "dermis/optics/conversions.h"

#include <algorithm>
#include <cassert>

#include "dermis/base/text.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/check_value.h"
#include "dermis/optics/tool_rows.h"

namespace dermis::inline optics {
namespace {

const ToolRow& row_of(ToolId tool) {
    return *std::ranges::find_if(tool_rows(), [&](const ToolRow& row) { return row.convention.id == tool; });
}

}  // namespace

const std::vector<ToolConvention>& tool_conventions() {
    static const std::vector<ToolConvention> kConventions = [] {
        std::vector<ToolConvention> all;
        for (const ToolRow& row : tool_rows()) all.push_back(row.convention);
        return all;
    }();
    return kConventions;
}

const ToolConvention& convention_of(ToolId tool) {
    return row_of(tool).convention;
}

Result<ToolId> find_tool(std::string_view name) {
    std::vector<std::string> names;
    for (const ToolRow& row : tool_rows()) {
        if (row.convention.name == name) return row.convention.id;
        names.emplace_back(row.convention.name);
    }
    return Error{unknown_name("tool", name, names)};
}

ToolSettings default_settings(ToolId tool) {
    ToolSettings settings{tool, {}};
    for (const ToolKey& key : convention_of(tool).keys) settings.values.push_back(key.default_value);
    return settings;
}

Result<void> set_value(ToolSettings& settings, std::string_view key_name,
                       const std::vector<double>& numbers) {
    const ToolConvention& convention = convention_of(settings.tool);
    std::vector<std::string> names;
    for (size_t k = 0; k < convention.keys.size(); ++k) {
        const ToolKey& key = convention.keys[k];
        names.emplace_back(key.name);
        if (key.name != key_name) continue;
        if (numbers.size() != 1 && numbers.size() != size_t(key.count))
            return Error{std::string(convention.name) + ": " + std::string(key.name) + " takes " +
                         std::to_string(key.count) + " number" + (key.count == 1 ? "" : "s") + ", not " +
                         std::to_string(numbers.size())};
        for (size_t c = 0; c < size_t(key.count); ++c) {
            const double number = numbers[numbers.size() == 1 ? 0 : c];
            if (!(number >= key.min && number <= key.max))
                return out_of_range(std::string(convention.name) + ": " + std::string(key.name), number,
                                    to_text(key.min) + " to " + to_text(key.max));
            settings.values[k][c] = number;
        }
        return {};
    }
    return Error{unknown_name(std::string(convention.name) + " key", key_name, names)};
}

ToolSettings to_tool(ToolId tool, const BurleyProfile& burley) {
    return {tool, row_of(tool).write(burley)};
}

Result<BurleyProfile> to_canonical(const ToolSettings& settings) {
    const ToolRow& row = row_of(settings.tool);
    assert(settings.values.size() == row.convention.keys.size());
    if (settings.tool == ToolId::pbrt)
        for (size_t c = 0; c < 3; ++c)
            if (!(settings.values[0][c] + settings.values[1][c] > 0))
                return out_of_range("pbrt: sigma_a + sigma_s of " + channel_name(int(c)), 0, "> 0");
    const BurleyProfile burley = row.read(settings.values);
    DERMIS_TRY(check(Profile{std::string(row.convention.name), "", burley}));
    return burley;
}

ScatteringMedium medium_of(const BurleyProfile& burley, double g, double eta) {
    Rgb path_mm;
    for (size_t c = 0; c < 3; ++c) {
        const double alpha = single_scatter_albedo_of(burley.albedo[c], g);
        // 1 / sigma_t' = s(A) d and sigma_t' = sigma_t (1 - alpha g).
        path_mm[c] = burley.d_mm[c] * mean_free_path_per_d(burley.albedo[c]) * (1 - alpha * g);
    }
    return medium_of(burley.albedo, path_mm, g, eta);
}

bool is_pure_blur(const Profile& profile, int channel) {
    // Sums of rounded weights are not exactly 1.
    constexpr double kPure = 0.999;
    return !std::holds_alternative<DipoleProfile>(profile.model) && diffuse_albedo(profile, channel) >= kPure;
}

std::string walk_volume_note(const Profile& profile) {
    std::vector<std::string> channels;
    for (int c = 0; c < 3; ++c)
        if (is_pure_blur(profile, c)) channels.push_back(channel_name(c));
    if (channels.empty()) return "";
    return profile.name + " has no volume (albedo 1 in " + join(channels, ", ") +
           "); walk takes one of albedo " + to_text(kBlurAlbedo) + " and the same mean radius";
}

ScatteringMedium walk_medium_of(const Profile& profile) {
    if (const auto* dipole = std::get_if<DipoleProfile>(&profile.model)) return dipole->medium;
    BurleyProfile burley = burley_equivalent(profile);
    for (int c = 0; c < 3; ++c)
        if (is_pure_blur(profile, c)) burley.albedo[size_t(c)] = kBlurAlbedo;
    return medium_of(burley, burley.g, 1);
}

BurleyProfile with_anisotropy(BurleyProfile isotropic, double g) {
    isotropic.g = g;
    for (size_t c = 0; c < 3; ++c)
        isotropic.d_mm[c] /= 1 - single_scatter_albedo_of(isotropic.albedo[c], g) * g;
    return isotropic;
}

BurleyProfile without_anisotropy(BurleyProfile burley) {
    for (size_t c = 0; c < 3; ++c)
        burley.d_mm[c] *= 1 - single_scatter_albedo_of(burley.albedo[c], burley.g) * burley.g;
    burley.g = 0;
    return burley;
}

BurleyProfile burley_of(const ScatteringMedium& medium) {
    BurleyProfile burley{.g = medium.g};
    for (size_t c = 0; c < 3; ++c) {
        burley.albedo[c] =
            std::clamp(multiscatter_albedo(single_scatter_albedo(medium, int(c)), medium.g), 0.0, 1.0);
        burley.d_mm[c] = 1 / reduced_sigma_t_per_mm(medium, int(c)) / mean_free_path_per_d(burley.albedo[c]);
    }
    return burley;
}

}  // namespace dermis::inline optics
