// compare(): techniques against the reference.

#include <nlohmann/json.hpp>

#include "arrays.h"
#include "catalog/catalog.h"
#include "compare_clip.h"
#include "compare_options.h"
#include "compare_scenes.h"
#include "compare_text.h"
#include "dermis/judge/clip_motion.h"
#include "kept_device.h"
#include "module.h"
#include "scene_arguments.h"

namespace dermis::python {
namespace {

struct OneComparison {
    Comparison comparison;
    Image reference_effect;  ///< the mean of its halves
    std::string json;        ///< an object of `dermis compare --json`
    std::vector<std::string> warnings;
};

// `renderer`: of the scene.
Result<OneComparison> compare_one(gpu::Device& device, Renderer& renderer, const SubjectCase& one,
                                  const std::vector<Contestant>& contestants, ComparisonSettings settings,
                                  Watch& watch, double from, double share) {
    settings.exact = one.exact;
    DERMIS_TRY_ASSIGN(
        Comparison compared,
        compare_techniques(
            device, renderer, built_in_catalog(), one.scene, contestants, settings,
            {.progress = [&](double done, const std::string&) { watch.report(from + share * done); },
             .shares = {},
             .stop = &watch.stopped(),
             .cancel = &watch.stopped()}));
    OneComparison made{.comparison = std::move(compared),
                       .reference_effect = {},
                       .json = {},
                       .warnings = one.scene.warnings};
    made.reference_effect = mean_effect(made.comparison.reference.effect);
    made.json =
        cli::to_json("", one, made.comparison).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    for (std::string& warning : cli::warnings_of(made.comparison, settings))
        made.warnings.push_back(std::move(warning));
    return made;
}

Result<std::vector<OneComparison>> compare_all(const cli::CompareChoice& choice,
                                               const ComparisonSettings& settings, Watch& watch) {
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants, choice.contestants());
    DERMIS_TRY_ASSIGN(const cli::ComparedScenes scenes, cli::compared_scenes(choice));
    const Result<LentDevice> device = lend_device(choice.device);
    if (!device) return device.error();
    std::vector<OneComparison> made;
    const double share = 1 / double(scenes.all.size());
    for (const SubjectCase& one : scenes.all) {
        DERMIS_TRY_ASSIGN(
            Renderer renderer,
            Renderer::create(device->device(), gpu::embedded_shaders(built_in_catalog().shaders), one.scene));
        Result<OneComparison> compared = compare_one(device->device(), renderer, one, contestants, settings,
                                                     watch, share * double(made.size()), share);
        if (!compared) return scenes.is_set ? compared.error().within(one.name) : compared.error();
        made.push_back(std::move(*compared));
    }
    return made;
}

// The frames of a clip, and the shares over all of them.
struct ClipComparison {
    std::vector<OneComparison> frames;
    std::string json;  ///< of `dermis compare --json` without the frames
    std::vector<double> times_s;
};

Result<ClipComparison> compare_frames(const cli::CompareChoice& choice, const ComparisonSettings& settings,
                                      Watch& watch) {
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants, choice.contestants());
    const Result<LentDevice> device = lend_device(choice.device);
    if (!device) return device.error();
    DERMIS_TRY_ASSIGN(cli::ClipFrames frames, cli::ClipFrames::load(choice, device->device()));
    ClipComparison clip;
    clip.times_s = frames.times_s();
    ComparedFrames compared;
    const double share = 1 / double(clip.times_s.size());
    for (size_t i = 0; i < clip.times_s.size(); ++i) {
        DERMIS_TRY(frames.show(i));
        DERMIS_TRY_ASSIGN(OneComparison made,
                          compare_one(device->device(), frames.renderer(), frames.shown(), contestants,
                                      settings, watch, share * double(i), share));
        DERMIS_TRY(compared.add(frames.shown().name, clip.times_s[i], made.comparison));
        clip.frames.push_back(std::move(made));
    }
    clip.json = cli::clip_json(choice.scene.pose.clip, compared.all, nullptr).dump();
    return clip;
}

OwnPicture own_picture(const py::handle& name, const py::handle& pair) {
    const std::string text = py::str(name), place = "pictures['" + text + "']";
    if (!py::isinstance<py::sequence>(pair) || py::len(pair) != 2)
        throw py::type_error(place + ": two arrays, with and without scattering");
    const auto both = pair.cast<py::sequence>();
    return {.name = text,
            .with = picture_from(both[0], place + "[0]"),
            .without = picture_from(both[1], place + "[1]")};
}

struct CompareCall {
    cli::CompareChoice choice;
    ComparisonSettings settings;
};

CompareCall compare_call(const SceneArguments& scene, const std::string& techniques, const py::dict& pictures,
                         const py::dict& given) {
    cli::CompareChoice choice;
    choice.scene = scene_choice(scene);
    choice.techniques = techniques;
    take(choice.size, given, "size");
    take(choice.device, given, "device");
    take(choice.rest_bakes, given, "rest_bakes");
    take(choice.integrator, given, "integrator");
    take(choice.ambient, given, "ambient");
    take(choice.samples, given, "samples");
    take(choice.samples_per_pixel, given, "samples_per_pixel");
    take(choice.timed_frames, given, "timed_frames");
    take(choice.noise, given, "noise");
    take(choice.frames, given, "frames");
    take(choice.fps, given, "fps");
    if (given.contains("frames")) check(cli::check_number("--frames", choice.frames, cli::kClipFramesRange));
    check(cli::check_number("--fps", choice.fps, cli::kFpsRange));
    if (choice.frames > 0 && !pictures.empty())
        throw Failure({"pictures show one frame; leave frames out and give its time"});
    ComparisonSettings settings = value_of(choice.settings());
    for (const auto& [name, pair] : pictures) settings.pictures.push_back(own_picture(name, pair));
    return {std::move(choice), std::move(settings)};
}

std::vector<OneComparison> compare(const SceneArguments& scene, const std::string& techniques,
                                   const py::dict& pictures, const py::dict& given,
                                   const py::object& progress) {
    const CompareCall call = compare_call(scene, techniques, pictures, given);
    return watched(progress, [&](Watch& watch) { return compare_all(call.choice, call.settings, watch); });
}

ClipComparison compare_clip(const SceneArguments& scene, const std::string& techniques,
                            const py::dict& pictures, const py::dict& given, const py::object& progress) {
    const CompareCall call = compare_call(scene, techniques, pictures, given);
    return watched(progress, [&](Watch& watch) { return compare_frames(call.choice, call.settings, watch); });
}

std::vector<std::string_view> names_of_regions() {
    std::vector<std::string_view> names;
    for (const Region region : kRegions) names.push_back(region_name(region));
    return names;
}

py::array region(const py::object& self, size_t index) {
    return view_of(self.cast<const OneComparison&>().comparison.regions.at(index), self);
}

// Picture of a technique's row, or of the reference.
py::array picture(const py::object& self, int row, const std::string& name) {
    const OneComparison& made = self.cast<const OneComparison&>();
    const Comparison& comparison = made.comparison;
    if (row < 0)
        return view_of(name == "skin"     ? comparison.masks.skin
                       : name == "effect" ? made.reference_effect
                                          : comparison.reference_radiance,
                       self);
    const Compared& compared = comparison.rows.at(size_t(row));
    return view_of(name == "effect" ? compared.effect
                   : name == "flip" ? compared.flip
                                    : compared.radiance,
                   self);
}

std::vector<std::string> row_names(const OneComparison& made) {
    std::vector<std::string> names;
    for (const Compared& row : made.comparison.rows) names.push_back(row.contestant.name());
    return names;
}

}  // namespace

void add_comparisons(py::module_& module) {
    py::class_<OneComparison>(module, "Comparison")
        .def_readonly("json", &OneComparison::json)
        .def_readonly("warnings", &OneComparison::warnings)
        .def_property_readonly("names", row_names);
    py::class_<ClipComparison>(module, "ClipComparison")
        .def_readonly("json", &ClipComparison::json)
        .def_readonly("times_s", &ClipComparison::times_s)
        .def("take_frames", [](ClipComparison& clip) { return std::move(clip.frames); });
    module.def("compare", compare);
    module.def("compare_clip", compare_clip);
    module.def("comparison_picture", picture);
    module.def("region_names", names_of_regions);
    module.def("comparison_region", region);
}

}  // namespace dermis::python
