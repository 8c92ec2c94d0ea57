#pragma once
// What a material of a head shows, by the words of its name: "M_EyeLashes" is hair, "Std_Cornea_L" a clear
// shell.

#include <optional>
#include <string>
#include <string_view>

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

struct PartWord {
    HeadPart part = HeadPart::other;
    std::string word;  ///< of the name, in lower case
};

/// Names are split at capitals, digits and signs; a joined word ("upperteeth") is split where all of it is
/// known, so that "chair" is not hair. Nothing for a name without a known word.
[[nodiscard]] std::optional<PartWord> part_of_name(std::string_view name);

/// Whether words of the name say more than one part ("head_with_eyes"): of a node or an image that several
/// materials share such a name says nothing.
[[nodiscard]] bool names_several_parts(std::string_view name);

/// Whether the name is that of an iris or a pupil.
[[nodiscard]] bool names_iris(std::string_view name);

/// "skin", "eye", "clear" and the rest, as scene files write them; in the order of HeadPart.
[[nodiscard]] const std::vector<std::string>& part_names();
[[nodiscard]] const std::string& part_name(HeadPart part);

}  // namespace dermis::inline scene
