#pragma once
// A scene as the renderer and the reference take it: everything in mm and linear, world space, Y up.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/image/tone_map.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/pose.h"

namespace dermis::inline scene {

enum class LightKind { directional, point, spot };

/// Directional: `intensity` is the irradiance on a surface that faces it (so that intensity pi on a white
/// Lambert surface gives radiance 1). Point and spot: radiant intensity in the same unit times square metre,
/// so that the irradiance at d metres is intensity / d^2.
struct Light {
    std::string name;
    LightKind kind = LightKind::directional;
    Vec3 color_linear = {1, 1, 1};
    float intensity = 3.14159265f;
    Vec3 to_light_world = {0, 0, 1};  ///< unit; directional: towards the light. Spot: against its axis
    Vec3 position_mm = {0, 0, 1000};  ///< point and spot
    float inner_angle_rad = 0.35f, outer_angle_rad = 0.5f;  ///< spot: full and no light, from its axis
    bool is_key = false;                                    ///< the first to get a shadow map
    bool casts_shadow = true;
};

/// Vertical field of view; right-handed, looking from eye to target.
struct Camera {
    Vec3 eye_mm = {0, 0, 600}, target_mm = {0, 0, 0}, up_world = {0, 1, 0};
    float vertical_fov_rad = 0.5236f;
    float near_mm = 1, far_mm = 10000;
};

/// p_view = view * p_world; p_clip = projection * p_view, Vulkan clip space: y down, z 0 (near) to 1 (far).
struct CameraMatrices {
    Mat4 view, projection, view_projection, inverse_view_projection;
};
[[nodiscard]] CameraMatrices camera_matrices(const Camera& camera, float aspect);

/// Sets near and far tightly around a sphere (far / near at most 10^4). Call it again whenever the eye moves.
void fit_depth_range(Camera& camera, Vec3 center_mm, float radius_mm);
/// From the front (+Z), so that the sphere just fits the height of the picture.
[[nodiscard]] Camera framing_camera(Vec3 center_mm, float radius_mm, float fov_rad = 0.5236f);

/// Yaw 0, pitch 0 is +Z; positive yaw turns towards +X, positive pitch towards +Y. The result is unit.
struct YawPitch {
    float yaw_rad = 0, pitch_rad = 0;
};
[[nodiscard]] Vec3 direction_from_yaw_pitch(float yaw_rad, float pitch_rad);
[[nodiscard]] YawPitch yaw_pitch_of(Vec3 direction);

enum class EnvironmentKind { none, studio, file };

struct Environment {
    EnvironmentKind kind = EnvironmentKind::studio;
    std::filesystem::path file;  ///< latitude-longitude HDR or EXR
    float intensity = 1;
    float yaw_rad = 0;
    bool visible = false;  ///< as the background
};

/// Values that all skin materials share. ior, roughness and specular are copied into the skin materials on
/// load (apply_skin), where they are read from, so that a material of skin can have its own.
struct Skin {
    std::string profile = "gpu_gems_3";
    int tone = 0;  ///< 1 light to 6 dark, applied on loading (skin_tone.h); 0: the colour of the materials
    /// A skin from its pigments (optics/tissue/skin_model.h), applied on loading like a tone.
    std::optional<float> melanin, blood, oxygen, pheomelanin, epidermis_mm;
    float melanin_scale = 1, blood_scale = 1;  ///< of maps of pigments, applied on loading
    float blood_by_tension = 0;                ///< scene/blood_tint.h
    std::map<std::string, std::string>
        blood_by_target;  ///< maps of change by morph target; scene/blood_tint.h
    float ior = 1.4f;
    float roughness = 0.45f;              ///< perceptual
    float specular = 1;                   ///< scales F0
    Vec3 albedo_tint_linear = {1, 1, 1};  ///< multiplies the materials' base colour
    /// What loading made of tone or pigments: the tone, and its factor in albedo_tint_linear.
    int loaded_tone = 0;
    Vec3 loaded_tint_linear = {1, 1, 1};
    bool specular_reduces_diffuse = false;  ///< shaders/include/reduced_diffuse.glsl has the formula
    std::string diffuse_table;   ///< a file of `dermis bake lut` for techniques that read one; empty: baked
    std::string zonal_table;     ///< the same of `dermis bake zh`
    std::string beckmann_table;  ///< the same of `dermis bake beckmann`

    /// Whether the blood changes with the pose.
    [[nodiscard]] bool blood_moves() const { return blood_by_tension != 0 || !blood_by_target.empty(); }
};

/// Where mesh files are in their motion, as [animation] and [morph] state it; `morph` has weights by target.
struct MotionDescription {
    std::string clip;        ///< empty: none
    double time_s = 0;       ///< since the clip began
    float speed = 1;         ///< seconds of the clip in one second
    bool loop = false;       ///< repeat the clip instead of holding its last pose
    std::string rest_bakes;  ///< parse_rest_bakes(); empty: none
    std::map<std::string, float> morph;

    [[nodiscard]] Pose pose() const {
        return {.clip = clip, .time_s = time_s * double(speed), .loop = loop, .morph = morph};
    }
    friend bool operator==(const MotionDescription&, const MotionDescription&) = default;
};

/// Which baked quantities of a posed head are those of its rest pose, carried along by the vertices, as an
/// engine has them that bakes once. Everything else is made again for the pose.
struct RestBakes {
    bool normals = false;    ///< baked normals, which turn with the tangent frame of their texel
    bool curvature = false;  ///< curvature tensors of the vertices, which turn with their tangent frames
    bool stencils = false;   ///< those tensors, changed by stencils of the rest pose (CurvatureAtRest)
    bool gain = false;       ///< walks of the vertices, for gain=map and gain=links
    bool occlusion = false;  ///< ambient occlusion of the vertices

    [[nodiscard]] bool any() const { return normals || curvature || stencils || gain || occlusion; }
    friend bool operator==(const RestBakes&, const RestBakes&) = default;
};

/// A similarity transform: p' = translation + Rz Ry Rx (scale * p): turned about X first, each rotation
/// counter-clockwise seen from its axis's tip.
struct Placement {
    float scale = 1;  ///< positive
    Vec3 rotation_rad, translation_mm;
};

/// One mesh with its transform applied. A material is skin, other, or translucent (shadow-casting glass).
enum class MaterialClass { skin, other, translucent };

/// What a material shows. All but skin and translucent are drawn with the standard material; a clear shell
/// (cornea, tears) that the mesh file draws opaque is left out, so that the eye behind it is visible.
enum class HeadPart { skin, other, translucent, eye, clear, teeth, mouth, hair, cloth };

struct FoundPart {
    HeadPart part = HeadPart::skin;
    std::string reason;     ///< "'eye' in its name"
    bool left_out = false;  ///< its triangles are not drawn
};

struct SceneObject {
    std::string name;
    Mesh mesh;
    std::vector<MaterialClass> classes;  ///< one a material of the mesh
    std::vector<FoundPart> parts = {};   ///< one a material of a mesh file; empty for subjects
    double unit_mm = 1;                  ///< of the mesh file
    Motion motion = {};                  ///< its clips and morph targets
    TargetWeights target_weights = {};   ///< in the pose
    /// ln(factor of the blood) at each vertex where a target's weight is 1 (blood_tint.h).
    std::map<std::string, std::vector<float>> blood_by_target = {};
    std::filesystem::path file = {};  ///< the mesh file; empty for subjects
    Placement placement = {};         ///< of the mesh in the scene
    /// A subject that moves: its vertices in a pose, before the placement.
    std::function<PosedVertices(const Pose&)> posed_vertices = {};
    /// A subject that moves: its mesh at rest, before the placement, without materials.
    std::shared_ptr<const Mesh> made = {};
    int subdivision = 0;            ///< of the mesh file
    std::vector<bool> hidden = {};  ///< one a material: its triangles are not drawn; empty: all are
};

struct SkinAtlas;

struct Scene {
    std::string name;
    std::vector<SceneObject> objects;
    /// Objects in the rest pose, for bakes that stay as they are there; empty unless rest_bakes says so. Same
    /// triangles and vertices. The reference reads `objects` alone.
    std::vector<SceneObject> rest_objects;
    RestBakes rest_bakes;
    std::shared_ptr<const SkinAtlas> skin_atlas;  ///< the layout of Mesh::atlas_uvs (scene/skin_atlas.h)
    std::vector<Light> lights;                    ///< at least one; exactly one is_key
    int shadow_map_budget = 3;                    ///< lights that cast shadows, at most (kMaxShadowMaps)
    Camera camera;
    Environment environment;
    Skin skin;
    MotionDescription motion;  ///< the pose of the objects
    Vec3 background_linear = {0.02f, 0.02f, 0.022f};
    ToneMap tone_map = ToneMap::hable;
    float exposure_ev = 0;
    std::string credit;     ///< text that is written with every picture of the scene
    std::string technique;  ///< optional: id and settings the file asks for
    std::map<std::string, std::string> settings;
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path> files;  ///< it was loaded from; files_of() adds what drawing reads
    Vec3 bounds_center_mm;                     ///< of all objects
    float bounds_radius_mm = 1;

    [[nodiscard]] const Light& key_light() const;
    /// Shadow map index of each light, -1 for none: the key light first, then the others in their
    /// order, as far as the budget goes. Renderer and reference both use it.
    [[nodiscard]] std::vector<int> shadow_maps() const;
};

/// The scene without its objects, which are large: what can be changed of it after loading.
[[nodiscard]] Scene without_objects(const Scene& scene);

/// A key of the scene file and its value: {"light.key.intensity", "2"}; see scene_words.h.
struct SceneWord {
    std::string key, value;
    friend bool operator==(const SceneWord&, const SceneWord&) = default;
};

}  // namespace dermis::inline scene
