#include "dermis/report/cell_renderer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "dermis/image/colour.h"
#include "dermis/image/resample.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"

namespace dermis::inline report {
namespace {

constexpr size_t kStages = 3;

// The environment a cell asks for, and what the label has to add.
struct ChosenEnvironment {
    Environment environment;
    std::string remark;
};

ChosenEnvironment choose_environment(const Environment& own, const FigureCell& cell) {
    constexpr float kDegree = 3.14159265f / 180;
    ChosenEnvironment chosen = {own, ""};
    Environment& environment = chosen.environment;
    environment.yaw_rad += cell.environment_yaw_deg * kDegree;
    environment.visible = cell.environment_visible;
    if (cell.environment == "none") environment.kind = EnvironmentKind::none;
    if (cell.environment == "studio") environment.kind = EnvironmentKind::studio;
    if (cell.environment.empty() || cell.environment == "none" || cell.environment == "studio") return chosen;
    if (const auto file = resolve_path(cell.environment, {})) {
        environment.kind = EnvironmentKind::file;
        environment.file = *file;
        return chosen;
    }
    environment.kind = EnvironmentKind::studio;
    environment.yaw_rad += 180 * kDegree;
    chosen.remark = "studio turned: no " + std::filesystem::path(cell.environment).filename().string();
    return chosen;
}

Result<Scene> load_figure_scene(const std::string& name, const SceneOptions& options) {
    if (name != kHeadScene) return load_scene(name, options);
    Result<Scene> scan = load_scene("head_scan", options);
    return scan ? std::move(scan) : load_scene("bust", options);
}

void make_white(Scene& scene) {
    for (SceneObject& object : scene.objects)
        for (size_t i = 0; i < object.mesh.materials.size(); ++i)
            if (object.classes[i] == MaterialClass::skin) {
                object.mesh.materials[i].base_color_map = {};
                object.mesh.materials[i].base_color_linear = {1, 1, 1};
            }
}

// The camera keeps its direction and angle; the object's bounding sphere just fits the height of the picture.
Result<void> look_at_object(Scene& scene, const std::string& name, float aspect) {
    const auto found = std::ranges::find(scene.objects, name, &SceneObject::name);
    if (found == scene.objects.end()) return Error{"the scene has no object '" + name + "'"};
    Scene alone;
    alone.objects = {*found};
    compute_bounds(alone);
    const Vec3 away = normalize(scene.camera.eye_mm - scene.camera.target_mm);
    const float half_angle = scene.camera.vertical_fov_rad / 2;
    const float distance_mm = 1.08f * alone.bounds_radius_mm / std::sin(half_angle) / std::min(aspect, 1.0f);
    scene.camera.target_mm = alone.bounds_center_mm;
    scene.camera.eye_mm = alone.bounds_center_mm + away * distance_mm;
    return {};
}

Result<void> place_camera_and_light(Scene& scene, const FigureCell& cell, float aspect) {
    DERMIS_TRY(set_section(scene, "camera", cell.camera));
    if (!cell.object.empty()) DERMIS_TRY(look_at_object(scene, cell.object, aspect));
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    return set_section(scene, "light.key", cell.light);
}

Image three_channels(const Image& image) {
    Image out(image.width, image.height, 3, PixelFormat::u8, Encoding::srgb);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) out.set(x, y, c, image.at(x, y, c));
    return out;
}

// Linear numbers as a cell: stretched to its size, encoded or not.
CellPicture picture_of(const Image& linear, CellEncoding encoding, CellSize size) {
    const Image sized = resize(linear, size.width, size.height);
    CellPicture picture = {Image(size.width, size.height, 3, PixelFormat::u8, Encoding::srgb),
                           Image(size.width, size.height, 4)};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float value = sized.at(x, y, c);
                picture.radiance.set(x, y, c, value);
                picture.display.set(x, y, c, encoding == CellEncoding::srgb ? srgb_encode(value) : value);
            }
            picture.radiance.set(x, y, 3, 1);
        }
    return picture;
}

Result<Image> table_image(const Technique& technique, const ParameterValues& values, const std::string& name,
                          const SkinContext& skin) {
    if (!technique.tables) return Error{technique.id + " bakes no tables"};
    DERMIS_TRY_ASSIGN(const std::vector<TableImage> tables, technique.tables(values, skin));
    const auto table = std::ranges::find(tables, name, &TableImage::name);
    if (table == tables.end()) return Error{technique.id + " bakes no table '" + name + "'"};
    if (table->format != ImageFormat::rgba32f) return Error{name + ": only 32-bit float tables can be shown"};
    Image image(table->width, table->height, 4);
    image.bytes = table->bytes;
    return image;
}

Result<CellPicture> computed_picture(const FigureCell& cell, const SkinContext& skin, CellSize size) {
    DERMIS_TRY_ASSIGN(const FigurePicture made, cell.compute(skin, size.width, size.height));
    Image image(made.width, made.height, 3);
    std::ranges::copy(made.rgb_linear, image.floats().begin());
    return picture_of(image, cell.encoding, size);
}

// An image of the frame, as the cell wants it shown; light as the radiance of white skin.
Result<CellPicture> frame_image(Renderer& renderer, const FigureCell& cell, CellSize size) {
    DERMIS_TRY_ASSIGN(const Image read, renderer.read(cell.image));
    const Image linear = to_linear_float(read);
    Image shown(linear.width, linear.height, 3);
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const bool alpha = cell.image_channels == FigureImageChannels::alpha;
                const float value =
                    linear.at(x, y, alpha ? linear.channels - 1 : std::min(c, linear.channels - 1));
                shown.set(x, y, c,
                          cell.image_channels == FigureImageChannels::transmittance ? std::exp(-value)
                          : alpha                                                   ? value
                                                                                    : value / 3.14159265f);
            }
    return picture_of(shown, cell.encoding, size);
}

}  // namespace

/// A scene on the device; cells move its camera and lights and put them back.
struct CellRenderer::Stage {
    Scene scene;
    std::string remark;
    std::unique_ptr<Renderer> renderer;
};

CellRenderer::CellRenderer(gpu::Device& device, const Catalog& catalog, Options options)
    : device_(&device), catalog_(catalog), options_(std::move(options)) {}
CellRenderer::CellRenderer(CellRenderer&&) noexcept = default;
CellRenderer::~CellRenderer() = default;

Result<CellRenderer::Stage*> CellRenderer::stage(const Figure& figure, const FigureCell& cell) {
    std::string name = !cell.scene.empty() ? cell.scene : figure.scene;
    if (!options_.scene.empty() && !figure.only_in_its_scene) name = options_.scene;
    const std::string key = name + "|" + cell.environment + "|" + std::to_string(cell.environment_yaw_deg) +
                            std::to_string(cell.environment_visible) + std::to_string(int(cell.albedo));
    if (const auto found = stages_.find(key); found != stages_.end()) return found->second.get();
    if (stages_.size() >= kStages) stages_.clear();

    DERMIS_TRY_ASSIGN(Scene scene, load_figure_scene(name, {.subjects = catalog_.subjects,
                                                            .words = options_.loading_words}));
    DERMIS_TRY(complete_scene(scene));
    if (cell.albedo == CellAlbedo::white) make_white(scene);
    const ChosenEnvironment chosen = choose_environment(scene.environment, cell);
    scene.environment = chosen.environment;
    DERMIS_TRY(set_words(scene, options_.words));
    auto made = std::make_unique<Stage>(Stage{.scene = std::move(scene), .remark = chosen.remark});
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(*device_, gpu::embedded_shaders(catalog_.shaders), made->scene));
    made->renderer = std::make_unique<Renderer>(std::move(renderer));
    return stages_.emplace(key, std::move(made)).first->second.get();
}

Result<CellPicture> CellRenderer::draw_scene(const Technique& technique, const ParameterValues& values,
                                             const FigureCell& cell, Stage& stage, CellSize size) {
    const Camera camera = stage.scene.camera;
    const std::vector<Light> lights = stage.scene.lights;
    DERMIS_TRY(place_camera_and_light(stage.scene, cell, float(size.width) / float(size.height)));
    const auto drawn = stage.renderer->draw(technique, values,
                                            {.width = size.width,
                                             .height = size.height,
                                             .samples = options_.samples,
                                             .view = cell.view,
                                             .deep = true});
    stage.scene.camera = camera;
    stage.scene.lights = lights;
    if (!drawn) return drawn.error();
    if (!cell.image.empty()) {
        Result<CellPicture> shown = frame_image(*stage.renderer, cell, size);
        if (shown) shown->remark = stage.remark, shown->credit = stage.scene.credit;
        return shown;
    }
    DERMIS_TRY_ASSIGN(const Image display, stage.renderer->display());
    CellPicture picture = {
        .display = three_channels(display), .remark = stage.remark, .credit = stage.scene.credit};
    const auto& views = gbuffer_views();
    if (std::ranges::find(views, cell.view) != views.end()) {
        picture.radiance = picture_of(to_linear_float(picture.display), CellEncoding::srgb, size).radiance;
        return picture;
    }
    DERMIS_TRY_ASSIGN(Image radiance, stage.renderer->radiance());
    picture.radiance = to_linear_float(radiance);
    return picture;
}

Result<CellPicture> CellRenderer::draw(const Figure& figure, const FigureCell& cell, CellSize size) {
    const std::string id = !cell.technique.empty() ? cell.technique : figure.technique;
    const auto within = [&](const std::string& message) {
        return Error{"figure '" + figure.id + "', cell '" + cell.label + "': " + message};
    };
    const Result<const Technique*> technique = find_technique(catalog_.techniques, id);
    if (!technique) return within(technique.error().message);
    ParameterValues values((*technique)->parameters);
    for (const auto& [name, text] : cell.settings)
        if (Result<void> set = values.set(name, text); !set) return within(set.error().message);

    Result<CellPicture> picture = Error{""};
    if (cell.kind == CellKind::render) {
        const Result<Stage*> ready = stage(figure, cell);
        if (!ready) return within(ready.error().message);
        picture = draw_scene(**technique, values, cell, **ready, size);
    } else {
        const Profile profile = *find_profile(Skin{}.profile);
        const SkinContext skin = {.profile = profile, .gaussians = to_gaussian_sum(profile).sum};
        if (cell.kind == CellKind::computed) {
            picture = computed_picture(cell, skin, size);
        } else {
            const Result<Image> table = table_image(**technique, values, cell.table, skin);
            picture = table ? Result<CellPicture>(picture_of(*table, cell.encoding, size)) : table.error();
        }
    }
    if (!picture) return within(picture.error().message);
    return picture;
}

}  // namespace dermis::inline report
