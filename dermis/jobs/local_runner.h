#pragma once
// Runs shell lines on this machine, several at once.

#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dermis/jobs/job_list.h"

namespace dermis::inline jobs {

struct LocalRun {
    int workers = 1;
    int attempts = 3;                         ///< of a line whose worker was killed
    std::filesystem::path logs;               ///< a folder for the output of each line, NAME-1.txt and so on
    std::string log_name = "work";            ///< NAME
    const std::atomic<bool>* stop = nullptr;  ///< ends the workers and returns
    std::function<void(double done)> progress;
};

struct LocalOutcome {
    size_t done = 0;
    size_t repeated = 0;                ///< attempts after a worker was killed
    std::vector<std::string> failures;  ///< a line each: name, what it said
    bool stopped = false;
};

/// Each line by `sh -c`, in a process group of its own. A line fails by itself; a worker that a signal ended
/// (kill, out of memory) is started again.
[[nodiscard]] LocalOutcome run_lines(std::span<const JobLine> lines, const LocalRun& run);

}  // namespace dermis::inline jobs
