#include "dermis/engines/native.h"

#include <fmt/format.h>

#include <algorithm>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"
#include "dermis/engines/engine.h"
#include "dermis/optics/conversions.h"

namespace dermis::inline engines {
namespace {

struct NativeEngine {
    std::string_view name;
    ToolId tool;
};
constexpr NativeEngine kNativeEngines[] = {{"unity_hdrp", ToolId::hdrp}, {"unreal", ToolId::unreal}};

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

Words words_of(const Profile& profile, ToolId tool) {
    const BurleyProfile burley = burley_equivalent(profile);
    Words words = {
        {"profile", printable_line(profile.name)},
        {"source", printable_line(profile.source)},
        {"guid", Hasher().add("com.dermis.skin/native").add(profile.name).add(profile.source).hex()}};
    for (size_t c = 0; c < 3; ++c) {
        words[std::string("albedo_") + "rgb"[c]] = number(burley.albedo[c]);
        words[std::string("d_mm_") + "rgb"[c]] = number(burley.d_mm[c]);
    }
    add_parameters(to_tool(tool, burley), words);
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
    const Words words =
        words_of(profile, std::ranges::find(kNativeEngines, engine, &NativeEngine::name)->tool);
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
