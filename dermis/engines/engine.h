#pragma once
// The differences between the engines' packages, as data.

#include <map>

#include "dermis/bake/convention.h"
#include "dermis/engines/package.h"

namespace dermis::inline engines {

/// Word between @ in a template, and what is written for it.
using Words = std::map<std::string, std::string>;

struct Engine {
    std::string_view name;  ///< also of the templates' folder

    /// The shading functions with the skin's coefficients, in one language each: a file, or with `constant` a
    /// JavaScript module's constant of that name. Several constants may have the same path.
    struct SkinText {
        std::string_view path;
        shading::Language language;
        std::string_view constant = {};
    };
    std::vector<SkinText> texts;

    std::string_view license_path = "LICENSE";
    std::string_view picture_path = "picture.png";
    std::string_view head_path = {};  ///< the folder of a head, with '/' behind it
    HeadFormat head_format = {};
    bool takes_scripts = false;  ///< the JavaScript of engines/common
    /// Where the HLSL of engines/common goes, which is a head's, and the extension that it gets; empty:
    /// nowhere.
    std::string_view hlsl_path = {}, hlsl_extension = ".hlsl";
    std::string_view table_path = {};  ///< the diffuse table, .exr or .dds; empty: none
    VOrigin v_origin = VOrigin::top;   ///< where the engine has v = 0 in a picture
    void (*add_words)(const PackageInput&, Words&) = nullptr;  ///< beyond the common ones
    /// Files that are made from the other files, such as Unity's .meta.
    Result<void> (*add_files)(const PackageInput&, std::vector<PackageFile>&) = nullptr;
};

/// "@word@" replaced wherever it is; an @ without a word behind it stays. Error: a word that `words` has not.
[[nodiscard]] Result<std::string> filled(const PackageTemplate& file, const Words& words);
[[nodiscard]] std::vector<std::byte> to_bytes(std::string_view text);

/// Texels of the diffuse table and its last row's curvature. A lookup is within 0.002 of the integral.
inline constexpr int kTableWidth = 256, kTableHeight = 128;
inline constexpr double kTableMaxCurvaturePerMm = 1;

/// All of them; engine.cpp has one entry for each.
[[nodiscard]] const std::vector<Engine>& all_engines();

}  // namespace dermis::inline engines
