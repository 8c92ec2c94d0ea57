#include "dermis/scene/new_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/scene/part_words.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/scene/toml_values.h"

namespace dermis::inline scene {
namespace fs = std::filesystem;
namespace {

struct MapWords {
    const char* key;
    ImageSource Material::*map;
    std::vector<std::string_view> words;
};

const std::vector<MapWords>& map_words() {
    static const std::vector<MapWords> kWords = {
        {"albedo",
         &Material::base_color_map,
         {"albedo", "basecolor", "basecolour", "diffuse", "color", "colour", "diff", "col", "bc", "d"}},
        {"normal", &Material::normal_map, {"normal", "normals", "nrm", "nor", "normalgl", "n"}},
        {"roughness", &Material::roughness_map, {"roughness", "rough", "r"}},
        {"specular", &Material::specular_map, {"specular", "spec", "s"}},
        {"occlusion", &Material::occlusion_map, {"occlusion", "ao", "ambientocclusion"}},
        {"thickness", &Material::thickness_map, {"thickness"}}};
    return kWords;
}

// Words between signs and digits, in lower case; "base" and "color" are joined.
std::vector<std::string> plain_words(std::string_view stem) {
    std::vector<std::string> words(1);
    for (const char c : to_lower(stem))
        if (c >= 'a' && c <= 'z')
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    std::erase(words, "");
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (words[i] == "base" || words[i] == "ambient") words[i] += words[i + 1];
    return words;
}

const MapWords* kind_of(std::string_view stem) {
    const std::vector<std::string> words = plain_words(stem);
    // A map of normals in object space needs the mesh's own axes.
    if (std::ranges::find(words, "object") != words.end()) return nullptr;
    // "head_n" is a map of normals, "n" may be anything.
    if (words.size() == 1 && words[0].size() == 1) return nullptr;
    for (const MapWords& kind : map_words())
        for (const std::string& word : words)
            if (std::ranges::find(kind.words, word) != kind.words.end()) return &kind;
    return nullptr;
}

// Images of the mesh's folder and of textures/ and maps/ in it, in the order of their names.
std::vector<fs::path> images_beside(const fs::path& mesh) {
    constexpr std::array<std::string_view, 4> kExtensions = {".png", ".jpg", ".jpeg", ".exr"};
    constexpr size_t kMost = 1000;
    std::vector<fs::path> images;
    const fs::path folder = mesh.has_parent_path() ? mesh.parent_path() : fs::path(".");
    for (const fs::path& place : {folder, folder / "textures", folder / "maps"}) {
        std::error_code ec;
        for (const fs::directory_entry& entry : fs::directory_iterator(place, ec))
            if (images.size() < kMost &&
                std::ranges::count(kExtensions, to_lower(entry.path().extension().string())) > 0)
                images.push_back(entry.path());
    }
    std::ranges::sort(images);
    return images;
}

std::string triple(Vec3 v) {
    const auto number = [](float x) { return to_text(std::round(x * 1000) / 1000); };
    return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

class Writer {
  public:
    Writer(const Scene& scene, const fs::path& mesh, const fs::path& output)
        : scene_(scene), object_(scene.objects.front()), mesh_(mesh), output_(output) {}

    Result<NewScene> run() {
        find_images();
        write_head();
        DERMIS_TRY(write_skin());
        write_materials();
        write_lights();
        write_camera();
        return std::move(made_);
    }

  private:
    void line(const std::string& text) { made_.toml += text + "\n"; }
    void take(const std::string& text) { made_.taken.push_back(text); }

    [[nodiscard]] std::string relative(const fs::path& path) const {
        std::error_code ec;
        const fs::path base = output_.has_parent_path() ? output_.parent_path() : fs::path(".");
        const fs::path found = fs::relative(path, base, ec);
        return (ec || found.empty() ? fs::absolute(path) : found).generic_string();
    }

    [[nodiscard]] bool any_skin(const auto& holds) const {
        for (const Submesh& submesh : object_.mesh.submeshes)
            if (object_.classes[submesh.material] == MaterialClass::skin &&
                holds(object_.mesh.materials[submesh.material]))
                return true;
        return false;
    }

    // Images that name no other part are the skin's, unless the mesh file has such a map.
    void find_images() {
        const bool has_any = any_skin([](const Material&) { return true; });
        for (const fs::path& image : images_beside(mesh_)) {
            const std::string stem = image.stem().string();
            const MapWords* kind = kind_of(stem);
            const auto part = part_of_name(stem);
            if (!kind || !has_any || (part && part->part != HeadPart::skin)) continue;
            const auto has = [&](const Material& m) { return (m.*kind->map).present(); };
            if (!any_skin(has)) maps_.try_emplace(kind->key, image);
        }
    }

    void write_head() {
        line("# A scene of " + toml_string(mesh_.filename().string()) + "; `dermis keys` prints every key.");
        line("name = " + toml_string(mesh_.stem().string()));
        line("# Who made the head, under which licence: written with every picture.");
        line("credit = \"\"");
        line(fmt::format("exposure_ev = {}\n", scene_.exposure_ev));
        line("[[mesh]]\nfile = " + toml_string(relative(mesh_)));
        line(fmt::format("unit_mm = {}  # one unit of the file; 10 is a centimetre, 1000 a metre\n",
                         to_text(object_.unit_mm)));
        take("unit: " + to_text(object_.unit_mm) + " mm");
    }

    Result<void> write_skin() {
        if (!maps_.empty()) {
            line("# Images beside the mesh, found by their names.\n[maps]");
            for (const auto& [key, image] : maps_) {
                line(key + " = " + toml_string(relative(image)));
                take(key + ": " + image.filename().string());
            }
            line("");
        }
        line("[skin]");
        DERMIS_TRY(write_tone());
        line(fmt::format("ior = {}\nroughness = {}\n", scene_.skin.ior, scene_.skin.roughness));
        return {};
    }

    Result<void> write_tone() {
        if (scene_.skin.profile != Skin{}.profile) {
            line("profile = " + toml_string(scene_.skin.profile));
            return {};
        }
        if (!any_skin([](const Material&) { return true; })) return {};
        Scene with_map = {.name = scene_.name, .objects = {object_}};
        if (const auto albedo = maps_.find("albedo"); albedo != maps_.end())
            for (Material& material : with_map.objects[0].mesh.materials) {
                material.base_color_map = {.name = albedo->second.string(), .encoded = {}};
                material.base_color_linear = {1, 1, 1};
            }
        DERMIS_TRY_ASSIGN(const Vec3 mean, mean_skin_albedo(with_map));
        const int tone = nearest_tone(mean);
        line("# 1 is light, 6 dark; by the mean colour of the skin, " + triple(mean) +
             ". tone = N makes the colour that of a tone.");
        line("profile = " + toml_string(tone_profile(tone)));
        take("profile: " + tone_profile(tone) + ", by the skin's mean colour " + triple(mean));
        return {};
    }

    static int nearest_tone(Vec3 albedo_linear) {
        const auto distance = [&](int tone) {
            return std::abs(std::log(luminance(skin_tone_albedo_linear(tone)) /
                                     std::max(luminance(albedo_linear), 1e-4f)));
        };
        int nearest = 1;
        for (int tone = 2; tone <= 6; ++tone)
            if (distance(tone) < distance(nearest)) nearest = tone;
        return nearest;
    }

    void write_materials() {
        std::set<std::string> written;
        std::map<std::string, int> counts;
        for (size_t i = 0; i < object_.mesh.materials.size(); ++i) {
            const Material& material = object_.mesh.materials[i];
            if (!written.insert(material.name).second) continue;
            const FoundPart& found = object_.parts.at(i);
            line("[material." + toml_string(material.name) + "]");
            line("class = " + toml_string(part_name(found.part)) + "  # " + printable_line(found.reason));
            if (found.left_out) line("visible = false  # the file has no alpha for it");
            const bool is_skin = object_.classes[i] == MaterialClass::skin;
            if (is_skin)
                line(
                    "# profile = \"openpbr_skin_3\"  # of its own; scatter = 0 for nails and make-up, 1 for "
                    "skin");
            const bool mapped = material.base_color_map.present() || (is_skin && maps_.contains("albedo"));
            if (!found.left_out && !mapped && object_.mesh.colors_linear.empty()) {
                line("albedo = " + triple(material.base_color_linear));
                if (!is_skin) line("roughness = " + to_text(material.roughness));
            }
            line("");
            ++counts[found.left_out ? "left out" : part_name(found.part)];
        }
        std::vector<std::string> texts;
        for (const auto& [name, count] : counts) texts.push_back(std::to_string(count) + " " + name);
        take("materials: " + join(texts, ", "));
    }

    void write_lights() {
        line("# Key from the left, fill from the right, rim from behind.");
        line(
            "[[light]]\nname = \"key\"\nkey = true\ncolor = [1, 0.93, 0.84]\nintensity = 3\nyaw_deg = -45\n"
            "pitch_deg = 30\n");
        line(
            "[[light]]\nname = \"fill\"\ncolor = [0.85, 0.92, 1]\nintensity = 0.5\nyaw_deg = 55\n"
            "pitch_deg = 5\n");
        line("[[light]]\nname = \"rim\"\nintensity = 1.5\nyaw_deg = 150\npitch_deg = 35\n");
        line("[environment]\nkind = \"studio\"\nintensity = 0.6\n");
    }

    struct Face {
        Vec3 center_mm;
        float height_mm;
    };

    // Around the eyes; else the top of a person, or all of a head.
    [[nodiscard]] Face find_face() const {
        constexpr float kHeadHeight_mm = 300, kBelowEyes_mm = 30, kPerson_mm = 500;
        const Mesh& mesh = object_.mesh;
        Vec3 low = {INFINITY, INFINITY, INFINITY}, high = -low, eyes;
        size_t count = 0;
        for (const Submesh& submesh : mesh.submeshes)
            for (uint32_t i = 0; i < submesh.index_count; ++i) {
                const Vec3 p = mesh.positions_mm[mesh.indices[submesh.first_index + i]];
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
                if (object_.parts.at(submesh.material).part == HeadPart::eye) eyes += p, ++count;
            }
        if (count > 0) {
            const Vec3 middle = eyes * (1 / float(count));
            return {middle - Vec3{0, kBelowEyes_mm, 0}, kHeadHeight_mm};
        }
        const Vec3 center = (low + high) * 0.5f;
        if (high.y - low.y <= kPerson_mm) return {center, 1.15f * (high.y - low.y)};
        return {{center.x, high.y - 0.45f * kHeadHeight_mm, center.z}, kHeadHeight_mm};
    }

    void write_camera() {
        constexpr float kFov_deg = 21, kHalf_rad = kFov_deg / 2 * 0.01745329f;
        const Face face = find_face();
        const Vec3 c = face.center_mm;
        line("# Centred on the face.\n[camera]");
        line("target_mm = " + triple({std::round(c.x), std::round(c.y), std::round(c.z)}));
        line("yaw_deg = 12\npitch_deg = 2");
        line(fmt::format("distance_mm = {:.0f}\nfov_deg = {}",
                         std::max(face.height_mm / 2 / std::tan(kHalf_rad), 1.0f), kFov_deg));
    }

    const Scene& scene_;
    const SceneObject& object_;
    const fs::path mesh_, output_;
    std::map<std::string, fs::path> maps_;
    NewScene made_;
};

}  // namespace

Result<NewScene> new_scene(const Scene& scene, const fs::path& mesh, const fs::path& output) {
    if (scene.objects.empty() || scene.objects.front().parts.empty())
        return Error{mesh.string() + ": has no materials of a mesh file"};
    return Writer(scene, mesh, output).run();
}

}  // namespace dermis::inline scene
