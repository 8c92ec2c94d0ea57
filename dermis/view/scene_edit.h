#pragma once
// A scene file with some of its values changed: everything else, comments too, stays as it was written.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/view/model.h"

namespace dermis::view {

/// One value. `table`: "" for keys outside of any section, "camera", "light" with the number `index` of its
/// [[light]], "material.Lips" with names as toml_key() writes them. An empty `value` removes the key.
struct TomlEdit {
    std::string table, key, value;  ///< value: as TOML writes it
    int index = 0;
};

/// Line by line; a missing section is added at the end. Values over several lines are replaced whole. Not for
/// inline tables and dotted keys: the caller parses the result and sees.
[[nodiscard]] std::string edit_toml(std::string_view text, const std::vector<TomlEdit>& edits);

/// The tint beside that of the file's tone or pigments, in the decimals of a saved scene.
[[nodiscard]] Vec3 saved_tint(const Skin& skin);

/// The scene as a file of `directory`: the model's scene file with the edits, or a new one around a mesh or a
/// built-in. Paths that were relative to the old place become absolute. Errors: the scene's file cannot be
/// read any more, or is written in a way that edit_toml cannot change.
[[nodiscard]] Result<std::string> scene_text(Model& model, const std::filesystem::path& directory);

}  // namespace dermis::view
