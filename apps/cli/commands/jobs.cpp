// `dermis jobs`: commands of a file, split into lines that run alone on any machine.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/jobs/local_runner.h"
#include "dermis/jobs/slurm_runner.h"
#include "stop_on_signals.h"

namespace dermis::cli {
namespace {

namespace fs = std::filesystem;

struct JobsOptions {
    std::string commands, folder = "out/jobs", runner = "list", program, sbatch;
    int parts = 16, workers = 2;
    bool no_wait = false;
};

// The plan of one line: "dermis reference head_scan ... -o out/head.exr". Its files are added to `all`.
Result<JobPlan> plan_of(const JobsOptions& options, std::vector<std::string> words, FileUse& all) {
    if (words[0] == "dermis" || words[0] == "./run") words.erase(words.begin());
    CommandLine line("", "", "");
    add_all_commands(line);
    DERMIS_TRY(line.parse_words(std::move(words)));
    if (!line.plan)
        return Error{"'" + line.words[0] + "' is not split into jobs: write reference, compare or render"};
    DERMIS_TRY_ASSIGN(const FileUse files, line.files());
    all.outputs.insert(all.outputs.end(), files.outputs.begin(), files.outputs.end());
    all.inputs.insert(all.inputs.end(), files.inputs.begin(), files.inputs.end());
    DERMIS_TRY(check_outputs(all));
    return line.plan(options.parts, options.folder);
}

Result<std::vector<JobPlan>> plans_of(const JobsOptions& options) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(options.commands));
    std::vector<JobPlan> plans;
    FileUse all = {.outputs = {}, .inputs = {options.commands}};
    int number = 0;
    for (const std::string_view line : split(without_byte_order_mark(text), '\n')) {
        const std::string place = options.commands + ":" + std::to_string(++number) + ": ";
        Result<std::vector<std::string>> words = shell_words(line);
        if (!words) return Error{place + words.error().message};
        if (words->empty()) continue;
        Result<JobPlan> plan = plan_of(options, std::move(*words), all);
        if (!plan) return Error{place + plan.error().message};
        plans.push_back(std::move(*plan));
    }
    if (plans.empty()) return Error{options.commands + ": no line has a command"};
    return plans;
}

std::string this_program() {
    std::error_code ec;
    return fs::read_symlink("/proc/self/exe", ec).string();
}

// Work, then merges when all of it is there.
Result<int> run_local(const JobsOptions& options, const JobLists& lists) {
    const StopOnSignals stop;
    size_t done = 0, repeated = 0;
    for (const auto& [name, lines] : {std::pair("work", &lists.work), std::pair("merge", &lists.merges)}) {
        Progress progress(name, 0);
        const LocalOutcome outcome =
            run_lines(*lines, {.workers = options.workers,
                               .logs = fs::path(options.folder) / "logs",
                               .log_name = name,
                               .stop = &stop_requested(),
                               .progress = [&](double share) { progress.set(share); }});
        done += outcome.done;
        repeated += outcome.repeated;
        if (outcome.stopped) {
            print_message("stopped; what is done stays, and the same command continues");
            return stopped_exit_code();
        }
        for (size_t i = 1; i < outcome.failures.size(); ++i) print_message(outcome.failures[i]);
        if (!outcome.failures.empty()) return Error{outcome.failures[0]};
    }
    std::printf("%s: %zu jobs done, %zu repeated after a worker was killed\n", options.folder.c_str(), done,
                repeated);
    return 0;
}

Result<int> run_slurm(const JobsOptions& options, const JobLists& lists) {
    const Result<std::vector<std::string>> sbatch = shell_words(options.sbatch);
    if (!sbatch) return Error{"--sbatch: " + sbatch.error().message};
    const StopOnSignals stop;
    Progress progress("slurm", 0);
    const Result<SlurmOutcome> outcome =
        run_on_slurm(lists, {.folder = options.folder,
                             .options = *sbatch,
                             .wait = !options.no_wait,
                             .stop = &stop_requested(),
                             .progress = [&](double share) { progress.set(share); }});
    if (!outcome) return outcome.error();
    std::string jobs;
    for (const std::string& job : outcome->jobs) jobs += " " + job;
    if (outcome->stopped) {
        print_message("stopped waiting; the jobs stay in the queue: scancel" + jobs + " removes them");
        return stopped_exit_code();
    }
    if (!outcome->missing.empty())
        return Error{outcome->missing[0] + " and " + std::to_string(outcome->missing.size() - 1) +
                     " more have no result; " + options.folder + "/logs has what they printed"};
    std::printf("%s: %s%s, %zu lines repeated\n", options.folder.c_str(),
                jobs.empty()      ? "all was done"
                : options.no_wait ? "submitted as"
                                  : "done by Slurm's jobs",
                jobs.c_str(), outcome->repeated);
    return 0;
}

Result<FileUse> files_of(const JobsOptions& options) {
    const fs::path folder = options.folder;
    return FileUse{.outputs = {folder / "work.txt", folder / "merge.txt"}, .inputs = {options.commands}};
}

Result<int> run(const JobsOptions& options) {
    const std::vector<std::string> runners = {"list", "local", "slurm"};
    if (std::ranges::find(runners, options.runner) == runners.end())
        return Error{unknown_name("runner", options.runner, runners)};
    DERMIS_TRY_ASSIGN(const std::vector<JobPlan> plans, plans_of(options));
    const JobLists lists =
        job_lists(plans, options.program.empty() ? this_program() : options.program, options.folder);
    DERMIS_TRY(write_job_lists(lists, options.folder));
    if (options.runner == "local") return run_local(options, lists);
    if (options.runner == "slurm") return run_slurm(options, lists);
    const std::string work = shell_word(options.folder + "/work.txt"),
                      merge = shell_word(options.folder + "/merge.txt");
    std::printf("%zu lines in %s, then %zu in %s:\n  parallel < %s && parallel < %s\n", lists.work.size(),
                work.c_str(), lists.merges.size(), merge.c_str(), work.c_str(), merge.c_str());
    return 0;
}

}  // namespace

void add_jobs_command(CommandLine& line) {
    const auto options = std::make_shared<JobsOptions>();
    Command* command =
        line.add("jobs", "Splits commands into jobs, and runs them on this machine or a cluster",
                 "dermis jobs commands.txt --parts 64 --runner slurm --sbatch=\"-p long\"\n"
                 "  commands.txt has one command a line:\n"
                 "    reference head_scan --size 3840x2160 --samples 1024 -o out/head.exr\n"
                 "    render head_scan --frames 240 --turn 360 -o out/turn/%04d.png\n"
                 "    compare head_scan -o out/compare\n"
                 "  Samples and frames are split, a comparison is one job. Finished jobs are skipped.");
    command->add_option("COMMANDS", options->commands, "file with one command per line")->required();
    command->add_output("--folder", options->folder, "folder for lists, parts and logs")
        ->capture_default_str();
    command->add_option("--parts", options->parts, {1, 16384}, "maximum parts of a picture or a turn")
        ->capture_default_str();
    command
        ->add_option("--runner", options->runner,
                     "list (work.txt and merge.txt, for GNU parallel), local (this machine) or slurm")
        ->capture_default_str();
    command->add_option("--workers", options->workers, {1, 1024}, "local: jobs at once; each uses all cores")
        ->capture_default_str();
    command->add_option("--program", options->program,
                        "dermis on the machines that run the lines (default: this one)");
    command->add_option("--sbatch", options->sbatch, "slurm: options for sbatch: --sbatch=\"-p long\"");
    command->add_flag("--no-wait", options->no_wait, "slurm: return when the jobs are submitted");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
