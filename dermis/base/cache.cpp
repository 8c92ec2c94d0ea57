#include "dermis/base/cache.h"

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
    Result<std::vector<std::byte>> file = read_file(path);
    if (!file || file->size() < kChecksumBytes) return std::nullopt;
    const size_t content_bytes = file->size() - kChecksumBytes;
    const std::string stored(reinterpret_cast<const char*>(file->data()) + content_bytes, kChecksumBytes);
    file->resize(content_bytes);
    if (stored != checksum(kind, hash, *file)) return std::nullopt;
    return std::move(*file);
}

bool cache_store(std::string_view kind, std::string_view hash, const std::vector<std::byte>& bytes) {
    // Something else in the entry's place (a pipe waits for its reader) stays.
    std::error_code ec;
    const fs::path path = entry_path(kind, hash);
    if (fs::exists(path, ec) && !fs::is_regular_file(path, ec)) return false;
    std::vector<std::byte> file = bytes;
    const std::string sum = checksum(kind, hash, bytes);
    file.insert(file.end(), as_bytes(sum).begin(), as_bytes(sum).end());
    return write_file(path, file).ok();
}

}  // namespace dermis::inline base
