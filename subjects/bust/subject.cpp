// The built-in head with its parameters; bust.h describes how it is made.

#include "dermis/scene/subject.h"
#include "subjects/bust/bust.h"

namespace dermis {
namespace {

ImageSource made_by_code(std::string name, const Image& image) {
    return {.name = std::move(name),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .pixels = image.bytes};
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

Result<SubjectScene> make(const ParameterValues& values) {
    Result<Bust> bust = make_bust(values.as<BustParams>());
    if (!bust) return bust.error();
    SceneObject object{.name = "bust", .mesh = std::move(bust->mesh), .classes = {MaterialClass::skin}};
    object.mesh.materials.resize(1);
    const std::string name = name_of(values);
    Material& skin = object.mesh.materials[0];
    skin.base_color_linear = {1, 1, 1};
    skin.roughness = 1;
    skin.base_color_map = made_by_code(name + " albedo", bust->albedo);
    skin.normal_map = made_by_code(name + " normal", bust->normal);
    skin.roughness_map = made_by_code(name + " roughness", bust->roughness);
    skin.specular_map = made_by_code(name + " specular", bust->specular);
    skin.kernel_size_map = made_by_code(name + " kernel size", bust->kernel_size);
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
