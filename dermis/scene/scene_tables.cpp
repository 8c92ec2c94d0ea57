// The keys of the scene file, section by section. `dermis keys` prints these rows.

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/scene/part_words.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_keys.h"
#include "shaders/include/constants.h"

namespace dermis::inline scene {
namespace {

constexpr double kMaxLengthMm = 1e6;

}  // namespace

std::string key_text(const KeyInfo& info, const KeyValue& value) {
    switch (info.kind) {
        case KeyKind::number:
            return to_text(float(value.numbers[0]));
        case KeyKind::integer:
            return std::to_string(value.integer);
        case KeyKind::toggle:
            return value.integer ? "true" : "false";
        case KeyKind::choice:
            return info.choices.at(size_t(value.integer));
        case KeyKind::text:
        case KeyKind::file:
            return value.text;
        case KeyKind::vector:
        case KeyKind::color:
            break;
    }
    return "[" + to_text(float(value.numbers[0])) + ", " + to_text(float(value.numbers[1])) + ", " +
           to_text(float(value.numbers[2])) + "]";
}

KeyInfo key_info(const Parameter& parameter) {
    constexpr KeyKind kKinds[] = {KeyKind::number, KeyKind::integer, KeyKind::toggle, KeyKind::choice,
                                  KeyKind::color};
    KeyInfo info = {.name = parameter.name,
                    .unit = parameter.unit,
                    .doc = parameter.doc,
                    .kind = kKinds[size_t(parameter.kind)],
                    .min = parameter.min,
                    .max = parameter.max,
                    .choices = parameter.choices};
    KeyValue value = {.integer = int(parameter.default_value[0])};
    std::ranges::copy(parameter.default_value, value.numbers);
    info.default_text = key_text(info, value);
    return info;
}

const KeyTable<HeadDescription>& head_keys() {
    using D = HeadDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .text(&D::name,
                  {.name = "name", .doc = "name in lists and in the viewer; default: the file's name"})
            .text(&D::credit,
                  {.name = "credit", .doc = "text that is written with every picture of the scene"})
            .text(&D::without_assets, {.name = "without_assets",
                                       .doc = "scene in the same folder that is drawn instead, with a "
                                              "warning, if an `assets:` mesh or map is missing"})
            .color(&D::background_linear, {.name = "background",
                                           .unit = "linear",
                                           .doc = "radiance of the background",
                                           .max = 1e3,
                                           .changeable = true})
            .choice<ToneMap>(&D::tone_map, {.name = "tone_map",
                                            .doc = "conversion of radiance to the display",
                                            .choices = {tone_map_names().begin(), tone_map_names().end()},
                                            .changeable = true})
            .number(&D::exposure_ev, {.name = "exposure_ev",
                                      .unit = "stops",
                                      .doc = "scales radiance by 2^x",
                                      .min = -20,
                                      .max = 20,
                                      .changeable = true})
            .integer(
                &D::shadow_maps,
                {.name = "shadow_maps",
                 .doc = "lights that cast shadows, at most: the key light, then the others in their order",
                 .max = kMaxShadowMaps,
                 .changeable = true})
            .text(&D::technique,
                  {.name = "technique",
                   .doc = "id of the technique to draw the skin with; see `dermis techniques`"});
    return table;
}

const KeyTable<MeshDescription>& mesh_keys() {
    using D = MeshDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .file(&D::file, {.name = "file",
                             .doc = "`.obj`, `.gltf`, `.glb`, or `builtin:NAME`, a subject of "
                                    "`dermis subjects`"})
            .text(&D::name, {.name = "name", .doc = "name of the object; default: the file's name"})
            .number(&D::unit_mm, {.name = "unit_mm",
                                  .unit = "mm",
                                  .doc = "length of one unit of the file; default: 1000 for glTF, 1 for OBJ",
                                  .min = 1e-6,
                                  .max = 1e6})
            .number(&D::scale, {.name = "scale",
                                .doc = "factor on the size, applied before the rotation",
                                .min = 1e-6,
                                .max = 1e6})
            .vector(&D::rotate_deg, {.name = "rotate_deg",
                                     .unit = "degrees",
                                     .doc = "rotation about X, then Y, then Z, counter-clockwise as seen "
                                            "from the axis's positive end",
                                     .min = -360,
                                     .max = 360})
            .vector(&D::translate_mm, {.name = "translate_mm",
                                       .unit = "mm",
                                       .doc = "translation, applied after the rotation",
                                       .min = -kMaxLengthMm,
                                       .max = kMaxLengthMm})
            .integer(&D::subdivision,
                     {.name = "subdivision",
                      .unit = "levels",
                      .doc = "Catmull-Clark subdivision; each level has four times as many faces",
                      .max = 4})
            .choice<HeadPart>(
                &D::default_part,
                {.name = "default_class",
                 .doc = "class of materials without a class of their own; default: by their names",
                 .choices = part_names()});
    return table;
}

const KeyTable<MapsDescription>& maps_keys() {
    using D = MapsDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .map(&Material::base_color_map, {.name = "albedo", .doc = "diffuse colour, sRGB"})
            .map(
                &Material::melanin_map,
                {.name = "melanin",
                 .doc = "map of `dermis bake pigments`; melanin, blood and residue together give the albedo, "
                        "and a missing one of melanin and blood is the constant of [skin]"})
            .map(&Material::blood_map, {.name = "blood", .doc = "the same"})
            .map(&Material::residue_map,
                 {.name = "residue", .doc = "the same: what the pigments cannot make"})
            .map(&Material::pigment_mask,
                 {.name = "pigment_mask",
                  .doc = "where skin.melanin_scale and blood_scale act; red channel; default: everywhere"})
            .map(&Material::normal_map, {.name = "normal", .doc = "normals as n * 0.5 + 0.5"})
            .of_material(&Material::normal_space,
                         {.name = "normal_space",
                          .doc = "`object`: in the axes of the scene, after rotate_deg",
                          .choices = {"tangent", "object"},
                          .needs = &Material::normal_map})
            .of_material(&Material::normal_scale, {.name = "normal_scale",
                                                   .doc = "scales the slope; tangent space only",
                                                   .max = 10,
                                                   .needs = &Material::normal_map})
            .map(&Material::wrinkle_stretch_map,
                 {.name = "wrinkle_stretch",
                  .doc = "normal map in tangent space, used where a pose stretches the skin (moving.md)"})
            .map(&Material::wrinkle_compress_map,
                 {.name = "wrinkle_compress", .doc = "the same where a pose compresses it"})
            .of_material(&Material::wrinkle_stretch_target,
                         {.name = "wrinkle_stretch_target",
                          .doc = "morph target whose weight is the map's least share",
                          .needs = &Material::wrinkle_stretch_map})
            .of_material(&Material::wrinkle_compress_target, {.name = "wrinkle_compress_target",
                                                              .doc = "the same of wrinkle_compress",
                                                              .needs = &Material::wrinkle_compress_map})
            .of_material(
                &Material::wrinkle_from,
                {.name = "wrinkle_from",
                 .doc = "tension, positive or negative, at which the wrinkle maps begin to show: ln(area / "
                        "area at rest)",
                 .max = 3.9})
            .of_material(&Material::wrinkle_full,
                         {.name = "wrinkle_full",
                          .doc = "tension at which the wrinkle maps fully replace the normal map",
                          .max = 4})
            .map(&Material::specular_map,
                 {.name = "specular", .doc = "scales the reflectance at normal incidence; red channel"})
            .map(&Material::roughness_map, {.name = "roughness", .doc = "perceptual roughness; red channel"})
            .map(&Material::occlusion_map,
                 {.name = "occlusion", .doc = "visibility of the environment; red channel"})
            .map(&Material::thickness_map,
                 {.name = "thickness", .doc = "thickness of the body behind the surface; green channel"})
            .of_material(&Material::thickness_scale_mm, {.name = "thickness_scale_mm",
                                                         .unit = "mm",
                                                         .doc = "thickness of a map value of 1",
                                                         .max = 1e3,
                                                         .needs = &Material::thickness_map})
            .map(&Material::kernel_size_map,
                 {.name = "kernel_size",
                  .doc =
                      "0 on thick skin, up to 1 where it is thin and texture-space blurs grow; red channel"})
            .map(&Material::scatter_map,
                 {.name = "scatter",
                  .doc = "share of the diffuse light that scatters: 0 on nails, make-up, scars; red channel"})
            .map(&Material::curvature_map,
                 {.name = "curvature",
                  .doc = "map of `dermis bake curvature`, positive where convex; grey: mean curvature alone"})
            .of_material(&Material::curvature_scale_per_mm, {.name = "curvature_scale_per_mm",
                                                             .unit = "1/mm",
                                                             .doc = "curvature of a map value of 1",
                                                             .min = -1e3,
                                                             .max = 1e3,
                                                             .needs = &Material::curvature_map})
            .map(&Material::displacement_map,
                 {.name = "displacement", .doc = "moves vertices along the normal; red channel"})
            .of_material(&Material::curvature_mid,
                         {.name = "curvature_mid",
                          .doc = "map value of flat skin; 0.5 for maps in which mid-grey is flat",
                          .needs = &Material::curvature_map})
            .of_material(&Material::displacement_mid, {.name = "displacement_mid",
                                                       .doc = "map value (0..1) of no displacement",
                                                       .needs = &Material::displacement_map})
            .of_material(&Material::displacement_amplitude_mm,
                         {.name = "displacement_amplitude_mm",
                          .unit = "mm",
                          .doc = "displacement for a difference of 1 in map value",
                          .min = -100,
                          .max = 100,
                          .needs = &Material::displacement_map})
            .map(&Material::opacity_map,
                 {.name = "opacity", .doc = "coloured transmittance of translucent materials"})
            .of_material(
                &Material::dilate_texels,
                {.name = "dilate_texels",
                 .unit = "texels",
                 .doc = "width of the gutter that is added around the UV islands of maps without one",
                 .max = 64});
    return table;
}

const KeyTable<MaterialDescription>& material_keys() {
    using D = MaterialDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .choice<HeadPart>(&D::part,
                              {.name = "class",
                               .doc = "skin is drawn by the technique; translucent lets the key light "
                                      "through, coloured by its opacity map; the others have the standard "
                                      "material",
                               .choices = part_names()})
            .of_material(&Material::base_color_linear,
                         {.name = "albedo",
                          .unit = "linear",
                          .doc = "diffuse colour; multiplies the map, if there is one"})
            .of_material(&Material::roughness,
                         {.name = "roughness", .doc = "perceptual: the GGX width is its square"})
            .of_material(&Material::specular,
                         {.name = "specular", .doc = "scales the reflectance at normal incidence", .max = 10})
            .of_material(&Material::ior, {.name = "ior", .doc = "index of refraction", .min = 1, .max = 3})
            .of_material(
                &Material::profile,
                {.name = "profile",
                 .doc = "diffusion profile of this skin, as `profile` under [skin]; at most 15 a scene"})
            .of_material(&Material::scatter,
                         {.name = "scatter",
                          .doc = "share of the skin's diffuse light that scatters; multiplies the map"})
            .of_material(&Material::metallic, {.name = "metallic", .doc = "0 dielectric, 1 metal"})
            .of_material(&Material::opacity,
                         {.name = "opacity", .doc = "coverage; below 1 the surfaces behind are visible"})
            .of_material(
                &Material::emission_linear,
                {.name = "emission", .unit = "linear", .doc = "emitted radiance", .max = kMostEmission})
            .toggle(&D::visible, {.name = "visible", .doc = "false removes its triangles"});
    return table;
}

const KeyTable<Skin>& skin_keys() {
    static const KeyTable<Skin> table =
        KeyTable<Skin>()
            .text(
                &Skin::profile,
                {.name = "profile",
                 .doc = "a diffusion profile: its name (`dermis profile list`) or its file: .csv, .mtlx (its "
                        "roughness and ior too, where the scene has none), or a .glb whose skin scatters",
                 .changeable = true})
            .integer(&Skin::tone,
                     {.name = "tone",
                      .doc = "1 light to 6 dark, a skin of the OpenPBR examples: sets albedo_tint, so that "
                             "the skin's mean colour is that of the tone, and the profile, where none is "
                             "named; 0: the colour of the maps",
                      .max = 6})
            .number(
                &Skin::melanin,
                {.name = "melanin",
                 .doc = "skin from its pigments (skin_model.md): sets albedo_tint, so that the skin's mean "
                        "colour is that of the model, and the profile, where none is named. This key: "
                        "volume fraction of melanosomes in the epidermis, 0.01 light to 0.43 dark"})
            .number(&Skin::blood, {.name = "blood",
                                   .doc = "the same: volume fraction of blood in the dermis, 0.002 to 0.07"})
            .number(&Skin::oxygen, {.name = "oxygen", .doc = "the same: oxygen saturation of the blood"})
            .number(&Skin::pheomelanin,
                    {.name = "pheomelanin", .doc = "the same: share of the melanin that is pheomelanin"})
            .number(&Skin::epidermis_mm,
                    {.name = "epidermis_mm", .unit = "mm", .doc = "the same: thickness of the epidermis"})
            .number(&Skin::melanin_scale, {.name = "melanin_scale",
                                           .doc = "multiplies maps.melanin within maps.pigment_mask",
                                           .max = 10})
            .number(
                &Skin::blood_scale,
                {.name = "blood_scale", .doc = "multiplies maps.blood within maps.pigment_mask", .max = 10})
            .number(&Skin::blood_by_tension,
                    {.name = "blood_by_tension",
                     .doc = "in a pose the blood of skin of pigments is multiplied by exp(-this * tension) "
                            "(moving.md): stretched skin pales; 1 keeps the amount below each piece of skin",
                     .max = 4})
            .text(&Skin::diffuse_table,
                  {.name = "diffuse_table",
                   .doc = "path of a table of `dermis bake lut` over curvature, read instead of baking one"})
            .text(&Skin::zonal_table,
                  {.name = "zonal_table",
                   .doc = "path of a table of `dermis bake zh`, with all orders or remapped, read instead of "
                          "baking one"})
            .text(
                &Skin::beckmann_table,
                {.name = "beckmann_table",
                 .doc = "path of a table of `dermis bake beckmann`, read by preintegrated with specular=ksk"})
            .number(&Skin::ior, {.name = "ior", .doc = "index of refraction", .min = 1, .max = kMostSkinIor})
            .number(&Skin::roughness, {.name = "roughness", .doc = "perceptual: the GGX width is its square"})
            .number(&Skin::specular,
                    {.name = "specular", .doc = "scales the reflectance at normal incidence", .max = 10})
            .toggle(
                &Skin::specular_reduces_diffuse,
                {.name = "specular_reduces_diffuse",
                 .doc = "what the surface reflects is taken from the diffuse light, by the angles of light "
                        "and view, in every technique and in the reference"})
            .color(&Skin::albedo_tint_linear, {.name = "albedo_tint",
                                               .unit = "linear",
                                               .doc = "multiplies the colour of every skin material",
                                               .max = 4,
                                               .changeable = true});
    return table;
}

const KeyTable<MotionDescription>& animation_keys() {
    using D = MotionDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .text(&D::clip, {.name = "clip",
                             .doc = "name of an animation of the mesh file, or `#2` for the second; "
                                    "`dermis info` lists them"})
            .number(&D::time_s,
                    {.name = "time_s",
                     .unit = "s",
                     .doc = "time since the start of the clip; after its end the last pose is held",
                     .max = 1e6})
            .number(&D::speed,
                    {.name = "speed", .doc = "seconds of the clip in one second", .min = 0.01, .max = 100})
            .toggle(&D::loop, {.name = "loop", .doc = "repeats the clip instead of holding its last pose"})
            .text(
                &D::rest_bakes,
                {.name = "rest_bakes",
                 .doc = "what techniques bake once, in the pose of the file's nodes, and the vertices carry "
                        "along: `normals`, `curvature`, `gain`, `occlusion`, joined by `+`, or `all`; the "
                        "reference is not changed"});
    return table;
}

KeyInfo morph_key(const std::string& target) {
    return {.name = target, .kind = KeyKind::number, .min = -kMostMorph, .max = kMostMorph};
}

KeyInfo blood_map_key(const std::string& target) {
    return {.name = target, .kind = KeyKind::file};
}

NamedFile blood_map_of(const std::string& target, const KeyValue& value) {
    return {.text = value.text, .key = std::string(kBloodByTarget) + "." + target, .line = value.line};
}

const KeyTable<LightDescription>& light_keys() {
    using D = LightDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .text(&D::name, {.name = "name", .doc = "name in messages and in the viewer"})
            .choice<LightKind>(&D::kind, {.name = "kind",
                                          .doc = "point and spot fall off with the square of the distance",
                                          .choices = {"directional", "point", "spot"}})
            .color(&D::color_linear,
                   {.name = "color", .unit = "linear", .doc = "multiplies the intensity", .max = 1e3})
            .number(&D::intensity, {.name = "intensity",
                                    .unit = "irradiance",
                                    .doc = "directional: on a surface that faces the light (pi gives a white "
                                           "Lambert surface the radiance 1); point "
                                           "and spot: the same at 1 m",
                                    .max = 1e6})
            .number(&D::yaw_deg,
                    {.name = "yaw_deg",
                     .unit = "degrees",
                     .doc = "direction from the target to the light: 0 in front (+Z), positive towards +X",
                     .min = -360,
                     .max = 360})
            .number(&D::pitch_deg, {.name = "pitch_deg",
                                    .unit = "degrees",
                                    .doc = "the same, positive upwards",
                                    .min = -90,
                                    .max = 90})
            .number(&D::distance_mm, {.name = "distance_mm",
                                      .unit = "mm",
                                      .doc = "point and spot: from the target",
                                      .min = 0.1,
                                      .max = kMaxLengthMm})
            .vector(&D::position_mm, {.name = "position_mm",
                                      .unit = "mm",
                                      .doc = "point and spot: instead of yaw_deg, pitch_deg and distance_mm",
                                      .min = -kMaxLengthMm,
                                      .max = kMaxLengthMm})
            .vector(&D::target_mm,
                    {.name = "target_mm",
                     .unit = "mm",
                     .doc = "the point at which the light is aimed; default: the centre of the scene",
                     .min = -kMaxLengthMm,
                     .max = kMaxLengthMm})
            .number(&D::inner_angle_deg, {.name = "inner_angle_deg",
                                          .unit = "degrees",
                                          .doc = "spot: full light up to this angle from its axis",
                                          .max = 89})
            .number(&D::outer_angle_deg, {.name = "outer_angle_deg",
                                          .unit = "degrees",
                                          .doc = "spot: no light beyond it",
                                          .min = 0.1,
                                          .max = 89.5})
            .toggle(&D::key, {.name = "key",
                              .doc = "the main light, the first to get a shadow map; exactly one. A single "
                                     "light is the key light without it"})
            .toggle(&D::shadow, {.name = "shadow", .doc = "casts a shadow, if shadow_maps allows it"});
    return table;
}

const KeyTable<EnvironmentDescription>& environment_keys() {
    using D = EnvironmentDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .choice<EnvironmentKind>(&D::kind, {.name = "kind",
                                                .doc = "studio is built in: soft boxes around the scene; "
                                                       "`file` when `file` is given, else studio",
                                                .choices = {"none", "studio", "file"}})
            .file(&D::file, {.name = "file", .doc = "latitude-longitude panorama, `.hdr` or `.exr`"})
            .number(&D::intensity, {.name = "intensity", .doc = "multiplies its radiance", .max = 1e3})
            .number(&D::yaw_deg, {.name = "yaw_deg",
                                  .unit = "degrees",
                                  .doc = "rotation about Y; positive moves what is in front (+Z) towards +X",
                                  .min = -360,
                                  .max = 360})
            .toggle(&D::visible, {.name = "visible", .doc = "the environment is the background"});
    return table;
}

const KeyTable<CameraDescription>& camera_keys() {
    using D = CameraDescription;
    static const KeyTable<D> table =
        KeyTable<D>()
            .vector(&D::eye_mm, {.name = "eye_mm",
                                 .unit = "mm",
                                 .doc = "instead of yaw_deg, pitch_deg and distance_mm",
                                 .min = -kMaxLengthMm,
                                 .max = kMaxLengthMm})
            .vector(&D::target_mm, {.name = "target_mm",
                                    .unit = "mm",
                                    .doc = "centre of the picture; default: the centre of the scene",
                                    .min = -kMaxLengthMm,
                                    .max = kMaxLengthMm})
            .number(&D::yaw_deg, {.name = "yaw_deg",
                                  .unit = "degrees",
                                  .doc = "around the target: 0 from the front (+Z), positive towards +X",
                                  .min = -360,
                                  .max = 360})
            .number(
                &D::pitch_deg,
                {.name = "pitch_deg", .unit = "degrees", .doc = "positive from above", .min = -90, .max = 90})
            .number(&D::distance_mm, {.name = "distance_mm",
                                      .unit = "mm",
                                      .doc = "from the target; default: the whole scene is visible",
                                      .min = 0.1,
                                      .max = kMaxLengthMm})
            .number(&D::fov_deg, {.name = "fov_deg",
                                  .unit = "degrees",
                                  .doc = "vertical field of view",
                                  .min = 1,
                                  .max = 120});
    return table;
}

}  // namespace dermis::inline scene
