#pragma once
// Names that do not meet those of the program that the text is pasted into.

#include <string_view>
#include <vector>

#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// Functions f become skin_f, constants kName become kSkinName, in comments too; names that begin so stay.
/// For text that is pasted into other shaders, which often have a `ggx` or `kPi` of their own and languages
/// without namespaces. `units` as read_sources() returns them.
void prefix_names(std::vector<Unit>& units);

}  // namespace dermis::shading
