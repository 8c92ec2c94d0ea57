#include "dermis/engines/native.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"
#include "dermis/engines/engine.h"
#include "dermis/optics/artistic_kernel.h"
#include "dermis/optics/conversions.h"

namespace dermis::inline engines {
namespace {

struct NativeEngine {
    std::string_view name;
    std::optional<ToolId> tool;  ///< of an engine that blurs by Burley's profile
};
constexpr NativeEngine kNativeEngines[] = {
    {"unity_hdrp", ToolId::hdrp}, {"unreal", ToolId::unreal}, {"babylon", ToolId::babylon}, {"godot", {}}};

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

// Of a tool's parameter: "key", or "key_r", "key_g" and "key_b".
void add_parameters(const ToolSettings& settings, Words& words) {
    const std::vector<ToolKey>& keys = convention_of(settings.tool).keys;
    for (size_t i = 0; i < keys.size(); ++i) {
        const std::string name = to_lower(keys[i].name);
        if (keys[i].count == 1) {
            words[name] = number(settings.values[i][0]);
            continue;
        }
        for (size_t c = 0; c < 3; ++c) words[name + "_" + "rgb"[c]] = number(settings.values[i][c]);
    }
}

// Godot 4.2 to 4.6, servers/rendering/renderer_rd/shaders/effects/subsurface_scattering.glsl: the skin's
// kernel is ArtisticKernel with its defaults, cut off here in its highest quality. With a
// subsurface_scattering_scale of 0 its 1 mm is drawn as so many mm times the strength and the depth scale,
// along the picture's width.
constexpr double kGodotReachMm = 3, kGodotMmPerStrength = 2000.0 / 3;
// With it a skin's strength is 0.1 to 1, the range of the engine's slider.
constexpr double kGodotDepthScale = 0.02;
// Below, the shader takes no tap.
constexpr double kGodotLeastStrength = 0.001;

Result<void> add_godot(const Profile& profile, Words& words) {
    const Rgb kernel_mm2 = mean_square_along_line_mm2({}, kGodotReachMm);
    const KernelWidth fit = fitted_width(kernel_mm2, profile);
    const double strength = fit.width / (kGodotMmPerStrength * kGodotDepthScale);
    if (!(strength >= kGodotLeastStrength))
        return Error{fmt::format("--native: godot draws no blur below a strength of {}, and {} would need {}",
                                 kGodotLeastStrength, printable_line(profile.name), number(strength))};
    words["depth_scale"] = number(kGodotDepthScale);
    words["strength"] = number(strength);
    words["percent"] = fmt::format("{:.0f}", 100 * fit.share);
    const double infinite = std::numeric_limits<double>::infinity();
    words["technique_width"] = number(fitted_width(mean_square_along_line_mm2({}, infinite), profile).width);
    for (size_t c = 0; c < 3; ++c) {
        const std::string channel(1, "rgb"[c]);
        words["kernel_rms_mm_" + channel] = fmt::format("{:.3g}", fit.width * std::sqrt(kernel_mm2[c]));
        words["skin_rms_mm_" + channel] =
            fmt::format("{:.3g}", std::sqrt(mean_square_radius_mm2(profile, int(c)) / 2));
    }
    return {};
}

Result<Words> words_of(const Profile& profile, std::optional<ToolId> tool) {
    const BurleyProfile burley = burley_equivalent(profile);
    Words words = {
        {"profile", printable_line(profile.name)},
        {"source", printable_line(profile.source)},
        {"guid", Hasher().add("com.dermis.skin/native").add(profile.name).add(profile.source).hex()}};
    for (size_t c = 0; c < 3; ++c) {
        words[std::string("albedo_") + "rgb"[c]] = number(burley.albedo[c]);
        words[std::string("d_mm_") + "rgb"[c]] = number(burley.d_mm[c]);
    }
    if (tool)
        add_parameters(to_tool(*tool, burley), words);
    else
        DERMIS_TRY(add_godot(profile, words));
    return words;
}

}  // namespace

std::vector<std::string> native_engine_names() {
    std::vector<std::string> names;
    for (const NativeEngine& engine : kNativeEngines) names.emplace_back(engine.name);
    return names;
}

Result<void> check_native_engine(std::string_view engine) {
    const std::vector<std::string> names = native_engine_names();
    if (std::ranges::find(names, engine) != names.end()) return {};
    return Error{"--native: no profile for " + std::string(engine) + "; there is one for " +
                 join(names, ", ")};
}

Result<std::vector<PackageFile>> make_native_profile(std::string_view engine, const Profile& profile,
                                                     std::span<const PackageTemplate> templates) {
    DERMIS_TRY(check_native_engine(engine));
    DERMIS_TRY_ASSIGN(
        const Words words,
        words_of(profile, std::ranges::find(kNativeEngines, engine, &NativeEngine::name)->tool));
    const std::string folder = "engines/native/" + std::string(engine) + "/";
    std::vector<PackageFile> files;
    for (const PackageTemplate& file : templates) {
        if (!file.path.starts_with(folder)) continue;
        DERMIS_TRY_ASSIGN(const std::string text, filled(file, words));
        files.push_back({file.path.substr(folder.size()), to_bytes(text)});
    }
    return files;
}

}  // namespace dermis::inline engines
