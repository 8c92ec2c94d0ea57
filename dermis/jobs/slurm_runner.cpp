#include "dermis/jobs/slurm_runner.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/text.h"

namespace dermis::inline jobs {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kQueuePoll(500);
constexpr int kNotFound = 127;

// A worker that a signal ended is started again in its task; Slurm requeues a task whose node failed.
std::string script(const std::string& name, const fs::path& folder) {
    const std::string list = shell_word((folder / (name + ".txt")).string());
    return "#!/bin/sh\n"
           "#SBATCH --job-name=dermis-" +
           name +
           "\n"
           "#SBATCH --requeue\n"
           "#SBATCH --output=" +
           (folder / "logs" / (name + "-%a.txt")).string() +
           "\n"
           "# Runs one line of " +
           name +
           ".txt: the one of the task's number.\n"
           "line=$(sed -n \"${SLURM_ARRAY_TASK_ID}p\" " +
           list +
           ")\n"
           "for attempt in 1 2 3; do\n"
           "    sh -c \"$line\"\n"
           "    status=$?\n"
           "    [ $status -le 128 ] && exit $status  # above: a signal ended it\n"
           "done\n"
           "exit $status\n";
}

// The program's output; its exit code must be 0.
Result<std::string> output_of(const std::vector<std::string>& arguments, const fs::path& folder) {
    const fs::path log = folder / "logs" / (arguments[0] + ".txt");
    const int status = run_program(arguments, log);
    if (status == kNotFound || status == -1)
        return Error{"cannot start " + arguments[0] +
                     ": --runner slurm runs where Slurm's commands are (Debian: slurm-client)"};
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(log));
    const std::string said(trim(text));
    if (status != 0) return Error{arguments[0] + ": " + said};
    return said;
}

class Cluster {
  public:
    explicit Cluster(const SlurmRun& run) : run_(run) {}

    Result<std::string> submit(const std::string& name, const std::vector<size_t>& lines,
                               const std::string& after) {
        std::vector<std::string> arguments = {"sbatch", "--parsable", "--array=" + array_text(lines)};
        // afterany: what a failed part leaves open, merge names, and the next attempt makes.
        if (!after.empty()) arguments.push_back("--dependency=afterany:" + after);
        arguments.insert(arguments.end(), run_.options.begin(), run_.options.end());
        arguments.push_back((run_.folder / (name + ".sbatch")).string());
        DERMIS_TRY_ASSIGN(std::string said, output_of(arguments, run_.folder));
        return std::string(split(said, ';')[0]);  // NUMBER or NUMBER;CLUSTER
    }

    // Whether one of the jobs waits or runs. A job that Slurm no longer knows has ended.
    [[nodiscard]] bool is_busy(const std::vector<std::string>& jobs) const {
        for (const std::string& job : jobs)
            if (const Result<std::string> said =
                    output_of({"squeue", "--noheader", "--jobs=" + job}, run_.folder);
                said && !said->empty())
                return true;
        return false;
    }

  private:
    const SlurmRun& run_;
};

std::vector<size_t> open_lines(const std::vector<JobLine>& lines) {
    std::vector<size_t> open;
    for (size_t i = 0; i < lines.size(); ++i)
        if (!lines[i].is_done()) open.push_back(i + 1);
    return open;
}

// One round: submits what is open and waits. The jobs' numbers are added to the outcome.
Result<void> run_round(const JobLists& lists, const SlurmRun& run, SlurmOutcome& outcome) {
    Cluster cluster(run);
    const std::vector<size_t> work = open_lines(lists.work), merges = open_lines(lists.merges);
    std::vector<std::string> jobs;
    for (const auto& [name, lines] : {std::pair("work", &work), std::pair("merge", &merges)}) {
        if (lines->empty()) continue;
        DERMIS_TRY_ASSIGN(const std::string job, cluster.submit(name, *lines, jobs.empty() ? "" : jobs[0]));
        jobs.push_back(job);
    }
    outcome.jobs.insert(outcome.jobs.end(), jobs.begin(), jobs.end());
    const size_t all = lists.work.size() + lists.merges.size();
    while (run.wait && cluster.is_busy(jobs)) {
        outcome.stopped = run.stop && run.stop->load();
        if (outcome.stopped) return {};
        const auto seem_done = [](const std::vector<JobLine>& lines) {
            return std::ranges::count_if(lines, &JobLine::seems_done);
        };
        if (run.progress) run.progress(double(seem_done(lists.work) + seem_done(lists.merges)) / double(all));
        std::this_thread::sleep_for(kQueuePoll);
    }
    return {};
}

}  // namespace

std::string array_text(const std::vector<size_t>& lines) {
    std::string text;
    for (size_t i = 0; i < lines.size();) {
        size_t last = i;
        while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
        text += (text.empty() ? "" : ",") + std::to_string(lines[i]);
        if (last > i) text += "-" + std::to_string(lines[last]);
        i = last + 1;
    }
    return text;
}

Result<SlurmOutcome> run_on_slurm(const JobLists& lists, const SlurmRun& run) {
    for (const char* name : {"work", "merge"})
        DERMIS_TRY(write_text_file(run.folder / (std::string(name) + ".sbatch"), script(name, run.folder)));
    SlurmOutcome outcome;
    for (int attempt = 0; attempt < run.attempts; ++attempt) {
        const size_t open = open_lines(lists.work).size();
        if (open + open_lines(lists.merges).size() == 0) return outcome;
        if (attempt > 0) outcome.repeated += open;
        DERMIS_TRY(run_round(lists, run, outcome));
        if (!run.wait || outcome.stopped) return outcome;
    }
    for (const std::vector<JobLine>* some : {&lists.work, &lists.merges})
        for (const size_t line : open_lines(*some)) outcome.missing.push_back((*some)[line - 1].name);
    return outcome;
}

}  // namespace dermis::inline jobs
