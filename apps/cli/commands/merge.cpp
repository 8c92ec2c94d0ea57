// `dermis merge`: a picture from the parts that `dermis reference --sample-range` wrote.

#include "dermis/jobs/part.h"

#include <chrono>
#include <cstdio>
#include <memory>

#include "command.h"
#include "dermis/base/progress.h"
#include "picture_text.h"

namespace dermis::cli {
namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output, preview;
    bool check = false, json = false;
};

// Each part by itself, for scripts: exit code 0 when all are whole.
Result<int> check_parts(const MergeOptions& options) {
    int damaged = 0;
    for (const std::string& file : options.parts) {
        const Result<Part> part = read_part(file);
        if (part) {
            std::printf("%s: samples %d:%d of 0:%d\n", file.c_str(), part->facts.range.begin,
                        part->facts.range.end, part->facts.samples);
            continue;
        }
        print_message(part.error().message);
        ++damaged;
    }
    return damaged == 0 ? 0 : 1;
}

Result<FileUse> files_of(const MergeOptions& options) {
    if (options.check && options.output.empty() && options.preview.empty()) return FileUse{};
    if (options.check) return Error{"--check writes nothing: leave out -o and --preview"};
    if (options.output.empty()) return Error{"-o is missing: name the picture, a .exr file"};
    return picture_files(options.output, options.preview, {options.parts.begin(), options.parts.end()});
}

Result<int> run(const MergeOptions& options) {
    if (options.check) return check_parts(options);
    const auto start = std::chrono::steady_clock::now();
    DERMIS_TRY_ASSIGN(MergedPicture merged, [&] {
        Progress line("merge", 0);
        return merge_parts(std::vector<std::filesystem::path>(options.parts.begin(), options.parts.end()),
                           [&](double done) { line.set(done); });
    }());
    const PictureFacts& facts = merged.facts.picture;
    const std::string text = described(facts, merged.picture, false);
    DERMIS_TRY(write_picture_file(options.output, facts, merged.picture, text));
    if (!options.preview.empty()) DERMIS_TRY(write_preview_file(options.preview, facts, merged.picture));
    merged.picture.time_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    print_picture({.output = options.output, .text = text, .credit = facts.credit, .json = options.json},
                  merged.picture);
    return 0;
}

}  // namespace

void add_merge_command(CommandLine& line) {
    const auto options = std::make_shared<MergeOptions>();
    Command* command =
        line.add("merge", "Makes a picture of its parts, which dermis reference --sample-range wrote",
                 "dermis merge part*.exr -o picture.exr --preview picture.png\n"
                 "  dermis merge --check part*.exr   (names parts that are cut off or damaged)");
    command->add_option("PARTS", options->parts, "the parts, in any order")->required();
    command->add_output("-o,--output", options->output, "FILE.exr");
    command->add_output("--preview", options->preview, "FILE.png: the picture with the scene's tone map");
    command->add_flag("--check", options->check, "only read the parts, and say of each whether it is whole");
    command->add_flag("--json", options->json, "print one JSON object");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
