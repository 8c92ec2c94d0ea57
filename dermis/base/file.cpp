#include "dermis/base/file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <thread>

#include "dermis/base/system/system.h"

namespace dermis::inline base {
namespace fs = std::filesystem;
namespace {

// The temporary files that exist now, where a signal handler can read them: it may neither lock nor allocate.
// A file beyond the slots, or with a longer path, is not removed by a signal.
struct Slot {
    enum State { unused, filling, filled };
    std::atomic<State> state = unused;
    fs::path::value_type path[1024] = {};
};
std::array<Slot, 32> g_slots;

// While a program ends, its other threads still run, and one could make a temporary file after
// end_temporary_files() has removed them. Code that writes a temporary file holds a Writing. Once the end has
// begun, its constructor never returns; the removal first waits for the other threads that hold one, 300 ms
// at most: by then a file that is being written exists, and is removed.
std::atomic<bool> g_ending = false;
std::atomic<int> g_writing = 0;
thread_local int t_writing = 0;  // a signal may come to a thread that holds one

class Writing {
  public:
    Writing() {
        ++t_writing;
        ++g_writing;
        if (!g_ending) return;
        --g_writing;
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    ~Writing() {
        --g_writing;
        --t_writing;
    }
    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;
};

// A file in the folder of its target, with a unique name; removed at the end unless it was renamed.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target) : path_(target) {
        static std::atomic<unsigned> counter = 0;
        path_.replace_filename(".");
        path_ += target.stem();
        path_ += ".part" + std::to_string(system::process_id()) + "-" + std::to_string(counter++);
        path_ += target.extension();
        const fs::path::string_type& text = path_.native();
        for (Slot& slot : g_slots) {
            Slot::State free = Slot::unused;
            if (text.size() >= std::size(slot.path) ||
                !slot.state.compare_exchange_strong(free, Slot::filling))
                continue;
            std::ranges::copy(text, slot.path);
            slot.path[text.size()] = 0;
            slot.state = Slot::filled;
            slot_ = &slot;
            break;
        }
    }
    ~TemporaryFile() {
        std::error_code ec;
        fs::remove(path_, ec);
        if (slot_) slot_->state = Slot::unused;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
    Slot* slot_ = nullptr;
};

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
    system::InputFile file;
    if (Result<void> opened = file.open(path); !opened)
        return Error{path.string() + ": cannot open: " + opened.error().message};
    uint64_t size = 0;
    const Result<system::InputFile::Kind> kind = file.kind(size);
    if (!kind) return Error{path.string() + ": cannot read: " + kind.error().message};
    if (*kind == system::InputFile::Kind::directory)
        return Error{path.string() + ": is a directory, not a file"};
    if (*kind == system::InputFile::Kind::other)
        return Error{path.string() + ": is a pipe, device or socket, not a file; copy it to a file first"};
    Container content;
    size_t filled = 0;
    for (;;) {
        if (filled > kMaxFileBytes || size > kMaxFileBytes)
            return Error{path.string() + ": larger than 2 GiB, which no input of dermis is"};
        if (filled == content.size()) content.resize(std::max<size_t>(size_t(size) + 1, filled * 2 + 4096));
        const Result<size_t> got =
            file.read(std::as_writable_bytes(std::span(content.data() + filled, content.size() - filled)));
        if (!got) return Error{path.string() + ": cannot read: " + got.error().message};
        if (*got == 0) break;
        filled += *got;
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
    DERMIS_TRY(make_parent(path));
    const TemporaryFile temporary(path);
    Result<void> written;
    {
        const Writing writing;
        written = write(temporary.path());
    }
    if (!written) return Error{path.string() + ": cannot write: " + written.error().message};
    ec = system::replace_file(temporary.path(), path);
    if (ec) return Error{path.string() + ": cannot write: " + ec.message()};
    return {};
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
    return write_beside(path,
                        [&](const fs::path& temporary) { return system::write_through(temporary, bytes); });
}

Result<void> write_files(std::span<const FileContent> files) {
    std::error_code ec;
    std::deque<TemporaryFile> temporaries;
    std::vector<const FileContent*> renamed;
    for (const FileContent& file : files) {
        if (fs::is_directory(file.path, ec))
            return Error{file.path.string() + ": is a directory; give a file name"};
        // Devices and pipes are written directly: see write_beside().
        const bool direct = fs::exists(file.path, ec) && !fs::is_regular_file(file.path, ec);
        if (direct) {
            DERMIS_TRY(write_file(file.path, file.bytes));
            continue;
        }
        DERMIS_TRY(make_parent(file.path));
        renamed.push_back(&file);
        const fs::path& temporary = temporaries.emplace_back(file.path).path();
        const Writing writing;
        const Result<void> written = system::write_through(temporary, file.bytes);
        if (!written) return Error{file.path.string() + ": cannot write: " + written.error().message};
    }
    std::vector<const fs::path*> made;  // did not exist before
    made.reserve(renamed.size());       // from here on nothing allocates, so that the renames are all done
    for (size_t i = 0; i < renamed.size(); ++i) {
        const fs::path& path = renamed[i]->path;
        const bool is_new = !fs::exists(path, ec);
        if (const std::error_code reason = system::replace_file(temporaries[i].path(), path)) {
            for (const fs::path* file : made) fs::remove(*file, ec);
            return Error{path.string() + ": cannot write: " + reason.message()};
        }
        if (is_new) made.push_back(&path);
    }
    return {};
}

Result<void> try_output(const fs::path& path) {
    std::error_code ec;
    if (fs::is_directory(path, ec)) return Error{path.string() + ": is a directory; give a file name"};
    // A device or a pipe is not tried: what is written to it cannot be taken back.
    if (fs::exists(path, ec) && !fs::is_regular_file(path, ec)) return {};
    std::vector<fs::path> missing;
    for (fs::path at = fs::absolute(path, ec).parent_path(); !at.empty() && !fs::exists(at, ec);
         at = at.parent_path())
        missing.push_back(at);
    Result<void> tried = make_parent(path);
    if (tried) {
        const TemporaryFile trial(path);
        const Writing writing;
        tried = system::write_through(trial.path(), {});
        if (!tried) tried = Error{path.string() + ": cannot write: " + tried.error().message};
    }
    for (const fs::path& made : missing) fs::remove(made, ec);
    return tried;
}

void end_temporary_files() noexcept {
    g_ending = true;
    for (int waited_ms = 0; g_writing > t_writing && waited_ms < 300; ++waited_ms)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (const Slot& slot : g_slots)
        if (slot.state == Slot::filled) system::remove_file(slot.path);
}

void remove_temporary_files_on_signals() {
    system::before_the_end(end_temporary_files);
}

Result<void> write_text_file(const fs::path& path, std::string_view text) {
    return write_file(path, as_bytes(text));
}

}  // namespace dermis::inline base
