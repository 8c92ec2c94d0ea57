#pragma once
// dermis export --web: a scene, its skin and six tones as a page.

#include <string>

#include "dermis/web/web.h"

namespace dermis::cli {

/// `profile` replaces the scene's; empty: the scene's own. Errors as load_scene(), find_profile() and
/// dermis::make_web_page().
[[nodiscard]] Result<WebPage> make_web_page(const std::string& scene_name, const std::string& profile);

}  // namespace dermis::cli
