#pragma once
// What `dermis compare` compares: a scene, or each of a set of test scenes.

#include <vector>

#include "compare_options.h"
#include "dermis/scene/subject.h"

namespace dermis::cli {

struct ComparedScenes {
    std::vector<SubjectCase> all;
    bool is_set = false;
};

/// The subject of this name ("unit", "builtin:unit") if it is a set; otherwise null.
[[nodiscard]] const Subject* set_of_scenes(const std::string& name);

/// Complete scenes. Of a set all, or the one that --scene mesh.shape=NAME chooses; what else is given changes
/// each. Errors: as SceneChoice::load().
[[nodiscard]] Result<ComparedScenes> compared_scenes(const CompareChoice& choice);

}  // namespace dermis::cli
