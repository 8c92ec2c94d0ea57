#include "dermis/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace dermis {
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

fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter = 0;
    fs::path name = path;
    name.replace_filename("." + path.stem().string() + ".part" + std::to_string(::getpid()) + "-" +
                          std::to_string(counter++) + path.extension().string());
    return name;
}

Result<void> write_all(const fs::path& path, std::span<const std::byte> bytes) {
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

Result<void> make_parent(const fs::path& path) {
    if (!path.has_parent_path()) return {};
    std::error_code ec;
    fs::create_directories(path.parent_path(), ec);
    if (ec) return Error{path.parent_path().string() + ": cannot make the directory: " + ec.message()};
    return {};
}

// Reads to the end: the system says 0 for the size of some files (/proc).
template <class Container>
Result<Container> read_into(const fs::path& path) {
    // Opening a pipe would wait for its writer.
    Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (file.fd < 0) return Error{path.string() + ": cannot open: " + errno_text()};
    struct stat status {};
    if (::fstat(file.fd, &status) != 0) return Error{path.string() + ": cannot read: " + errno_text()};
    if (S_ISDIR(status.st_mode)) return Error{path.string() + ": is a directory, not a file"};
    if (!S_ISREG(status.st_mode))
        return Error{path.string() + ": is a pipe, device or socket, not a file; copy it to a file first"};
    Container content;
    size_t filled = 0;
    for (;;) {
        if (filled > kMaxFileBytes || uint64_t(status.st_size) > kMaxFileBytes)
            return Error{path.string() + ": larger than 2 GiB, which no input of dermis is"};
        if (filled == content.size())
            content.resize(std::max<size_t>(size_t(status.st_size) + 1, filled * 2 + 4096));
        const ssize_t got = ::read(file.fd, content.data() + filled, content.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return Error{path.string() + ": cannot read: " + errno_text()};
        if (got == 0) break;
        filled += size_t(got);
    }
    content.resize(filled);
    return content;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const fs::path& path) {
    return read_into<std::vector<std::byte>>(path);
}
Result<std::string> read_text_file(const fs::path& path) {
    return read_into<std::string>(path);
}

Result<void> write_beside(const fs::path& path, const std::function<Result<void>(const fs::path&)>& write) {
    std::error_code ec;
    if (fs::is_directory(path, ec)) return Error{path.string() + ": is a directory; give a file name"};
    // Devices and pipes (/dev/stdout, /dev/full) cannot be renamed over.
    if (fs::exists(path, ec) && !fs::is_regular_file(path, ec)) {
        const Result<void> direct = write(path);
        if (!direct) return Error{path.string() + ": cannot write: " + direct.error().message};
        return {};
    }
    if (Result<void> made = make_parent(path); !made) return made;
    const fs::path temporary = temporary_name(path);
    const Result<void> written = write(temporary);
    if (!written) {
        fs::remove(temporary, ec);
        return Error{path.string() + ": cannot write: " + written.error().message};
    }
    fs::rename(temporary, path, ec);
    if (ec) {
        const std::string reason = ec.message();
        fs::remove(temporary, ec);
        return Error{path.string() + ": cannot write: " + reason};
    }
    return {};
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
    return write_beside(path, [&](const fs::path& temporary) { return write_all(temporary, bytes); });
}

Result<void> try_output(const fs::path& path) {
    std::error_code ec;
    if (fs::is_directory(path, ec)) return Error{path.string() + ": is a directory; give a file name"};
    // Nothing of a device or a pipe may be used up.
    if (fs::exists(path, ec) && !fs::is_regular_file(path, ec)) return {};
    std::vector<fs::path> missing;
    for (fs::path at = fs::absolute(path, ec).parent_path(); !at.empty() && !fs::exists(at, ec);
         at = at.parent_path())
        missing.push_back(at);
    const fs::path trial = temporary_name(path);
    Result<void> tried = make_parent(path);
    if (tried) {
        tried = write_all(trial, {});
        if (!tried) tried = Error{path.string() + ": cannot write: " + tried.error().message};
    }
    fs::remove(trial, ec);
    for (const fs::path& made : missing) fs::remove(made, ec);
    return tried;
}

Result<void> write_text_file(const fs::path& path, std::string_view text) {
    return write_file(path, as_bytes(text));
}

}  // namespace dermis
