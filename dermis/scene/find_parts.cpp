#include "dermis/scene/find_parts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/object_checks.h"
#include "dermis/scene/part_words.h"

namespace dermis::inline scene {
namespace {

std::string quoted(const std::string& word, const char* place) {
    return "'" + word + "' in " + place;
}

// The file's name of an image, or its name in a GLB ("head.glb:T_Eye_D").
std::string image_name(const ImageSource& image) {
    if (!image.present()) return "";
    if (!image.encoded.empty()) return image.name.substr(image.name.rfind(':') + 1);
    return utf8_path(image.name).stem().string();
}

// Cards of lashes and brows cover the eye where no alpha cuts them out.
bool is_lash(const FoundPart& found) {
    return found.part == HeadPart::hair &&
           (found.reason.find("lash") != std::string::npos || found.reason.find("brow") != std::string::npos);
}

class Finder {
  public:
    explicit Finder(const Mesh& mesh) : mesh_(mesh) {
        for (const Submesh& submesh : mesh.submeshes)
            if (submesh.index_count > 0) used_.insert(submesh.material);
        scatters_ =
            std::ranges::any_of(mesh.materials, [](const Material& m) { return m.scattering.has_value(); });
    }

    std::vector<FoundPart> run() {
        std::vector<FoundPart> parts;
        for (uint32_t i = 0; i < mesh_.materials.size(); ++i) parts.push_back(find(i));
        settle_shells(parts);
        return parts;
    }

  private:
    FoundPart find(uint32_t number) const {
        const Material& material = mesh_.materials[number];
        if (material.scattering) return {HeadPart::skin, "the mesh file says that it scatters"};
        if (!scatters_ && used_.size() <= 1) return {HeadPart::skin, "the only material"};
        if (const auto word = part_of_name(material.name))
            return {word->part, quoted(word->word, "its name")};
        if (auto found = from_mesh_name(number)) return *found;
        const std::string image = image_name(material.base_color_map);
        if (const auto word = part_of_name(image); word && !names_several_parts(image))
            return {word->part, quoted(word->word, "its image's name")};
        if (is_card(mesh_, material))
            return material.opacity < 0.5f ? FoundPart{HeadPart::clear, "nearly transparent"}
                                           : FoundPart{HeadPart::hair, "alpha cuts it out"};
        if (scatters_) return {HeadPart::other, "the mesh file lets other materials scatter"};
        return {HeadPart::skin, "no known word in its name"};
    }

    std::optional<FoundPart> from_mesh_name(uint32_t number) const {
        std::optional<PartWord> said;
        for (const Submesh& submesh : mesh_.submeshes) {
            if (submesh.material != number) continue;
            const auto word = part_of_name(submesh.name);
            if (!word || names_several_parts(submesh.name) || (said && said->part != word->part)) return {};
            said = word;
        }
        if (!said) return {};
        return FoundPart{said->part, quoted(said->word, "the name of its mesh")};
    }

    void settle_shells(std::vector<FoundPart>& parts) const {
        const bool has_eye =
            std::ranges::any_of(used_, [&](uint32_t number) { return parts[number].part == HeadPart::eye; });
        for (size_t i = 0; i < parts.size(); ++i) {
            const Material& material = mesh_.materials[i];
            const bool has_alpha = material.alpha_mode == AlphaMode::mask || is_blended(material);
            if (is_lash(parts[i]) && !has_alpha && !material.base_color_map.present())
                parts[i].left_out = true;
            if (parts[i].part != HeadPart::clear || has_alpha) continue;
            if (!has_eye && parts[i].reason.starts_with("'cornea"))
                parts[i] = {HeadPart::eye, parts[i].reason + ", and no other eye"};
            else
                parts[i].left_out = true;
        }
    }

    const Mesh& mesh_;
    std::set<uint32_t> used_;
    bool scatters_ = false;
};

struct Look {
    Vec3 albedo_linear;
    float roughness;
};

// Plain colours of scenes/face.toml.
std::optional<Look> usual_look(HeadPart part, const std::string& name) {
    switch (part) {
        case HeadPart::eye:
            return names_iris(name) ? Look{{0.10f, 0.06f, 0.04f}, 0.12f} : Look{{0.72f, 0.68f, 0.65f}, 0.12f};
        case HeadPart::teeth:
            return Look{{0.80f, 0.74f, 0.62f}, 0.2f};
        case HeadPart::mouth:
            return Look{{0.55f, 0.18f, 0.16f}, 0.25f};
        case HeadPart::hair:
            return Look{{0.05f, 0.035f, 0.025f}, 0.5f};
        default:
            return std::nullopt;
    }
}

}  // namespace

std::vector<FoundPart> find_parts(const Mesh& mesh) {
    return Finder(mesh).run();
}

MaterialClass class_of(HeadPart part) {
    if (part == HeadPart::skin) return MaterialClass::skin;
    return part == HeadPart::translucent ? MaterialClass::translucent : MaterialClass::other;
}

void complete_material(const FoundPart& found, Material& material) {
    if (material.base_color_map.present() || material.base_color_stated) return;
    const std::optional<Look> look = usual_look(found.part, material.name);
    if (!look) return;
    material.base_color_linear = look->albedo_linear;
    material.roughness = look->roughness;
}

bool has_skin_color(const Material& material) {
    const Vec3 c = material.base_color_linear;
    const bool is_grey = std::max({c.x, c.y, c.z}) - std::min({c.x, c.y, c.z}) < 0.01f;
    return material.base_color_map.present() || (material.base_color_stated && !is_grey);
}

bool is_guessed(const std::vector<FoundPart>& parts) {
    return std::ranges::any_of(
        parts, [](const FoundPart& found) { return !found.reason.starts_with("the scene's"); });
}

std::string parts_note(const SceneObject& object) {
    std::map<std::string, std::vector<std::string>> names;
    for (const Submesh& submesh : object.mesh.submeshes) {
        const FoundPart& found = object.parts.at(submesh.material);
        std::vector<std::string>& of_part = names[found.left_out ? "left out" : part_name(found.part)];
        const std::string name = "'" + object.mesh.materials[submesh.material].name + "'";
        if (std::ranges::find(of_part, name) == of_part.end()) of_part.push_back(name);
    }
    if (names.empty() || (names.size() == 1 && names.contains(part_name(HeadPart::skin)))) return {};
    constexpr size_t kMostNames = 6;
    std::vector<std::string> groups;
    for (auto& [part, of_part] : names) {
        const size_t more = of_part.size() > kMostNames ? of_part.size() - kMostNames : 0;
        of_part.resize(of_part.size() - more);
        groups.push_back(part + " " + join(of_part, ", ") +
                         (more > 0 ? " and " + std::to_string(more) + " more" : ""));
    }
    return "'" + object.name + "': classes found by name: " + join(groups, "; ") +
           (names.contains(part_name(HeadPart::skin)) ? "" : "; no skin, so no technique draws any of it") +
           ". `dermis info` says why; class = under [material.NAME] of a scene file changes one";
}

}  // namespace dermis::inline scene
