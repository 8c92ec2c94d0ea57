#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "dermis/base/file.h"
#include "dermis/base/system/system.h"

namespace dermis::inline base::system {
namespace fs = std::filesystem;
namespace {

std::string errno_text() {
    return std::strerror(errno);
}

struct Descriptor {
    int fd = -1;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

void (*g_clean_up)() noexcept = nullptr;

extern "C" void clean_up_and_end(int signal) {
    g_clean_up();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

InputFile::~InputFile() {
    if (handle_ >= 0) ::close(int(handle_));
}

Result<void> InputFile::open(const fs::path& path) {
    handle_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (handle_ < 0) return Error{errno_text()};
    return {};
}

Result<InputFile::Kind> InputFile::kind(uint64_t& bytes) const {
    struct stat status {};
    if (::fstat(int(handle_), &status) != 0) return Error{errno_text()};
    bytes = uint64_t(status.st_size);
    return S_ISREG(status.st_mode) ? Kind::file : S_ISDIR(status.st_mode) ? Kind::directory : Kind::other;
}

Result<size_t> InputFile::read(std::span<std::byte> to) {
    for (;;) {
        const ssize_t got = ::read(int(handle_), to.data(), to.size());
        if (got >= 0) return size_t(got);
        if (errno != EINTR) return Error{errno_text()};
    }
}

Result<void> write_through(const fs::path& path, std::span<const std::byte> bytes) {
    Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (file.fd < 0) return Error{errno_text()};
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return Error{errno_text()};
        bytes = bytes.subspan(size_t(written));
    }
    if (::fsync(file.fd) != 0 && errno != EINVAL) return Error{errno_text()};
    const int closing = std::exchange(file.fd, -1);
    if (::close(closing) != 0) return Error{errno_text()};
    return {};
}

std::error_code replace_file(const fs::path& from, const fs::path& to) noexcept {
    std::error_code ec;
    fs::rename(from, to, ec);
    return ec;
}

void remove_file(const char* path) noexcept {
    ::unlink(path);
}

unsigned long process_id() noexcept {
    return static_cast<unsigned long>(::getpid());
}

void before_the_end(void (*clean_up)() noexcept) {
    g_clean_up = clean_up;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, clean_up_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);  // nohup
}

fs::path environment_path(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

fs::path user_cache_directory() {
    if (const fs::path xdg = environment_path("XDG_CACHE_HOME"); !xdg.empty()) return xdg / "dermis";
    if (const fs::path home = environment_path("HOME"); !home.empty()) return home / ".cache" / "dermis";
    return {};
}

bool stderr_is_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace dermis::inline base::system

std::filesystem::path dermis::utf8_path(std::string_view name) {
    return name;
}
