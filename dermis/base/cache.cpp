#include "dermis/base/cache.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/system/system.h"

namespace dermis::inline base {
namespace fs = std::filesystem;
namespace {

constexpr size_t kChecksumBytes = 32;

// The entry's name is part of the checksum, so that an entry under another's name reads as absent.
std::string checksum(std::string_view kind, std::string_view hash, std::span<const std::byte> bytes) {
    return Hasher().add(kind).add(hash).add(bytes).hex();
}

fs::path entry_path(std::string_view kind, std::string_view hash) {
    return cache_directory() / kind / hash;
}

// The content of a file, if it is the entry of this name.
std::optional<std::vector<std::byte>> content(const fs::path& path, std::string_view kind,
                                              std::string_view hash) {
    Result<std::vector<std::byte>> file = read_file(path);
    if (!file || file->size() < kChecksumBytes) return std::nullopt;
    const size_t content_bytes = file->size() - kChecksumBytes;
    const std::string stored(reinterpret_cast<const char*>(file->data()) + content_bytes, kChecksumBytes);
    file->resize(content_bytes);
    if (stored != checksum(kind, hash, *file)) return std::nullopt;
    return std::move(*file);
}

struct Entry {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes = 0;
};

// Regular files in the folders of the cache. What another process removes meanwhile is left out.
std::vector<Entry> cache_files() {
    std::vector<Entry> found;
    std::error_code ec;
    // A loop over the range would throw where a folder cannot be read to its end.
    for (fs::directory_iterator folder(cache_directory(), ec), end; folder != end; folder.increment(ec)) {
        std::error_code unread;
        if (!folder->is_directory(unread) || folder->is_symlink(unread)) continue;
        for (fs::directory_iterator file(folder->path(), unread); file != end; file.increment(unread)) {
            std::error_code gone;
            if (!file->is_regular_file(gone) || file->is_symlink(gone)) continue;
            const auto used = file->last_write_time(gone);
            if (gone) continue;
            const uint64_t bytes = file->file_size(gone);
            if (!gone) found.push_back({file->path(), used, bytes});
        }
    }
    return found;
}

// An entry's time is that of its last use. Once an hour: a write costs more than the read on some disks.
void mark_used(const fs::path& path) {
    std::error_code ec;
    const auto now = fs::file_time_type::clock::now();
    if (now - fs::last_write_time(path, ec) > std::chrono::hours(1) && !ec)
        fs::last_write_time(path, now, ec);
}

}  // namespace

fs::path cache_directory() {
    if (const fs::path own = system::environment_path("DERMIS_CACHE"); !own.empty()) return own;
    if (const fs::path user = system::user_cache_directory(); !user.empty()) return user;
    return fs::temp_directory_path() / "dermis-cache";
}

std::optional<std::vector<std::byte>> cache_load(std::string_view kind, std::string_view hash) {
    std::error_code ec;
    const fs::path path = entry_path(kind, hash);
    if (!fs::is_regular_file(path, ec)) return std::nullopt;
    auto found = content(path, kind, hash);
    if (found) mark_used(path);
    return found;
}

void limit_cache(uint64_t most_bytes) {
    std::vector<Entry> files = cache_files();
    uint64_t sum = 0;
    for (const Entry& file : files) sum += file.bytes;
    if (sum <= most_bytes) return;
    std::ranges::sort(files, {}, &Entry::used);
    const auto yesterday = fs::file_time_type::clock::now() - std::chrono::hours(24);
    for (const Entry& file : files) {
        if (sum <= most_bytes / 4 * 3 || file.used > yesterday) return;
        const std::string kind = file.path.parent_path().filename().string();
        if (!content(file.path, kind, file.path.filename().string())) continue;
        std::error_code ec;
        if (fs::remove(file.path, ec)) sum -= file.bytes;
    }
}

bool cache_store(std::string_view kind, std::string_view hash, const std::vector<std::byte>& bytes) {
    // Something else in the entry's place (a pipe waits for its reader) stays.
    std::error_code ec;
    const fs::path path = entry_path(kind, hash);
    if (fs::exists(path, ec) && !fs::is_regular_file(path, ec)) return false;
    std::vector<std::byte> file = bytes;
    const std::string sum = checksum(kind, hash, bytes);
    file.insert(file.end(), as_bytes(sum).begin(), as_bytes(sum).end());
    const bool stored = write_file(path, file).ok();
    static std::once_flag limited;
    std::call_once(limited, [] { limit_cache(); });
    return stored;
}

}  // namespace dermis::inline base
