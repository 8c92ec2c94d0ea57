#include "dermis/judge/technique_pictures.h"

#include <algorithm>

#include "dermis/image/resample.h"
#include "dermis/judge/captured.h"

namespace dermis::inline judge {

Result<Image> PictureMaker::draw(const Technique& technique, const ParameterValues& values) {
    const DrawSettings draw{.width = settings_.width * settings_.grid,
                            .height = settings_.height * settings_.grid,
                            .deep = true,
                            .shadow_map_size = settings_.shadow_map_size,
                            .penumbra_mm = settings_.penumbra_mm};
    DERMIS_TRY(renderer_.draw(technique, values, draw));
    DERMIS_TRY_ASSIGN(const Image radiance, renderer_.radiance());
    return resize(to_linear_float(radiance), settings_.width, settings_.height);
}

Result<const Image*> PictureMaker::baseline_beside(const Contestant& contestant) {
    ParameterValues values(baseline_.parameters);
    std::string key;
    for (const Parameter& parameter : baseline_.parameters.parameters) {
        const Parameter* same = contestant.values.table().find(parameter.name);
        if (!same) continue;
        const std::string text = contestant.values.text(*same);
        DERMIS_TRY(values.set(parameter.name, text));
        key += parameter.name + "=" + text + "\n";
    }
    if (const auto found = baseline_pictures_.find(key); found != baseline_pictures_.end())
        return &found->second;
    Result<Image> picture = draw(baseline_, values);
    if (!picture) return Error{baseline_.id + ": " + picture.error().message};
    return &baseline_pictures_.emplace(key, std::move(*picture)).first->second;
}

Result<TechniquePictures> PictureMaker::make(const Contestant& contestant) {
    return make(contestant, *this);
}

Result<TechniquePictures> PictureMaker::make(const Contestant& contestant, PictureMaker& drawn_by) {
    DERMIS_TRY_ASSIGN(const Image* baseline, baseline_beside(contestant));
    // The baseline itself is drawn once, so that its effect is 0 and no rounding.
    Result<Image> radiance = contestant.technique->id == baseline_.id
                                 ? Result<Image>(*baseline)
                                 : drawn_by.draw(*contestant.technique, contestant.values);
    if (!radiance) return Error{contestant.name() + ": " + radiance.error().message};
    TechniquePictures pictures{.effect = difference(*radiance, *baseline)};
    pictures.radiance = std::move(*radiance);
    return pictures;
}

Result<SkinMasks> PictureMaker::masks(const Image& skin) {
    const DrawSettings draw{.width = settings_.width * settings_.grid,
                            .height = settings_.height * settings_.grid,
                            .gbuffer = true,
                            .shadow_map_size = settings_.shadow_map_size,
                            .penumbra_mm = kPenumbraBandMm};
    DERMIS_TRY(renderer_.draw(baseline_, ParameterValues(baseline_.parameters), draw));
    DERMIS_TRY_ASSIGN(const Image light, renderer_.read("gbuffer_light"),
                      position = renderer_.read("gbuffer_position"));
    if (!position) return position.error();
    Image covered(position->width, position->height, 1);
    const Image position_float = to_linear_float(*position);
    for (size_t i = 0; i < covered.pixel_count(); ++i)
        covered.floats()[i] = position_float.floats()[4 * i + 3] > 0 ? 1 : 0;
    SkinMasks masks = make_masks(resize(to_linear_float(light), skin.width, skin.height),
                                 resize(covered, skin.width, skin.height), skin);
    if (std::ranges::none_of(masks.skin.floats(), [](float v) { return v > 0; }))
        return Error{"no pixel shows skin: nothing to compare (see the scene's materials and camera)"};
    return masks;
}

}  // namespace dermis::inline judge
