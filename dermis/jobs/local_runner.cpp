#include "dermis/jobs/local_runner.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <thread>

#include "dermis/base/file.h"
#include "dermis/base/text.h"

extern char** environ;

namespace dermis::inline jobs {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kWorkerPoll(10);
// A shell exits with 128 + n when signal n ended its command.
constexpr int kKilled = 128;

struct Worker {
    pid_t process = 0;
    size_t line = 0;
};

fs::path log_of(const LocalRun& run, size_t line) {
    return run.logs / (fmt::format("{}-{}.txt", run.log_name, line + 1));
}

// 0, or what errno says.
int start(const std::string& text, const fs::path& log, pid_t& process) {
    const char* argv[] = {"sh", "-c", text.c_str(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int failed =
        posix_spawn(&process, "/bin/sh", &actions, &attributes, const_cast<char**>(argv), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return failed;
}

// The last line that the command printed.
std::string last_words(const fs::path& log) {
    const Result<std::string> text = read_text_file(log);
    if (!text) return text.error().message;
    std::string last;
    for (const std::string_view line : split(*text, '\n'))
        if (!trim(line).empty()) last = std::string(trim(line));
    return last.empty() ? "it said nothing" : last;
}

class Pool {
  public:
    Pool(std::span<const JobLine> lines, const LocalRun& run)
        : lines_(lines), run_(run), attempts_(lines.size()) {
        for (size_t i = 0; i < lines.size(); ++i) waiting_.push_back(i);
    }

    LocalOutcome run() {
        while (!outcome_.stopped && (!waiting_.empty() || !workers_.empty())) {
            while (!waiting_.empty() && int(workers_.size()) < std::max(run_.workers, 1)) start_next();
            std::erase_if(workers_, [&](const Worker& worker) { return has_ended(worker); });
            outcome_.stopped = run_.stop && run_.stop->load();
            std::this_thread::sleep_for(kWorkerPoll);
        }
        for (const Worker& worker : workers_) ::kill(-worker.process, SIGTERM);
        for (const Worker& worker : workers_) ::waitpid(worker.process, nullptr, 0);
        return std::move(outcome_);
    }

  private:
    void start_next() {
        const size_t line = waiting_.front();
        waiting_.pop_front();
        ++attempts_[line];
        Worker worker{.line = line};
        if (const int failed = start(lines_[line].text, log_of(run_, line), worker.process))
            fail(line, std::string("cannot start a shell: ") + std::strerror(failed));
        else
            workers_.push_back(worker);
    }

    bool has_ended(const Worker& worker) {
        int status = 0;
        if (::waitpid(worker.process, &status, WNOHANG) != worker.process) return false;
        const bool killed = WIFSIGNALED(status) || WEXITSTATUS(status) > kKilled;
        if (killed && attempts_[worker.line] < run_.attempts) {
            ++outcome_.repeated;
            waiting_.push_front(worker.line);
        } else if (killed) {
            fail(worker.line, fmt::format("was killed {} times; it may need more memory than there is: fewer "
                                          "--workers, or a smaller picture",
                                          run_.attempts));
        } else if (WEXITSTATUS(status) != 0) {
            fail(worker.line, last_words(log_of(run_, worker.line)));
        } else {
            ++outcome_.done;
            advance();
        }
        return true;
    }

    void fail(size_t line, const std::string& why) {
        outcome_.failures.push_back(lines_[line].name + ": " + why);
        advance();
    }

    void advance() {
        ++ended_;
        if (run_.progress) run_.progress(double(ended_) / double(lines_.size()));
    }

    std::span<const JobLine> lines_;
    const LocalRun& run_;
    std::vector<int> attempts_;
    std::deque<size_t> waiting_;
    std::vector<Worker> workers_;
    size_t ended_ = 0;
    LocalOutcome outcome_;
};

}  // namespace

LocalOutcome run_lines(std::span<const JobLine> lines, const LocalRun& run) {
    return Pool(lines, run).run();
}

}  // namespace dermis::inline jobs
