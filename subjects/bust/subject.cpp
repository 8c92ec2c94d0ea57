// The built-in head with its parameters; bust.h describes how it is made.

#include <memory>
#include <numeric>

#include "dermis/base/parallel.h"
#include "dermis/mesh/follow_normals.h"
#include "dermis/scene/subject.h"
#include "subjects/bust/bust.h"
#include "subjects/bust/expressions.h"
#include "subjects/bust/field.h"

namespace dermis {
namespace {

ImageSource made_by_code(std::string name, Image&& image) {
    return {.name = std::move(name),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .pixels = std::move(image.bytes)};
}

// Maps of different busts need different names: "builtin:bust tone=5".
std::string name_of(const ParameterValues& values) {
    std::string name = "builtin:bust";
    const ParameterValues standard(values.table());
    for (const Parameter& parameter : values.table().parameters)
        if (const std::string text = values.text(parameter); text != standard.text(parameter))
            name += " " + parameter.name + "=" + text;
    return name;
}

// The head at rest, with what its expressions need at each vertex.
struct HeadAtRest {
    Mesh mesh;  // positions, normals, tangents, triangles
    std::vector<bust::Point> standard;

    [[nodiscard]] PosedVertices posed(const Pose& pose) const {
        const bust::ExpressionWeights weights = bust::expression_weights(pose);
        Mesh moved = mesh;
        parallel_for(standard.size(), 4096, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                const Vec3 n = mesh.normals[v];
                const bust::Point move = bust::expression_move(standard[v], {n.x, n.y, n.z}, weights);
                moved.positions_mm[v] += Vec3{float(move.x), float(move.y), float(move.z)};
            }
        });
        turn_normals(mesh.positions_mm, moved);
        TargetWeights by_name;
        for (size_t i = 0; i < weights.size(); ++i)
            if (weights[i] != 0) by_name[std::string(bust::kExpressions[i])] = float(weights[i]);
        return {std::move(moved.positions_mm), std::move(moved.normals), std::move(by_name)};
    }
};

// Measured in the standard head, applied in this one, whose proportions differ by some per cent.
void add_expressions(SceneObject& object, const BustParams& params) {
    const auto head = std::make_shared<HeadAtRest>();
    head->mesh.positions_mm = object.mesh.positions_mm;
    head->mesh.normals = object.mesh.normals;
    head->mesh.tangents = object.mesh.tangents;
    head->mesh.indices = object.mesh.indices;
    const BustField field(params);
    for (const Vec3& p : object.mesh.positions_mm)
        head->standard.push_back(field.to_standard({p.x, p.y, p.z}));
    object.mesh.file_vertices.resize(object.mesh.positions_mm.size());
    std::iota(object.mesh.file_vertices.begin(), object.mesh.file_vertices.end(), 0u);
    object.motion = bust::bust_motion();
    object.posed_vertices = [head](const Pose& pose) { return head->posed(pose); };
}

Result<SubjectScene> make(const ParameterValues& values) {
    Result<Bust> bust = make_bust(values.as<BustParams>());
    if (!bust) return bust.error();
    SceneObject object{.name = "bust", .mesh = std::move(bust->mesh), .classes = {MaterialClass::skin}};
    object.mesh.materials.resize(1);
    add_expressions(object, values.as<BustParams>());
    const std::string name = name_of(values);
    Material& skin = object.mesh.materials[0];
    skin.base_color_linear = {1, 1, 1};
    skin.roughness = 1;
    skin.base_color_map = made_by_code(name + " albedo", std::move(bust->albedo));
    skin.normal_map = made_by_code(name + " normal", std::move(bust->normal));
    skin.roughness_map = made_by_code(name + " roughness", std::move(bust->roughness));
    skin.specular_map = made_by_code(name + " specular", std::move(bust->specular));
    skin.kernel_size_map = made_by_code(name + " kernel size", std::move(bust->kernel_size));
    skin.melanin_map = made_by_code(name + " melanin", std::move(bust->melanin));
    skin.blood_map = made_by_code(name + " blood", std::move(bust->blood));
    SubjectScene scene;
    scene.objects.push_back(std::move(object));
    return scene;
}

}  // namespace

Subject make_bust_subject() {
    return {.name = "bust",
            .summary = "a head with closed eyes, its skin painted by code",
            .parameters = bust_parameters(),
            .make = make};
}

}  // namespace dermis
