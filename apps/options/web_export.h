#pragma once
// dermis export --web: a scene, its skin and six tones as a page.

#include <string>

#include "dermis/engines/web.h"
#include "scene_choice.h"

namespace dermis::cli {

/// `inputs` gets the files of the scene; `profile` replaces the scene's; empty: the scene's own. Errors as
/// SceneChoice::load(), find_profile() and dermis::make_web_page().
[[nodiscard]] Result<WebPage> make_web_page(const SceneChoice& choice, const std::string& profile,
                                            std::vector<std::filesystem::path>& inputs);

}  // namespace dermis::cli
