#pragma once
// Runs the lists of a jobs folder on a Slurm cluster: an array job for the work, and one for the merges that
// waits for it. Both sbatch scripts stay in the folder.

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dermis/jobs/job_list.h"

namespace dermis::inline jobs {

struct SlurmRun {
    std::filesystem::path folder;      ///< of write_job_lists()
    std::vector<std::string> options;  ///< of sbatch: --partition=long, --time=2:00:00
    bool wait = true;                  ///< until all is done; otherwise returns when the jobs are submitted
    int attempts = 3;                  ///< of lines that ended without their result
    const std::atomic<bool>* stop = nullptr;  ///< ends the waiting; the jobs stay in the queue
    std::function<void(double done)> progress;
};

struct SlurmOutcome {
    std::vector<std::string> jobs;     ///< numbers of all that were submitted
    std::vector<std::string> missing;  ///< names of what has no result after the last attempt
    size_t repeated = 0;               ///< lines that were submitted again
    bool stopped = false;
};

/// "1-4,7,9-10" of 1-based line numbers in order.
[[nodiscard]] std::string array_text(const std::vector<size_t>& lines);

/// Submits what is not done. Errors: no sbatch here, what sbatch says.
[[nodiscard]] Result<SlurmOutcome> run_on_slurm(const JobLists& lists, const SlurmRun& run);

}  // namespace dermis::inline jobs
