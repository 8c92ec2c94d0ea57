#include "dermis/scene/skin_pigments.h"

#include <cmath>
#include <string>
#include <utility>

#include "dermis/base/hash.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/optics/tissue/pigment_maps.h"
#include "dermis/scene/image_source.h"
#include "dermis/scene/skin_tone.h"

namespace dermis::inline scene {
namespace {

Result<Image> pigment_map(const ImageSource& source) {
    if (!source.present()) return Image{};
    return load_image_source(source, ImageUse::data);
}

bool has_pigment_maps(const Material& material) {
    return material.melanin_map.present() || material.blood_map.present();
}

// A subject's own maps of pigments belong to its own colour: the colour is painted again only for what
// changes the pigments, and never over another map.
bool has_own_pigments(const Material& material) {
    return !material.melanin_map.pixels.empty() && !material.blood_map.pixels.empty();
}
bool keeps_its_colour(const Material& material, const Skin& skin) {
    const bool changed = skin.melanin_scale != 1 || skin.blood_scale != 1 || skin.blood_moves();
    return has_own_pigments(material) &&
           (!changed || material.base_color_map.pixels.empty() || pigments_of(skin));
}

void remove_pigments(Skin& skin) {
    skin.melanin = skin.blood = skin.oxygen = {};
    skin.pheomelanin = skin.epidermis_mm = {};
}

// Another paint is another picture for what keeps pictures by name.
std::string name_of(const Image& painted) {
    Hasher hasher;
    hasher.add(std::span<const std::byte>(painted.bytes));
    return hasher.hex();
}

struct PigmentPainter {
    const Skin& skin;
    SkinModel model;
    PigmentTable table;

    // The mean pigments.
    Result<Pigments> paint(Material& material) const {
        PigmentMaps maps;
        Image mask;
        for (const auto& [source, image] :
             {std::pair{&material.melanin_map, &maps.melanin}, std::pair{&material.blood_map, &maps.blood},
              std::pair{&material.residue_map, &maps.residue}, std::pair{&material.pigment_mask, &mask}}) {
            DERMIS_TRY_ASSIGN(Image loaded, pigment_map(*source));
            *image = std::move(loaded);
        }
        if (maps.residue.empty() && has_own_pigments(material)) {
            DERMIS_TRY_ASSIGN(const Image own, load_image_source(material.base_color_map, ImageUse::color));
            add_residue(maps, own, table);
        }
        if (!maps.residue.empty() && maps.residue.channels < 3)
            return Error{material.residue_map.name + ": a residue has red, green and blue"};
        const PigmentPainting painting{
            .maps = &maps,
            .missing = {model.melanin, model.blood},
            .edit = {.melanin_scale = double(skin.melanin_scale), .blood_scale = double(skin.blood_scale)},
            .mask = mask.empty() ? nullptr : &mask};
        Image painted;
        {
            const Image& first = maps.melanin.empty() ? maps.blood : maps.melanin;
            Progress line("skin of pigments", first.pixel_count());
            Result<Image> made = albedo_of(painting, table, [&](size_t texels) { line.advance(texels); });
            if (!made) return made.error().within("material '" + material.name + "'");
            painted = std::move(*made);
        }
        const ImageSource& source =
            material.melanin_map.present() ? material.melanin_map : material.blood_map;
        material.base_color_map = {.name = source.name + " painted by pigments " + name_of(painted),
                                   .encoded = {},
                                   .width = painted.width,
                                   .height = painted.height,
                                   .channels = 3,
                                   .pixels = std::move(painted.bytes),
                                   .wrap_u = material.base_color_map.wrap_u,
                                   .wrap_v = material.base_color_map.wrap_v};
        material.base_color_linear = {1, 1, 1};
        return mean_pigments(painting);
    }
};

}  // namespace

std::optional<SkinModel> pigments_of(const Skin& skin) {
    SkinModel model;
    bool any = false;
    const auto take = [&](const std::optional<float>& given, double& value) {
        if (given)
            value = parse_number(to_text(*given)).value_or(*given), any = true;  // 0.03, not 0.0299999993
    };
    take(skin.melanin, model.melanin);
    take(skin.blood, model.blood);
    take(skin.oxygen, model.oxygen);
    take(skin.pheomelanin, model.pheomelanin);
    take(skin.epidermis_mm, model.epidermis_mm);
    return any ? std::optional(model) : std::nullopt;
}

Skin with_profile_of_pigments(Skin skin) {
    if (const auto model = pigments_of(skin); model && skin.profile == Skin{}.profile)
        skin.profile = skin_model_text(*model);
    return skin;
}

Result<void> apply_pigments(Scene& scene) {
    const std::optional<SkinModel> model = pigments_of(scene.skin);
    if (!model) return {};
    if (scene.skin.tone > 0)
        return Error{
            "skin.tone and skin.melanin, blood or oxygen state one colour twice; remove one of them"};
    const Result<Vec3> mean = mean_skin_albedo(scene);
    if (!mean) return mean.error().within("skin.melanin");
    const Rgb albedo = skin_albedo(*model);
    scene.skin.loaded_tint_linear =
        tint_towards({float(albedo[0]), float(albedo[1]), float(albedo[2])}, *mean);
    scene.skin.albedo_tint_linear = scene.skin.albedo_tint_linear * scene.skin.loaded_tint_linear;
    remove_pigments(scene.skin);
    return {};
}

Result<void> apply_pigment_maps(Scene& scene) {
    std::optional<PigmentPainter> painter;
    Pigments sum;
    int count = 0;
    for (SceneObject& object : scene.objects)
        for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
            Material& material = object.mesh.materials[i];
            if (object.classes[i] != MaterialClass::skin || !has_pigment_maps(material)) continue;
            if (keeps_its_colour(material, scene.skin)) continue;
            const SkinModel model = pigments_of(scene.skin).value_or(SkinModel{});
            if (!painter) painter.emplace(PigmentPainter{scene.skin, model, PigmentTable(model)});
            DERMIS_TRY_ASSIGN(const Pigments mean, painter->paint(material));
            for (const ImageSource* source :
                 {&material.melanin_map, &material.blood_map, &material.residue_map, &material.pigment_mask})
                if (source->present() && source->pixels.empty()) scene.files.emplace_back(source->name);
            sum.melanin += mean.melanin, sum.blood += mean.blood, ++count;
        }
    if (count == 0) {
        if (scene.skin.melanin_scale != 1 || scene.skin.blood_scale != 1)
            scene.warnings.emplace_back(
                "skin.melanin_scale and blood_scale have no effect without maps.melanin or maps.blood; those "
                "of "
                "the built-in head are not used beside skin.melanin or skin.blood");
        return {};
    }
    SkinModel model = painter->model;
    const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
    model.melanin = rounded(sum.melanin / count), model.blood = rounded(sum.blood / count);
    const bool chosen =
        scene.skin.profile == Skin{}.profile || scene.skin.profile == skin_model_text(painter->model);
    if (chosen) scene.skin.profile = skin_model_text(model);
    remove_pigments(scene.skin);
    return {};
}

}  // namespace dermis::inline scene
