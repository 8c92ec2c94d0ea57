// render() and reference(): pictures of a scene as arrays and as files.

#include <algorithm>

#include "arrays.h"
#include "catalog/catalog.h"
#include "dermis/jobs/picture_file.h"
#include "dermis/render/output.h"
#include "kept_device.h"
#include "module.h"
#include "reference_options.h"
#include "render_frames.h"
#include "scene_arguments.h"

namespace dermis::python {
namespace {

// ---- render
// --------------------------------------------------------------------------------------------------

struct RenderedPicture {
    Image linear, display;  ///< f16 or f32; u8 or u16
    OutputSettings file;
    std::vector<std::string> warnings;
    std::string technique;
};

Result<RenderedPicture> draw(Renderer& renderer, const cli::Prepared& prepared, int bits) {
    DERMIS_TRY(renderer.draw(*prepared.technique, *prepared.values, prepared.draw));
    Result<Image> linear = linear_picture(renderer, prepared.draw.view);
    if (!linear) return linear.error();
    Result<Image> display = display_picture(renderer, bits);
    if (!display) return display.error();
    RenderedPicture picture{.linear = std::move(*linear),
                            .display = std::move(*display),
                            .file = {.png_bits = bits,
                                     .credit = prepared.scene.credit,
                                     .description = prepared.scene.name + ", " + prepared.technique->id},
                            .warnings = prepared.scene.warnings,
                            .technique = prepared.technique->id};
    picture.warnings.insert(picture.warnings.end(), renderer.warnings().begin(), renderer.warnings().end());
    return picture;
}

// Without a number of frames one picture.
Result<std::vector<RenderedPicture>> draw_all(const cli::RenderOptions& options,
                                              const cli::RenderFrames& frames, int bits, Watch& watch) {
    DERMIS_TRY_ASSIGN(cli::Prepared prepared, cli::prepare(options));
    prepared.draw.deep = bits == 16;
    const Result<LentDevice> device = lend_device(options.device);
    if (!device) return device.error();
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(device->device(), gpu::embedded_shaders(built_in_catalog().shaders),
                                       prepared.scene));
    const Scene start = without_objects(prepared.scene);
    std::vector<RenderedPicture> pictures;
    for (int i = 0; i < frames.count && !watch.stopped(); ++i) {
        DERMIS_TRY(cli::show_frame(frames, i, start, prepared.scene, renderer));
        DERMIS_TRY_ASSIGN(RenderedPicture drawn, draw(renderer, prepared, bits));
        pictures.push_back(std::move(drawn));
        watch.report(double(pictures.size()) / frames.count);
    }
    return pictures;
}

cli::RenderFrames frames_of(const cli::RenderOptions& options, const py::dict& given) {
    cli::RenderFrames frames;
    take(frames.count, given, "frames");
    take(frames.fps, given, "fps");
    take(frames.turn_deg, given, "turn");
    check(cli::check_number("--fps", frames.fps, cli::kFpsRange));
    check(cli::check_number("--turn", frames.turn_deg, cli::kTurnRangeDeg));
    const bool has_frames = given.contains("frames"), turns = frames.turn_deg != 0, moves = frames.fps > 0;
    if (has_frames) check(cli::check_number("--frames", frames.count, cli::kRenderFramesRange));
    if (turns && !has_frames)
        throw Failure({"turn is the camera's over all frames; give frames: turn=360, frames=96"});
    if (has_frames != (turns || moves) || (moves && options.scene.pose.clip.empty()))
        throw Failure({"frames of a clip need clip, frames and fps: clip='talk', frames=96, fps=24"});
    return frames;
}

std::vector<RenderedPicture> render(const SceneArguments& scene, const std::string& technique,
                                    const std::vector<std::string>& settings, const py::dict& given,
                                    const py::object& progress) {
    cli::RenderOptions options{.scene = scene_choice(scene), .technique = technique, .settings = settings};
    int bits = 8;
    take(bits, given, "bits");
    take(options.size, given, "size");
    take(options.view, given, "view");
    take(options.device, given, "device");
    take(options.samples, given, "samples");
    if (bits != 8 && bits != 16) throw Failure({"--bits " + std::to_string(bits) + ": 8 or 16"});
    const cli::RenderFrames frames = frames_of(options, given);
    return watched(progress, [&](Watch& watch) { return draw_all(options, frames, bits, watch); });
}

// The same file as `dermis render -o PATH` writes.
void write_rendered(const RenderedPicture& picture, const std::string& path) {
    check(check_output(path, picture.file));
    const bool linear = std::filesystem::path(path).extension() != ".png";
    check(unlocked([&] {
        return write_image(path, linear ? picture.linear : picture.display, picture_text(picture.file));
    }));
}

// ---- reference
// -----------------------------------------------------------------------------------------------

struct MadeReference {
    ReferencePicture picture;
    PictureFacts facts;
};

// Options of the command line by their names; what is absent keeps its default.
cli::ReferenceOptions options_of(const SceneArguments& scene, const py::dict& given) {
    cli::ReferenceOptions options;
    options.scene = scene_choice(scene);
    take(options.size, given, "size");
    take(options.integrator, given, "integrator");
    take(options.profile, given, "profile");
    take(options.medium, given, "medium");
    take(options.normalisation, given, "normalisation");
    take(options.cavities, given, "cavities");
    take(options.filter, given, "filter");
    take(options.shadows, given, "shadows");
    take(options.ambient, given, "ambient");
    take(options.specular, given, "specular");
    take(options.samples, given, "samples");
    take(options.probes, given, "probes");
    take(options.seed, given, "seed");
    take(options.noise, given, "noise");
    take(options.width_scale, given, "width_scale");
    take(options.penumbra_mm, given, "penumbra_mm");
    return options;
}

MadeReference reference(const SceneArguments& scene, const py::dict& given, const py::object& progress) {
    const cli::ReferenceOptions options = options_of(scene, given);
    const ReferenceSettings settings = value_of(options.settings());
    return watched(progress, [&](Watch& watch) -> Result<MadeReference> {
        DERMIS_TRY_ASSIGN(const Scene loaded, options.load_scene());
        DERMIS_TRY_ASSIGN(ReferencePicture picture,
                          render_reference(
                              loaded, settings, [&](double done) { watch.report(done); }, &watch.stopped()));
        return MadeReference{std::move(picture), options.facts(settings, loaded)};
    });
}

// The same files as `dermis reference -o PATH --preview PREVIEW` writes.
void write_reference(const MadeReference& made, const std::string& path, const std::string& preview) {
    check(check_outputs(value_of(picture_files(path, preview))));
    check(unlocked([&] {
        return write_picture_file(path, made.facts, made.picture, described(made.facts, made.picture, false));
    }));
    if (!preview.empty())
        check(unlocked([&] { return write_preview_file(preview, made.facts, made.picture); }));
}

py::array layer(const py::object& self, const std::string& name) {
    const ReferencePicture& picture = self.cast<const MadeReference&>().picture;
    const std::pair<std::string_view, const Image*> layers[] = {
        {"radiance", &picture.radiance}, {"diffuse", &picture.diffuse}, {"specular", &picture.specular},
        {"variance", &picture.variance}, {"samples", &picture.samples}, {"skin", &picture.skin}};
    return view_of(
        *std::ranges::find(layers, std::string_view(name), &std::pair<std::string_view, const Image*>::first)
             ->second,
        self);
}

}  // namespace

void add_pictures(py::module_& module) {
    py::class_<RenderedPicture>(module, "Picture")
        .def_property_readonly("linear",
                               [](const RenderedPicture& picture) { return array_of(picture.linear); })
        .def_property_readonly(
            "display",
            [](const py::object& self) { return view_of(self.cast<const RenderedPicture&>().display, self); })
        .def_property_readonly("credit", [](const RenderedPicture& picture) { return picture.file.credit; })
        .def_readonly("technique", &RenderedPicture::technique)
        .def_readonly("warnings", &RenderedPicture::warnings);
    module.def("render", render);
    py::module_::import("atexit").attr("register")(py::cpp_function(close_kept_device));
    module.def("write_rendered", write_rendered);
    py::class_<MadeReference>(module, "ReferencePicture")
        .def_property_readonly(
            "description",
            [](const MadeReference& made) { return described(made.facts, made.picture, false); })
        .def_property_readonly("credit", [](const MadeReference& made) { return made.facts.credit; })
        .def_property_readonly("time_ms", [](const MadeReference& made) { return made.picture.time_ms; });
    module.def("reference", reference);
    module.def("reference_layer", layer);
    module.def("write_reference", write_reference);
}

}  // namespace dermis::python
