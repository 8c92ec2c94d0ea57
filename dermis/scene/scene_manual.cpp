// The text of `dermis keys`, printed from the rows that the parser uses.

#include "dermis/base/text.h"
#include "dermis/scene/scene_keys.h"

namespace dermis::inline scene {
namespace {

std::string value_column(const KeyInfo& info) {
    const std::string range = to_text(info.min) + " .. " + to_text(info.max);
    switch (info.kind) {
        case KeyKind::number:
            return range;
        case KeyKind::integer:
            return "integer " + range;
        case KeyKind::toggle:
            return "true, false";
        case KeyKind::text:
            return "text";
        case KeyKind::file:
            return "path";
        case KeyKind::choice:
            return join(info.choices, ", ");
        case KeyKind::vector:
            return "[x, y, z], each " + range;
        case KeyKind::color:
            return "[r, g, b], each " + range;
    }
    return {};
}

std::string row_text(const KeyInfo& info) {
    return "| `" + info.name + "` | " + value_column(info) + " | " + info.unit + " | " + info.default_text +
           " | " + info.doc + " |\n";
}

template <class Target>
std::string section_text(const std::string& heading, const std::string& intro,
                         const KeyTable<Target>& table) {
    std::string text = "\n## " + heading + "\n\n" + intro +
                       "\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
    for (const Key<Target>& key : table.keys()) text += row_text(key.info);
    return text;
}

constexpr std::string_view kIntroduction =
    R"(# Keys of the scene file

docs/scene_file.md describes the file. Lengths are in mm, colours are linear.
)";

}  // namespace

std::string scene_file_manual(std::span<const Subject> subjects) {
    std::string text(kIntroduction);
    text += section_text("Outside any section", "The picture as a whole.", head_keys());
    text += section_text("`[[mesh]]`", "One or more.", mesh_keys());
    for (const Subject& subject : subjects)
        for (const Parameter& parameter : subject.parameters.parameters) {
            KeyInfo info = key_info(parameter);
            info.doc = "builtin:" + subject.name + ": " + info.doc;
            text += row_text(info);
        }
    text += section_text("`[maps]`",
                         "For every material of class skin. A material's own maps, under "
                         "`[material.NAME.maps]` with the same keys, take precedence. A map is multiplied by "
                         "the constant of the same name.",
                         maps_keys());
    text += section_text("`[material.NAME]`",
                         "NAME is the material's name in the mesh file. A missing key keeps the value of the "
                         "mesh file, or, for skin, of `[skin]`. Where the mesh file cuts a material out by "
                         "alpha (glTF's alphaMode MASK, or BLEND with a map; MTL's "
                         "map_d) and has others, as with cards of hair and lashes, its class is `other`.",
                         material_keys());
    text += section_text("`[skin]`", "Values for all skin materials.", skin_keys());
    text += R"(
## `[skin.blood_by_target]`

Maps of the change of the blood by morph target: `smile = "smile_blood.png"`. docs/moving.md#tension has their values. `dermis
info` lists the targets.
)";
    text +=
        section_text("`[animation]`",
                     "Where mesh files (glTF) are in their motion. Without a clip, the pose is that of the "
                     "file's nodes. docs/moving.md has the commands.",
                     animation_keys());
    text += R"(
## `[morph]`

Weights of morph targets by name, -100 .. 100: `jawOpen = 0.6`. `dermis info` lists the targets. They replace the weights
of the clip and of the mesh file.
)";
    text += section_text(
        "`[[light]]`",
        "Any number; without any, one warm key light from the upper left. A light has a direction by yaw and "
        "pitch around a target; point and spot lights may have a position instead.",
        light_keys());
    text += section_text(
        "`[environment]`",
        "Light from all other directions. Without this section: `studio` with an intensity of 0.75.",
        environment_keys());
    text += section_text("`[camera]`",
                         "A position by angles and a distance around a target, or by `eye_mm`. Missing "
                         "values are chosen so that the whole scene is visible.",
                         camera_keys());
    text += R"(
## `[settings]`

Parameters of the technique by name: numbers, `true` or `false`, names of choices, colours as three numbers. `preset`
sets all of them before the others are read: `preset = "cheap"`. `dermis techniques NAME` lists parameters and presets of a technique.
`--set name=value` wins over the file.
)";
    return text;
}

std::string sections_with_key(std::string_view name) {
    std::vector<std::string> sections;
    const auto add = [&](const char* section, const auto& table) {
        if (table.find(name)) sections.push_back(section);
    };
    add("[[mesh]]", mesh_keys());
    add("[maps]", maps_keys());
    add("[material.NAME]", material_keys());
    add("[skin]", skin_keys());
    add("[animation]", animation_keys());
    add("[[light]]", light_keys());
    add("[environment]", environment_keys());
    add("[camera]", camera_keys());
    if (head_keys().find(name)) sections.push_back("the file, before every section");
    return join(sections, ", ");
}

}  // namespace dermis::inline scene
