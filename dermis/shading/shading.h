#pragma once
// The skin's shading functions in the languages of engines: read from GLSL, printed with their comments.
//
//     Result<std::vector<Unit>> units = read_sources(sources);
//     std::string hlsl = print(*units, Language::hlsl, {"Skin shading"});
//
// The same input gives the same bytes.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// In the order of language_names(). essl: OpenGL ES 3.00 (WebGL 2); msl: Metal; gdshader: Godot 4; cpp: a
/// header for the CPU.
enum class Language { glsl, essl, hlsl, msl, wgsl, gdshader, cpp };

/// "glsl", "essl", ...
[[nodiscard]] std::vector<std::string> language_names();
/// Errors: an unknown name; the message has the closest known one.
[[nodiscard]] Result<Language> find_language(std::string_view name);
[[nodiscard]] std::string_view language_name(Language language);
/// With the dot: ".hlsl".
[[nodiscard]] std::string_view file_extension(Language language);

/// A file of GLSL; `path` is what includes and errors call it.
struct Source {
    std::string path, text;
};

/// Parsed and checked, each file behind those that it includes, else in the order given. Errors: what the
/// subset cannot say, an include that is not among the sources, includes in a circle.
[[nodiscard]] Result<std::vector<Unit>> read_sources(std::span<const Source> sources);

/// `heading`: lines of the comment at the top, without "//".
[[nodiscard]] std::string print(std::span<const Unit> units, Language language,
                                std::span<const std::string> heading);

/// Functions f become skin_f, constants kName become kSkinName, in comments too; names that begin so stay.
/// For text that is pasted into other shaders, which often have a `ggx` or `kPi` of their own and languages
/// without namespaces. `units` as read_sources() returns them.
void prefix_names(std::vector<Unit>& units);

/// Removes all functions but `names` and those that they call. Errors: an unknown name; the message has the
/// closest known one.
[[nodiscard]] Result<void> keep_functions(std::vector<Unit>& units, std::span<const std::string> names);

/// A line of code for each of these functions that is there: "float3 diffuse = skin_diffuse(n_dot_l, ...);".
[[nodiscard]] std::vector<std::string> call_lines(std::span<const Unit> units, Language language,
                                                  std::span<const std::string> names);

}  // namespace dermis::shading
