#pragma once
// A virtual display (Xvfb), so that windows open on a machine without a display and never on the user's
// screen; and a window manager (twm) for the tests that need one.

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <vector>

extern char** environ;

namespace dermis {

/// Another program, silent, until the end of its scope.
class ChildProgram {
  public:
    /// started() is false if the program does not exist.
    explicit ChildProgram(const std::vector<std::string>& words) {
        std::vector<char*> arguments;
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        for (const int output : {STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_addopen(&actions, output, "/dev/null", 1, 0);
        const int spawned =
            posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (spawned != 0) process_ = 0;
    }
    ~ChildProgram() {
        if (!process_) return;
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    [[nodiscard]] bool started() const { return process_ != 0; }

  private:
    pid_t process_ = 0;
};

class VirtualDisplay {
  public:
    /// `screen`: "1280x800". name() stays empty without Xvfb.
    explicit VirtualDisplay(const std::string& screen) {
        int fds[2];
        if (pipe(fds) != 0) return;
        server_.emplace(std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(fds[1]), "-screen", "0",
                                                 screen + "x24", "-nolisten", "tcp", "-noreset"});
        close(fds[1]);
        char c = 0;
        std::string number;
        while (server_->started() && read(fds[0], &c, 1) == 1 && c != '\n') number += c;
        close(fds[0]);
        if (!number.empty()) name_ = ":" + number;
    }

    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    std::optional<ChildProgram> server_;
    std::string name_;
};

}  // namespace dermis
