#include "dermis/render/output.h"

#include <algorithm>
#include <iterator>

#include "dermis/base/text.h"

namespace dermis::inline render {
namespace {

Image channels_of(const Image& image, int first, int count) {
    Image part(image.width, image.height, count, PixelFormat::f32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < count; ++c) part.set(x, y, c, image.at(x, y, first + c));
    return part;
}

// Which channels of which G-buffer image make a layer, and an EXR of that view
// (shaders/renderer/gbuffer.frag).
struct GbufferLayer {
    const char* layer;
    std::string_view view;
    const char* image;
    int first, count;
};
constexpr GbufferLayer kGbufferLayers[] = {
    {"position_world_mm", "position", "gbuffer_position", 0, 3},
    {"distance_mm", "depth", "gbuffer_position", 3, 1},
    {"normal_world", "normal", "gbuffer_normal", 0, 3},
    {"curvature_per_mm", "curvature", "gbuffer_normal", 3, 1},
    {"tension", "tension", "gbuffer_normal", 3, 1},
    {"geometry_normal_world", "geometry_normal", "gbuffer_geometry", 0, 3},
    {"occlusion", "occlusion", "gbuffer_geometry", 3, 1},
    {"albedo_linear", "albedo", "gbuffer_albedo", 0, 3},
    {"roughness", "roughness", "gbuffer_albedo", 3, 1},
    {"uv", "uv", "gbuffer_light", 0, 2},
    {"n_dot_l", "n_dot_l", "gbuffer_light", 2, 1},
    {"shadow", "shadow", "gbuffer_light", 3, 1}};

Result<std::vector<ImageLayer>> collect_layers(Renderer& renderer, const Technique& technique,
                                               const ParameterValues& values, DrawSettings draw) {
    std::vector<ImageLayer> layers;
    const auto add = [&layers](std::string name, Result<Image> image) -> Result<void> {
        if (!image) return image.error();
        layers.push_back({std::move(name), std::move(*image)});
        return {};
    };
    draw.gbuffer = true;
    for (const char* view : {"final", "diffuse", "specular"}) {
        draw.view = view;
        DERMIS_TRY(renderer.draw(technique, values, draw));
        const bool beauty = draw.view == "final";
        DERMIS_TRY(add(beauty ? "" : view, renderer.radiance()));
    }
    const auto add_gbuffer = [&](const GbufferLayer& layer) -> Result<void> {
        DERMIS_TRY_ASSIGN(const Image image, renderer.read(layer.image));
        layers.push_back({layer.layer, channels_of(image, layer.first, layer.count)});
        return {};
    };
    for (const GbufferLayer& layer : kGbufferLayers)
        if (layer.view != kTensionView) DERMIS_TRY(add_gbuffer(layer));
    if (!renderer.has_tension()) return layers;
    draw.view = kTensionView;
    DERMIS_TRY(renderer.draw(technique, values, draw));
    DERMIS_TRY(add_gbuffer(*std::ranges::find(kGbufferLayers, kTensionView, &GbufferLayer::view)));
    return layers;
}

}  // namespace

Result<Image> linear_picture(Renderer& renderer, const std::string& view) {
    // Views of the G-buffer have no radiance: their numbers are what is written.
    const auto layer = std::ranges::find(kGbufferLayers, view, &GbufferLayer::view);
    if (layer == std::end(kGbufferLayers)) return renderer.radiance();
    DERMIS_TRY_ASSIGN(const Image image, renderer.read(layer->image));
    Image part = channels_of(image, layer->first, layer->count);
    if (layer->count != 2) return part;
    Image padded(part.width, part.height, 3, PixelFormat::f32);  // an EXR of two channels is grey and alpha
    for (size_t i = 0; i < part.pixel_count(); ++i)
        for (size_t c = 0; c < 2; ++c) padded.floats()[3 * i + c] = part.floats()[2 * i + c];
    return padded;
}

Result<Image> display_picture(Renderer& renderer, int png_bits) {
    Result<Image> display = renderer.display();
    if (!display) return display;
    Image picture = png_bits == 16 ? convert(channels_of(*display, 0, 3), PixelFormat::u16, Encoding::linear)
                                   : std::move(*display);
    picture.encoding = Encoding::srgb;  // the tone map pass encoded it
    return picture;
}

ImageText picture_text(const OutputSettings& settings) {
    ImageText text = {{"Software", "dermis"}, {"Description", settings.description}};
    if (!settings.credit.empty()) text["Copyright"] = settings.credit;
    return text;
}

Result<void> check_output(const std::filesystem::path& path, const OutputSettings& settings) {
    const std::string extension = to_lower(path.extension().string());
    if (extension != ".png" && extension != ".exr")
        return Error{path.string() + ": a picture is a .png or an .exr file"};
    if (settings.layers && extension != ".exr") return Error{path.string() + ": --layers needs an .exr file"};
    if (settings.png_bits != 8 && settings.png_bits != 16)
        return Error{"--bits " + std::to_string(settings.png_bits) + ": 8 or 16"};
    return {};
}

Result<void> write_output(Renderer& renderer, const Technique& technique, const ParameterValues& values,
                          const DrawSettings& draw, const std::filesystem::path& path,
                          const OutputSettings& settings) {
    const ImageText text = picture_text(settings);
    if (settings.layers) {
        DERMIS_TRY_ASSIGN(const std::vector<ImageLayer> layers,
                          collect_layers(renderer, technique, values, draw));
        return write_layered_exr(path, layers, text);
    }
    if (to_lower(path.extension().string()) == ".exr") {
        const Result<Image> picture = linear_picture(renderer, draw.view);
        return picture ? write_image(path, *picture, text) : picture.error();
    }
    const Result<Image> picture = display_picture(renderer, settings.png_bits);
    return picture ? write_image(path, *picture, text) : picture.error();
}

}  // namespace dermis::inline render
