#pragma once
// A display of our own (Xvfb), so that windows open on a machine that has none, and never on somebody's
// screen.

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

extern char** environ;

namespace dermis {

class VirtualDisplay {
  public:
    /// `screen`: "1280x800". name() stays empty when there is no Xvfb.
    explicit VirtualDisplay(const std::string& screen) {
        int fds[2];
        if (pipe(fds) != 0) return;
        const std::string number_fd = std::to_string(fds[1]), depth = screen + "x24";
        const char* arguments[] = {"Xvfb",      "-displayfd", number_fd.c_str(),
                                   "-screen",   "0",          depth.c_str(),
                                   "-nolisten", "tcp",        nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
        const int spawned =
            posix_spawnp(&server_, "Xvfb", &actions, nullptr, const_cast<char**>(arguments), environ);
        posix_spawn_file_actions_destroy(&actions);
        close(fds[1]);
        if (spawned != 0) server_ = 0;
        char c = 0;
        std::string number;
        while (server_ && read(fds[0], &c, 1) == 1 && c != '\n') number += c;
        close(fds[0]);
        if (!number.empty()) name_ = ":" + number;
    }
    ~VirtualDisplay() {
        if (!server_) return;
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    pid_t server_ = 0;
    std::string name_;
};

}  // namespace dermis
