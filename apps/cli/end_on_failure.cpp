// Memory that fails inside a driver or a library is not thrown through its code: that code holds locks and
// has no handler, and what the destructors after it would do is unknown. The program ends where the failure
// is. The handlers therefore neither allocate nor lock, and write by the system call.

#include "end_on_failure.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "dermis/base/file.h"

namespace dermis::cli {
namespace {

constexpr std::string_view kOutOfMemory = "out of memory; try a smaller size, fewer samples or smaller maps";

// One line, however many threads fail: only the first returns.
void begin_end() {
    static std::atomic_flag ended;
    while (ended.test_and_set()) ::pause();
    end_temporary_files();
}

struct Line {
    std::array<char, 512> text{};
    size_t length = 0;

    Line& add(std::string_view part) {
        for (const char c : part) {
            if (length + 1 == text.size()) break;
            text[length++] = (c >= ' ' && c != 127) ? c : ' ';
        }
        return *this;
    }
    void write() {
        text[length++] = '\n';
        constexpr std::string_view kClear = "\r\x1b[K";  // a line of progress
        if (::isatty(STDERR_FILENO) == 1 && ::write(STDERR_FILENO, kClear.data(), kClear.size()) < 0) return;
        // Nothing is left to tell it to when standard error fails.
        if (::write(STDERR_FILENO, text.data(), length) < 0) return;
    }
};

[[noreturn]] void end_with(std::string_view first, std::string_view second = {}) {
    begin_end();
    Line().add("dermis: ").add(first).add(second).write();
    ::_exit(1);
}

void on_no_memory() {
    end_with(kOutOfMemory);
}

void on_terminate() {
    if (!std::current_exception()) end_with("a library ended the program; memory may be short");
    try {
        throw;
    } catch (const std::bad_alloc&) {
        end_with(kOutOfMemory);
    } catch (const std::system_error& thrown) {
        end_with("the system gives no thread or lock; raise the limit on processes (ulimit -u): ",
                 thrown.what());
    } catch (const std::exception& thrown) {
        end_with(thrown.what());
    } catch (...) {
        end_with("a library ended the program; memory may be short");
    }
}

// abort() is how libraries end a program on purpose, mostly for want of memory.
extern "C" void on_abort(int) {
    end_with("a library ended the program (SIGABRT); memory may be short");
}

extern "C" void on_crash(int signal) {
    begin_end();
    Line()
        .add("dermis: crashed (")
        .add(signal == SIGSEGV  ? "SIGSEGV"
             : signal == SIGBUS ? "SIGBUS"
             : signal == SIGFPE ? "SIGFPE"
                                : "SIGILL")
        .add("), in Dermis, a library or the Vulkan driver; memory may be short")
        .write();
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

// A sanitizer or a debugger that handles the signal already keeps it.
void handle_unless_handled(int signal, void (*handler)(int)) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK | SA_NODEFER;
    ::sigaction(signal, &action, nullptr);
}

}  // namespace

void end_on_failure() {
    std::set_new_handler(on_no_memory);
    std::set_terminate(on_terminate);
    // A stack that overflowed cannot hold the handler's frame.
    alignas(16) static std::array<char, 65536> stack;
    const stack_t alternative{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
    ::sigaltstack(&alternative, nullptr);
    handle_unless_handled(SIGABRT, on_abort);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) handle_unless_handled(signal, on_crash);
}

}  // namespace dermis::cli
