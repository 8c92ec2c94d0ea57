#pragma once
// For every test that touches Vulkan: one device with validation, kept for the suites that follow, and no
// message from the validation layers after any test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/gpu/device.h"
#include "dermis/gpu/executor.h"

namespace dermis::gpu {

/// GLSL by name, compiled by glslc once per content and kept in the disk cache.
inline ShaderSource glsl_shaders(std::map<std::string, std::string, std::less<>> sources) {
    return [sources = std::move(sources)](std::string_view name) -> Result<std::vector<uint32_t>> {
        const auto found = sources.find(name);
        if (found == sources.end()) return Error{"no test shader '" + std::string(name) + "'"};
        const std::string hash = Hasher().add(name).add(found->second).hex();
        // The size is known after the compilation only, so this is cached() by hand.
        std::optional<std::vector<std::byte>> bytes = cache_load("test-shaders", hash);
        if (!bytes) {
            const auto root = std::filesystem::temp_directory_path() / ("dermis-test-" + hash);
            if (Result<void> written = write_text_file(root / "shaders" / name, found->second); !written)
                return written.error();
            const Result<std::vector<uint32_t>> compiled = disk_shaders(root)(name);
            std::filesystem::remove_all(root);
            if (!compiled) return compiled.error();
            const auto view = std::as_bytes(std::span(*compiled));
            bytes.emplace(view.begin(), view.end());
            cache_store("test-shaders", hash, *bytes);
        }
        std::vector<uint32_t> words(bytes->size() / 4);
        std::memcpy(words.data(), bytes->data(), bytes->size());
        return words;
    };
}

class GpuTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { open_device({.validation = true}); }
    static void open_device(const DeviceOptions& options) {
        if (device_ && pooled_ == options.pooled_descriptors) return;
        close_device();
        Result<Device> made = Device::create(options);
        if (!made) {  // no test of the program can go on
            std::fprintf(stderr, "%s\n", made.error().message.c_str());
            std::exit(1);
        }
        device_ = std::make_unique<Device>(std::move(*made));
        pooled_ = options.pooled_descriptors;
        taken_ = 0;
    }
    static void close_device() { device_.reset(); }

    void SetUp() override { ASSERT_TRUE(device_); }
    void TearDown() override {
        if (!device_) return;
        EXPECT_THAT(take_messages(), ::testing::IsEmpty());
    }

    static Device& device() { return *device_; }

    /// What the layers said since the last call.
    static std::vector<std::string> take_messages() {
        std::vector<std::string> all = device_->messages();
        const size_t before = std::exchange(taken_, all.size());
        all.erase(all.begin(), all.begin() + std::ptrdiff_t(std::min(before, all.size())));
        return all;
    }

    static Executor make_executor(ShaderSource shaders) {
        Result<Executor> executor = Executor::create(device(), std::move(shaders));
        EXPECT_TRUE(executor) << executor.error().message;
        return std::move(*executor);
    }

    /// Runs and expects success.
    static FrameResult run(Executor& executor, const PassList& list, const FrameInputs& inputs) {
        Result<FrameResult> result = executor.run(list, inputs);
        EXPECT_TRUE(result) << result.error().message;
        return result ? std::move(*result) : FrameResult{};
    }

    static Image read(Executor& executor, std::string_view name, int mip = 0) {
        Result<Image> image = executor.read(name, mip);
        EXPECT_TRUE(image) << image.error().message;
        return image ? std::move(*image) : Image{};
    }

  private:
    struct ClosesDevice : ::testing::Environment {
        void TearDown() override { close_device(); }
    };

    // Closed before the driver is unloaded.
    inline static ::testing::Environment* const at_end_ =
        ::testing::AddGlobalTestEnvironment(new ClosesDevice);
    inline static std::unique_ptr<Device> device_;
    inline static bool pooled_ = false;
    inline static size_t taken_ = 0;
};

}  // namespace dermis::gpu
