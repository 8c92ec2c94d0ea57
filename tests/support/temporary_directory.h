#pragma once
// A directory that lives as long as a test.

#include <filesystem>
#include <iterator>
#include <random>
#include <string>

namespace dermis {

struct TemporaryDirectory {
    std::filesystem::path path;
    TemporaryDirectory() {
        std::random_device random;
        do path = std::filesystem::temp_directory_path() / ("dermis-test-" + std::to_string(random()));
        while (!std::filesystem::create_directory(path));
    }
    ~TemporaryDirectory() {
        std::error_code ec;
        std::filesystem::remove_all(path, ec);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

    [[nodiscard]] size_t file_count() const {
        return size_t(std::distance(std::filesystem::directory_iterator(path), {}));
    }
};

}  // namespace dermis
