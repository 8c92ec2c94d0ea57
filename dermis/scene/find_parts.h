#pragma once
// What the materials of a mesh file show, from their names, images and alpha.

#include <string>
#include <vector>

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// One a material. The first of these that says something decides: the material scatters in the file; it is
/// the only one (skin); words of its name (part_words.h), of its mesh's name, of its image's name; alpha
/// that cuts it out beside whole materials (hair) or makes it nearly transparent (clear). A material of
/// which nothing is known is skin. Clear shells without alpha are left out, and so are lashes and brows
/// without alpha and colour map; a cornea of a mesh that has no other eye is the eye.
[[nodiscard]] std::vector<FoundPart> find_parts(const Mesh& mesh);

[[nodiscard]] MaterialClass class_of(HeadPart part);

/// Gives eyes, teeth, mouths and hair a colour and roughness where the mesh file states none.
void complete_material(const FoundPart& found, Material& material);

/// Whether the colour of a skin material is known: from a map or a stated colour that is not grey. Exporters
/// write greys that nobody chose.
[[nodiscard]] bool has_skin_color(const Material& material);

/// "materials by name: skin 'face'; eye 'iris'; ...", with what is left out; empty where all is skin.
[[nodiscard]] std::string parts_note(const SceneObject& object);

/// Whether any of it is found, not stated by a scene.
[[nodiscard]] bool is_guessed(const std::vector<FoundPart>& parts);

}  // namespace dermis::inline scene
