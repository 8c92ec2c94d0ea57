#pragma once
// Jobs as shell lines: each runs alone, in any order, and does nothing if its result is
// there and whole.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline jobs {

struct Job {
    std::string name;                  ///< for people
    std::string hash;                  ///< of all that the results depend on
    std::vector<std::string> words;    ///< of the command line, without the program
    std::vector<std::string> results;  ///< files; the job is done when all are whole
    /// The result is a part, whose header has a checksum. Otherwise the checksums of the results are in a
    /// file of done/ that is named by the job's hash.
    bool is_part = false;
};

struct JobPlan {
    std::vector<Job> work;
    std::optional<Job> merge;  ///< after the work; when it is done, so are its parts
};

/// Quoted for a shell where it has to be.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The words of a line as a POSIX shell splits it: blanks, '...', "..." and backslashes, and a comment after
/// #. Errors: what only a shell can do ($, `, ;, |, &, <, >), a quote without its end.
[[nodiscard]] Result<std::vector<std::string>> shell_words(std::string_view line);

/// Words without these options: {"-o", "--output"} with their values, {"--json"} without.
[[nodiscard]] std::vector<std::string> words_without(std::span<const std::string> words,
                                                     std::span<const std::string_view> options,
                                                     std::span<const std::string_view> flags);

struct JobLine {
    std::string name, text;
    std::string check;                ///< shell text: true when it is done
    std::vector<std::string> proof;   ///< the results
    std::vector<std::string> merged;  ///< of a part: those of the picture, which makes it superfluous
    /// Runs the check, which reads all results.
    [[nodiscard]] bool is_done() const;
    /// Whether files are there, whatever they hold: cheap, for a display of progress.
    [[nodiscard]] bool seems_done() const;
};

/// All plans as lines: work, then merges.
struct JobLists {
    std::vector<JobLine> work, merges;
};
[[nodiscard]] JobLists job_lists(std::span<const JobPlan> plans, const std::string& program,
                                 const std::string& folder);

/// Writes work.txt and merge.txt, and makes the folders parts, done and logs.
[[nodiscard]] Result<void> write_job_lists(const JobLists& lists, const std::filesystem::path& folder);

}  // namespace dermis::inline jobs
