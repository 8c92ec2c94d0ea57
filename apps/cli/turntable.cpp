#include "turntable.h"
#include "catalog/catalog.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/scene/scene_files.h"
#include "render_frames.h"

namespace dermis::cli {
namespace {

namespace fs = std::filesystem;

bool is_film(const Turntable& turntable) {
    return to_lower(fs::path(turntable.output).extension().string()) == ".mp4";
}

fs::path frames_folder(const Turntable& turntable) {
    return turntable.output + ".frames";
}

// Returns what each picture states: its credit and its content.
Result<OutputSettings> draw_turn(const Turntable& turntable, const std::string& pattern) {
    DERMIS_TRY_ASSIGN(Prepared prepared, prepare(turntable.render));
    if (Result<void> kept = check_outputs(
            {.outputs = frame_files(pattern, {0, turntable.frames}), .inputs = files_of(prepared.scene)});
        !kept)
        return kept.error();
    Result<gpu::Device> device = gpu::Device::create({.validation = turntable.render.validation,
                                                      .on_message = print_message,
                                                      .name_contains = turntable.render.device});
    if (!device) return device.error();
    DERMIS_TRY_ASSIGN(
        Renderer renderer,
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), prepared.scene));
    const OutputSettings output = {.credit = prepared.scene.credit,
                                   .description = prepared.scene.name + ", " + prepared.technique->id};
    const Camera start = prepared.scene.camera;
    Progress progress("turntable", size_t(turntable.frames));
    for (int frame = 0; frame < turntable.frames; ++frame) {
        turn_camera(prepared.scene, start, 2 * 3.14159265358979 * frame / turntable.frames);
        if (const auto drawn = renderer.draw(*prepared.technique, *prepared.values, prepared.draw); !drawn)
            return drawn.error();
        if (Result<void> written = write_output(renderer, *prepared.technique, *prepared.values,
                                                prepared.draw, frame_path(pattern, frame), output);
            !written)
            return written.error();
        progress.advance(1);
    }
    if (!device->messages().empty()) return Error{"the validation layers reported errors (see above)"};
    return output;
}

// States the colour matrix and the transfer curve, in the file too: otherwise players guess them from the
// size, and skin gets red or green. Sides must be even.
std::vector<std::string> film_command(const std::string& pattern, const std::string& film,
                                      const OutputSettings& output) {
    return {"ffmpeg",
            "-y",
            "-loglevel",
            "error",
            "-framerate",
            "30",
            "-i",
            pattern,
            "-vf",
            "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,"
            "format=yuv420p",
            "-crf",
            "16",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-color_range",
            "tv",
            "-movflags",
            "+faststart",
            "-metadata",
            "title=" + output.description,
            "-metadata",
            "comment=" + output.credit,
            film};
}

// Draws the frames into a folder beside the film, which is removed when the film is made.
Result<void> draw_film(const Turntable& turntable) {
    const fs::path folder = frames_folder(turntable);
    const std::string pattern = (folder / "%04d.png").string();
    std::error_code ec;
    const Result<OutputSettings> drawn = draw_turn(turntable, pattern);
    Result<void> done = drawn ? Result<void>() : drawn.error();
    if (drawn)
        done = write_beside(turntable.output, [&](const fs::path& temporary) -> Result<void> {
            const fs::path log = folder / "ffmpeg.txt";
            const int status = run_program(film_command(pattern, temporary.string(), *drawn), log);
            if (status == 0) return {};
            if (status == 127 || status == -1)
                return Error{
                    "a video needs ffmpeg (Debian: apt-get install ffmpeg); numbered pictures (-o "
                    "out/%04d.png) do not"};
            const Result<std::string> said = read_text_file(log);
            return Error{"ffmpeg: " + (said ? std::string(trim(split(*said, '\n')[0])) : "failed")};
        });
    fs::remove_all(folder, ec);
    return done;
}

}  // namespace

std::string frame_path(const std::string& pattern, int frame) {
    const size_t percent = pattern.find('%');
    const size_t d = percent == std::string::npos ? percent : pattern.find('d', percent);
    if (d == std::string::npos) return pattern;
    const std::string digits = pattern.substr(percent + 1, d - percent - 1);
    const size_t width = digits.empty() ? 0 : size_t(std::clamp(std::atoi(digits.c_str()), 0, 12));
    std::string number = std::to_string(frame);
    if (number.size() < width) number.insert(0, width - number.size(), '0');
    return pattern.substr(0, percent) + number + pattern.substr(d + 1);
}

std::vector<std::filesystem::path> frame_files(const std::string& pattern, IndexRange range) {
    if (frame_path(pattern, 0) == pattern) return {pattern};
    std::vector<std::filesystem::path> files;
    for (int frame = range.begin; frame < range.end; ++frame) files.emplace_back(frame_path(pattern, frame));
    return files;
}

Result<FileUse> turntable_files(const Turntable& turntable) {
    FileUse files = {.outputs = {turntable.output}, .inputs = {turntable.render.scene.name}};
    std::error_code ec;
    if (is_film(turntable)) {
        const fs::path folder = frames_folder(turntable);
        if (fs::exists(folder, ec))
            return Error{folder.string() + " exists already; the frames would be written there"};
        return files;
    }
    if (frame_path(turntable.output, 0) == turntable.output)
        return Error{"-o " + turntable.output +
                     ": a turntable writes numbered pictures (out/%04d.png) or a video (.mp4)"};
    DERMIS_TRY(check_output(turntable.output, {}));
    files.outputs = frame_files(turntable.output, {0, turntable.frames});
    return files;
}

Result<int> run_turntable(const Turntable& turntable) {
    if (is_film(turntable)) {
        DERMIS_TRY(draw_film(turntable));
    } else if (const auto drawn = draw_turn(turntable, turntable.output); !drawn) {
        return drawn.error();
    }
    print_path(turntable.output);
    return 0;
}

}  // namespace dermis::cli
