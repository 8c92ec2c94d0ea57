#pragma once
// Changes for which the scene's files are read again: class, profile and visibility of its materials, the
// unit of its meshes. They are the words that --scene takes.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/view/model.h"

namespace dermis::view {

/// A material of the scene's mesh files, as the panel lists it.
struct HeadMaterial {
    std::string name;
    HeadPart part = HeadPart::skin;
    std::string reason;   ///< for its class
    bool visible = true;  ///< some of its triangles are drawn
    std::string profile;  ///< its own; empty: the scene's
    std::string maps;     ///< "base color, normal"; empty: none
};
/// Each name once; none of subjects, whose materials cannot be changed.
[[nodiscard]] std::vector<HeadMaterial> materials_of(const Scene& scene);

/// Whether the class of any material was found by its name.
[[nodiscard]] bool has_guessed_classes(const Scene& scene);

/// A mesh file and the key of its unit: "mesh.unit_mm", or "mesh.2.unit_mm" of several.
struct HeadMesh {
    std::string name, unit_key;
    double unit_mm = 1;
};
/// None where a subject is among them.
[[nodiscard]] std::vector<HeadMesh> meshes_of(const Scene& scene);

/// The words with this one; it replaces another of its key.
void put_word(std::vector<SceneWord>& words, SceneWord word);

/// The words that are not of [animation] and [morph].
[[nodiscard]] std::vector<SceneWord> words_beside_motion(std::vector<SceneWord> words);

/// The meshes of `fresh` have another unit than those of `seen`.
[[nodiscard]] bool has_other_unit(const Scene& seen, const Scene& fresh);
/// Camera and lights of `fresh` have the place on it that they had on `seen`.
void scale_look(const Scene& seen, Scene& fresh);

}  // namespace dermis::view
