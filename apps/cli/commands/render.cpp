// dermis render: one scene, one technique, one picture (or a turn of the camera, or a clip).

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/progress.h"
#include "dermis/render/output.h"
#include "dermis/scene/scene_words.h"
#include "job_hash.h"
#include "render_frames.h"
#include "render_options.h"
#include "turntable.h"

namespace dermis::cli {
namespace {

struct Options {
    RenderOptions render;
    std::string output = "out/dermis.png", frame_range;
    OutputSettings file;
    RenderFrames frames;
    bool timings = false, json = false;
};

// The frames of --frame-range, or all.
Result<IndexRange> frames_of(const Options& options) {
    const bool numbered = frame_path(options.output, 0) != options.output;
    if (options.frames.count > 1 && !options.timings && !numbered)
        return Error{"--frames " + std::to_string(options.frames.count) + " would write " + options.output +
                     " again and again; number them: -o out/%04d.png"};
    if (options.frames.turn_deg != 0 && options.frames.count == 1)
        return Error{"--turn has no effect on one picture; add --frames and number them: -o out/%04d.png"};
    if (options.frames.fps > 0 && (options.render.scene.pose.clip.empty() || !numbered))
        return Error{
            "--fps is for the numbered frames of a clip: --clip NAME --frames 96 --fps 24 -o out/%04d.png"};
    if (options.frame_range.empty()) return IndexRange{0, options.frames.count};
    const Result<IndexRange> range = parse_index_range("--frame-range", options.frame_range);
    if (!range) return range;
    if (!numbered || range->begin >= range->end || range->end > options.frames.count)
        return Error{"--frame-range " + options.frame_range + ": not a range of the " +
                     std::to_string(options.frames.count) +
                     " numbered frames (--frames, -o out/%04d.png); write BEGIN:END, such as 0:1"};
    return range;
}

Result<FileUse> files_of(const Options& options) {
    DERMIS_TRY(check_output(options.output, options.file));
    DERMIS_TRY_ASSIGN(const IndexRange range, frames_of(options));
    return FileUse{.outputs = frame_files(options.output, range), .inputs = {options.render.scene.name}};
}

// Medians over the frames after the first, which compiles pipelines.
gpu::FrameResult median_timings(const std::vector<gpu::FrameResult>& frames) {
    const auto median = [&](auto value_of) {
        std::vector<double> values;
        for (size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i)
            values.push_back(value_of(frames[i]));
        std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
        return values[values.size() / 2];
    };
    gpu::FrameResult result = frames.back();
    result.frame_ms = median([](const gpu::FrameResult& f) { return f.frame_ms; });
    // Frames may have different passes: the median is over the frames with this pass.
    for (gpu::PassTiming& pass : result.passes)
        pass.time_ms = median([&](const gpu::FrameResult& f) {
            const auto same = std::ranges::find(f.passes, pass.name, &gpu::PassTiming::name);
            return same == f.passes.end() ? pass.time_ms : same->time_ms;
        });
    return result;
}

nlohmann::json to_json(const Prepared& prepared, const Options& options, const gpu::Device& device,
                       const gpu::FrameResult& timings) {
    nlohmann::json settings = nlohmann::json::object(), passes = nlohmann::json::array();
    for (const Parameter& parameter : prepared.technique->parameters.parameters)
        settings[parameter.name] = prepared.values->text(parameter);
    for (const gpu::PassTiming& pass : timings.passes)
        passes.push_back({{"name", pass.name},
                          {"time_ms", pass.time_ms},
                          {"samples_passed", pass.samples_passed},
                          {"target_texels", pass.target_texels}});
    return {{"scene", prepared.scene.name},
            {"technique", prepared.technique->id},
            {"settings", settings},
            {"view", prepared.draw.view},
            {"device", device.info().name},
            {"width", prepared.draw.width},
            {"height", prepared.draw.height},
            {"frame_ms", timings.frame_ms},
            {"passes", passes},
            {"camera", camera_text(prepared.scene.camera)},
            {"output", options.output},
            {"credit", prepared.scene.credit},
            {"warnings", prepared.scene.warnings}};
}

void print_timings(const gpu::FrameResult& timings, const gpu::Device& device) {
    for (const gpu::PassTiming& pass : timings.passes) {
        std::printf("  %-24s %9.3f ms", pass.name.c_str(), pass.time_ms);
        if (pass.samples_passed)
            std::printf("  %5.1f %% of its texels",
                        100.0 * double(pass.samples_passed) / double(pass.target_texels));
        std::printf("\n");
    }
    std::printf("  %-24s %9.3f ms  on %s\n", "frame", timings.frame_ms, device.info().name.c_str());
}

Result<std::vector<gpu::FrameResult>> draw_frames(Renderer& renderer, Prepared& prepared,
                                                  const Options& options, IndexRange range) {
    const bool numbered = frame_path(options.output, 0) != options.output;
    const Scene start = without_objects(prepared.scene);
    // Timings of a still need a few frames; the first compiles.
    if (options.timings && options.frames.count == 1 && options.frames.fps == 0) range.end = 4;
    const int frames = std::max(options.frames.count, range.end);
    Progress progress("frames", size_t(range.end - range.begin));
    std::vector<gpu::FrameResult> results;
    for (int frame = range.begin; frame < range.end; ++frame) {
        DERMIS_TRY(show_frame(options.frames, frame, start, prepared.scene, renderer));
        DERMIS_TRY_ASSIGN(gpu::FrameResult drawn,
                          renderer.draw(*prepared.technique, *prepared.values, prepared.draw));
        results.push_back(std::move(drawn));
        progress.advance();
        if (!numbered && frame + 1 < frames) continue;
        if (numbered && frame >= options.frames.count) continue;
        if (Result<void> written =
                write_output(renderer, *prepared.technique, *prepared.values, prepared.draw,
                             frame_path(options.output, frame), options.file);
            !written)
            return written.error();
    }
    return results;
}

Result<int> render(Options options) {
    DERMIS_TRY_ASSIGN(const IndexRange range, frames_of(options));
    Result<Prepared> prepared = prepare(options.render);
    if (!prepared) return prepared.error();
    DERMIS_TRY(keep_scene_files(prepared->scene, files_of(options)));
    print_warnings(prepared->scene.warnings);
    Result<gpu::Device> device = gpu::Device::create({.validation = options.render.validation,
                                                      .on_message = print_message,
                                                      .name_contains = options.render.device});
    if (!device) return device.error();
    prepared->draw.deep = options.file.png_bits == 16;
    options.file.credit = prepared->scene.credit;
    options.file.description = prepared->scene.name + ", " + prepared->technique->id;
    DERMIS_TRY_ASSIGN(
        Renderer renderer,
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), prepared->scene));
    DERMIS_TRY_ASSIGN(const std::vector<gpu::FrameResult> frames,
                      draw_frames(renderer, *prepared, options, range));

    print_warnings(renderer.warnings());
    const gpu::FrameResult timings = median_timings(frames);
    if (options.json) {
        std::printf("%s\n", to_json(*prepared, options, *device, timings).dump(2).c_str());
    } else {
        print_path(options.output);
        if (!prepared->scene.credit.empty()) std::printf("%s\n", prepared->scene.credit.c_str());
        if (options.timings) print_timings(timings, *device);
    }
    if (!device->messages().empty()) return Error{"the validation layers reported errors (see above)"};
    return 0;
}

// Frames in as many jobs as there are parts.
Result<JobPlan> plan(const Options& options, const std::vector<std::string>& words, int parts) {
    if (!options.frame_range.empty())
        return Error{"--frame-range: dermis jobs chooses the ranges; leave it out"};
    DERMIS_TRY_ASSIGN(const Prepared prepared, prepare(options.render));
    DERMIS_TRY(keep_scene_files(prepared.scene, files_of(options)));
    const Result<std::string> hash = hash_of_job({&prepared.scene}, words);
    if (!hash) return hash.error();
    const bool numbered = frame_path(options.output, 0) != options.output;
    const int count = numbered ? std::min(parts, options.frames.count) : 1;
    JobPlan plan;
    for (int i = 0; i < count; ++i) {
        const int begin = options.frames.count * i / count, end = options.frames.count * (i + 1) / count;
        const std::string text = std::to_string(begin) + ":" + std::to_string(end);
        Job job{.name = options.output, .hash = *hash, .words = words};
        if (numbered) {
            job.name += " frames " + text;
            job.hash += "_" + std::to_string(begin) + "_" + std::to_string(end);
            job.words.insert(job.words.end(), {"--frame-range", text});
            for (int frame = begin; frame < end; ++frame)
                job.results.push_back(frame_path(options.output, frame));
        } else {
            job.results = {options.output};
        }
        plan.work.push_back(std::move(job));
    }
    return plan;
}

}  // namespace

void add_render_command(CommandLine& line) {
    const auto options = std::make_shared<Options>();
    Command* command = line.add("render", "Renders a scene with a technique",
                                "dermis render head_scan -t wrap --set wrap=0.4 -o out/head.png --timings");
    options->render.add_to(*command);
    command
        ->add_output("-o,--output", options->output,
                     "picture: .png (tone-mapped) or .exr (linear); %04d numbers frames")
        ->capture_default_str();
    command->add_option("--bits", options->file.png_bits, {8, 16}, "bits of a PNG channel: 8 or 16")
        ->capture_default_str();
    command->add_flag("--layers", options->file.layers, "all debug views as layers of the EXR");
    command->add_option("--frames", options->frames.count, kRenderFramesRange, "number of frames")
        ->capture_default_str();
    command->add_option("--frame-range", options->frame_range,
                        "BEGIN:END: render only this range of the --frames; file numbers are unchanged");
    command
        ->add_option("--turn", options->frames.turn_deg, kTurnRangeDeg,
                     "angle in degrees that the camera turns over all frames")
        ->capture_default_str();
    command->add_option("--fps", options->frames.fps, kFpsRange,
                        "frames in a second of the --clip, from --time on; 0: all frames have one pose");
    command->add_flag("--timings", options->timings,
                      "print the time of each pass (median without the first frame)");
    command->add_flag("--json", options->json, "print one JSON object instead");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return render(*options); },
        [options, &line](int parts, const std::string&) { return plan(*options, line.words, parts); });
}

}  // namespace dermis::cli
