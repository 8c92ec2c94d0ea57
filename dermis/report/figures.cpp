#include "dermis/report/figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/image/resample.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/plot/sheet.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"
#include "dermis/technique/gain.h"

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
    const std::string key = fmt::format("{}|{}|{}{}{}", name, cell.environment, cell.environment_yaw_deg,
                                        cell.environment_visible, int(cell.albedo));
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
    // The sources have no gain.
    ParameterValues values = without_gain(ParameterValues((*technique)->parameters));
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

namespace {

struct DrawnCell {
    std::string label;
    CellPicture picture;
};
using DrawnCells = std::map<std::string, DrawnCell>;

Image covered_by_both(const Image& a, const Image& b) {
    Image mask(a.width, a.height, 1, PixelFormat::u8);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            mask.set(x, y, 0, a.at(x, y, 3) >= 1 && b.at(x, y, 3) >= 1 ? 1.0f : 0.0f);
    return mask;
}

CellPicture difference_picture(const CellPicture& a, const CellPicture& b, float gain) {
    CellPicture picture = {Image(a.display.width, a.display.height, 3, PixelFormat::u8, Encoding::srgb),
                           Image(a.display.width, a.display.height, 4)};
    for (int y = 0; y < a.radiance.height; ++y)
        for (int x = 0; x < a.radiance.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float difference = std::abs(a.radiance.at(x, y, c) - b.radiance.at(x, y, c));
                picture.radiance.set(x, y, c, difference);
                picture.display.set(x, y, c, std::min(difference * gain, 1.0f));
            }
            picture.radiance.set(x, y, 3, 1);
        }
    return picture;
}

std::string difference_text(const CellDifference& difference, const std::string& to) {
    char text[160];
    std::snprintf(text, sizeof text, "mean |Δ| %.4f, max %.3f, FLIP %.3f", difference.mean_abs,
                  difference.max_abs, difference.flip);
    return std::string(text) + "  against " + to;
}

std::string full_label(const FigureRow& row, const FigureCell& cell) {
    return row.label.empty() ? cell.label : row.label + ", " + cell.label;
}

// The cell's picture, whatever its kind.
Result<CellPicture> make_picture(CellRenderer& renderer, const Figure& figure, const FigureCell& cell,
                                 CellSize size, const DrawnCells& drawn) {
    if (cell.kind != CellKind::difference) return renderer.draw(figure, cell, size);
    return difference_picture(drawn.at(cell.subject).picture, drawn.at(cell.compare_to).picture, cell.gain);
}

Result<void> compare(const FigureCell& cell, const CellPicture& picture, const DrawnCells& drawn,
                     CellReport& report) {
    if (cell.compare_to.empty()) return {};
    const DrawnCell& other = drawn.at(cell.compare_to);
    const CellPicture& subject = cell.kind == CellKind::difference ? drawn.at(cell.subject).picture : picture;
    DERMIS_TRY_ASSIGN(const CellDifference difference, compare_cells(subject, other.picture));
    report.compared_to = other.label;
    report.difference = difference;
    return {};
}

}  // namespace

Result<CellDifference> compare_cells(const CellPicture& a, const CellPicture& b) {
    const Image mask = covered_by_both(a.radiance, b.radiance);
    DERMIS_TRY_ASSIGN(const Image map, abs_difference_map(a.radiance, b.radiance));
    DERMIS_TRY_ASSIGN(const double max_abs, max_abs_error(a.radiance, b.radiance, mask));
    DERMIS_TRY_ASSIGN(const double flip, mean_flip(a.display, b.display, mask));
    double sum = 0;
    size_t count = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y, 0) > 0) {
                for (int c = 0; c < 3; ++c) sum += std::abs(a.radiance.at(x, y, c) - b.radiance.at(x, y, c));
                count += 3;
            }
    return CellDifference{.mean_abs = sum / double(count), .max_abs = max_abs, .flip = flip};
}

Result<std::vector<Figure>> figures_of(const Technique& technique, const std::string& only) {
    std::vector<Figure> figures = technique.figures ? technique.figures() : std::vector<Figure>{};
    if (figures.empty()) return Error{"technique '" + technique.id + "' has no figures"};
    for (Figure& figure : figures)
        if (figure.technique.empty()) figure.technique = technique.id;
    if (only.empty()) return figures;
    std::vector<std::string> ids;
    for (const Figure& figure : figures) {
        if (figure.id == only) return std::vector<Figure>{figure};
        ids.push_back(figure.id);
    }
    return Error{unknown_name("figure", only, ids)};
}

Result<FigureResult> draw_figure(CellRenderer& renderer, const Font& font, const Figure& figure, int size,
                                 const std::function<void()>& on_drawn) {
    if (const auto wrong = problems(figure); !wrong.empty()) return Error{wrong.front()};
    const CellSize cell_size = {std::max(1, int(std::lround(float(size) * figure.aspect))), size};
    FigureResult result;
    Sheet sheet = {.title = figure.title, .source = figure.source, .note = figure.note};
    DrawnCells drawn;
    for (const FigureRow& row : figure.rows) {
        sheet.rows.push_back({.label = row.label});
        for (const FigureCell& cell : row.cells) {
            DERMIS_TRY_ASSIGN(CellPicture picture, make_picture(renderer, figure, cell, cell_size, drawn));
            CellReport report = {.label = full_label(row, cell)};
            if (Result<void> compared = compare(cell, picture, drawn, report); !compared)
                return Error{"figure '" + figure.id + "', cell '" + cell.label +
                             "': " + compared.error().message};
            const std::string remark = picture.remark.empty() ? "" : " (" + picture.remark + ")";
            sheet.rows.back().cells.push_back(
                {.label = cell.label + remark,
                 .picture = picture.display,
                 .beneath = report.compared_to.empty()
                                ? ""
                                : difference_text(report.difference, report.compared_to)});
            if (!picture.credit.empty() &&
                std::ranges::find(result.credits, picture.credit) == result.credits.end())
                result.credits.push_back(picture.credit);
            if (!cell.id.empty()) drawn[cell.id] = {full_label(row, cell), std::move(picture)};
            result.cells.push_back(std::move(report));
            if (on_drawn) on_drawn();
        }
    }
    sheet.credits = result.credits;
    result.sheet = compose_sheet(sheet, font);
    return result;
}

}  // namespace dermis::inline report
