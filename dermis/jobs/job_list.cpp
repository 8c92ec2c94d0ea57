#include "dermis/jobs/job_list.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/process.h"

namespace dermis::inline jobs {
namespace {

namespace fs = std::filesystem;

std::string joined(std::span<const std::string> words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
    return text;
}

std::string done_file(const Job& job, const std::string& folder) {
    return (fs::path(folder) / "done" / job.hash).string();
}

// True in the shell when the results are those that the job wrote: cksum (POSIX) prints a sum, the size and
// the name of each. An empty mark is none: cksum of no file prints nothing too.
std::string results_check(const Job& job, const std::string& folder) {
    const std::string mark = shell_word(done_file(job, folder));
    return "{ [ -s " + mark + " ] && cksum " + joined(job.results) + " 2>/dev/null | cmp -s - " + mark +
           "; }";
}

// The file first: a program that succeeds and does nothing is not believed.
std::string part_check(const Job& job, const std::string& program) {
    return "{ [ -s " + joined(job.results) + " ] && " + shell_word(program) + " merge --check " +
           joined(job.results) + " >/dev/null 2>&1; }";
}

// `merge` is the job that a part is for: its result makes the part superfluous.
JobLine line_of(const Job& job, const Job* merge, const std::string& program, const std::string& folder) {
    const std::string run = shell_word(program) + " " + joined(job.words);
    JobLine line{.name = job.name, .proof = job.results};
    if (job.is_part) {
        line.check = part_check(job, program);
        line.text = line.check + " || { " + run + " && { " + line.check +
                    " || { echo no whole result: " + joined(job.results) + " >&2; false; }; }; }";
    } else {
        line.check = results_check(job, folder);
        line.text = line.check + " || { " + run + " && cksum " + joined(job.results) + " > " +
                    shell_word(done_file(job, folder)) + "; }";
    }
    if (merge) {
        const std::string merged = results_check(*merge, folder) + " || ";
        line.check = merged + line.check;
        line.text = merged + line.text;
        line.merged = merge->results;
    }
    return line;
}

std::string list_text(std::span<const JobLine> lines) {
    std::string text;
    for (const JobLine& line : lines) text += line.text + "\n";
    return text;
}

}  // namespace

std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

Result<std::vector<std::string>> shell_words(std::string_view line) {
    std::vector<std::string> words;
    bool in_word = false;
    char quote = 0;
    const auto add = [&](char c) {
        if (!in_word) words.emplace_back();
        in_word = true;
        words.back() += c;
    };
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == quote) {
            quote = 0;
        } else if (c == '\\' && quote != '\'' && i + 1 < line.size()) {
            add(line[++i]);
        } else if ((c == '$' || c == '`') && quote != '\'') {
            return Error{"'" + std::string(1, c) + "' needs a shell; write what it means"};
        } else if (quote) {
            add(c);
        } else if (c == '\'' || c == '"') {
            quote = c;
            if (!in_word) words.emplace_back();
            in_word = true;
        } else if (c == ' ' || c == '\t' || c == '\r') {
            in_word = false;
        } else if (c == '#' && !in_word) {
            break;
        } else if (std::string_view(";|&<>").find(c) != std::string_view::npos) {
            return Error{"'" + std::string(1, c) + "' needs a shell; write one command a line"};
        } else {
            add(c);
        }
    }
    if (quote) return Error{std::string("a quote ") + quote + " has no end"};
    return words;
}

std::vector<std::string> words_without(std::span<const std::string> words,
                                       std::span<const std::string_view> options,
                                       std::span<const std::string_view> flags) {
    std::vector<std::string> left;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const auto names = [&](std::string_view option) {
            // --output=FILE, and -oFILE
            return option.starts_with("--") ? word.starts_with(std::string(option) + "=")
                                            : word.starts_with(option) && !word.starts_with("--");
        };
        if (std::ranges::find(options, word) != options.end())
            ++i;
        else if (std::ranges::find(flags, word) == flags.end() && std::ranges::none_of(options, names))
            left.push_back(word);
    }
    return left;
}

bool JobLine::is_done() const {
    return run_program({"/bin/sh", "-c", check}, "/dev/null") == 0;
}

bool JobLine::seems_done() const {
    const auto are_there = [](const std::vector<std::string>& files) {
        std::error_code ec;
        return std::ranges::all_of(files, [&](const std::string& file) { return fs::exists(file, ec); });
    };
    return are_there(proof) || (!merged.empty() && are_there(merged));
}

JobLists job_lists(std::span<const JobPlan> plans, const std::string& program, const std::string& folder) {
    JobLists lists;
    for (const JobPlan& plan : plans) {
        const Job* merge = plan.merge ? &*plan.merge : nullptr;
        for (const Job& job : plan.work) lists.work.push_back(line_of(job, merge, program, folder));
        if (merge) lists.merges.push_back(line_of(*merge, nullptr, program, folder));
    }
    return lists;
}

Result<void> write_job_lists(const JobLists& lists, const fs::path& folder) {
    for (const char* name : {"parts", "done", "logs"}) {
        std::error_code ec;
        fs::create_directories(folder / name, ec);
        if (ec) return Error{(folder / name).string() + ": " + ec.message()};
    }
    const std::string work = list_text(lists.work), merges = list_text(lists.merges);
    const FileContent files[] = {{folder / "work.txt", as_bytes(work)},
                                 {folder / "merge.txt", as_bytes(merges)}};
    return write_files(files);
}

}  // namespace dermis::inline jobs
