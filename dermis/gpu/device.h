#pragma once
// The Vulkan 1.3 device: a GPU when there is one, lavapipe when there is none. No Vulkan type shows here.

#include <climits>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/technique/pass_list.h"

namespace dermis::gpu {

struct DeviceOptions {
    bool validation = false;  ///< core and synchronization validation; messages collect in Device::messages()
    /// Gets each of those messages as it comes, from any thread; also those of the device's destruction.
    std::function<void(const std::string&)> on_message = {};
    /// Pick a device by part of its name, any case; empty: discrete, then integrated, then CPU.
    std::string name_contains = {};
    /// Extensions for a window (glfwGetRequiredInstanceExtensions); empty: no window.
    std::vector<std::string> instance_extensions = {};
    /// Pipelines keep the compiler's statistics (statistics.h) and are compiled again, never taken from the
    /// cache on disk. Such a device draws nothing.
    bool keep_statistics = false;
    /// Descriptor sets come from a pool even where VK_KHR_push_descriptor exists: tests of the pool run on
    /// any device.
    bool pooled_descriptors = false;
    /// Storage buffers that a stage may bind, if the device has more: for tests of smaller devices.
    int most_storage_buffers = INT_MAX;
    /// Above this number the device destroys pipelines that were idle longest. On a CPU one of a technique
    /// takes some MB.
    size_t most_pipelines = 256;
};

struct DeviceInfo {
    std::string name, driver;
    std::string vulkan;  ///< the version it supports: "1.3.230"
    bool is_cpu = false;
    std::vector<int> sample_counts;    ///< 1, 2, 4, ...
    std::vector<std::string> missing;  ///< what it lacks to run dermis; empty: it can
    int push_descriptors = 0;  ///< most bindings of a pushed set; larger sets come from a pool, at 0 all
    int storage_buffers = 0;   ///< most that a stage binds; 4 at least
};

/// Every Vulkan device, the one that Device::create would take first. Errors: no loader or driver.
[[nodiscard]] Result<std::vector<DeviceInfo>> list_devices();

/// Movable handle; everything made from it must be destroyed first. Not for several threads at once.
class Device {
  public:
    /// Errors: no loader, driver or suitable device, no validation layer; each says what to install.
    [[nodiscard]] static Result<Device> create(const DeviceOptions& options);
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;

    [[nodiscard]] const DeviceInfo& info() const;
    /// Messages of the validation layers since creation; tests expect none.
    [[nodiscard]] std::vector<std::string> messages() const;

    /// Waits for everything that was submitted. Error: the device was lost.
    [[nodiscard]] Result<void> finish();
    /// Vulkan objects and allocations since creation.
    [[nodiscard]] uint64_t created_objects() const;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

  private:
    explicit Device(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// How a texture continues beyond its edges.
enum class AddressMode { repeat, clamp, mirror };

/// Mip levels from large to small, layers (6 faces of a cube, in +X -X +Y -Y +Z -Z order) inside each level.
struct TextureData {
    std::string name;
    ImageFormat format = ImageFormat::rgba8;
    bool srgb = false;  ///< rgba8 only: decoded on sampling
    int width = 1, height = 1, layers = 1, mips = 1;
    bool cube = false;
    std::vector<std::byte> bytes;
    bool generate_mips = false;  ///< on the device, from level 0 (bytes holds level 0 only)
    AddressMode address_u = AddressMode::repeat,
                address_v = AddressMode::repeat;  ///< where a shader has a sampler2D
};

class Texture {
  public:
    [[nodiscard]] static Result<Texture> upload(Device& device, const TextureData& data);
    /// Bytes of level 0, all layers.
    [[nodiscard]] uint64_t bytes() const;
    [[nodiscard]] size_t bytes_per_texel() const;
    ~Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

  private:
    explicit Texture(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Numbers that compute shaders read and write, as they lie in a storage buffer of scalar layout.
class Array {
  public:
    [[nodiscard]] static Result<Array> upload(Device& device, std::string_view name,
                                              std::span<const std::byte> bytes);
    /// For what changes every frame: stays on the CPU, and each frame that reads it takes it along.
    [[nodiscard]] static Array streamed(std::span<const std::byte> bytes);
    [[nodiscard]] uint64_t bytes() const;
    ~Array();
    Array(Array&&) noexcept;
    Array& operator=(Array&&) noexcept;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

  private:
    explicit Array(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Vertex streams by the name of the vertex shader's input: position_mm (3 floats), normal (3), tangent (4),
/// uv (2), occlusion (1).
struct VertexStream {
    std::string name;
    int components = 3;
    std::span<const float> values;
};

class Geometry {
  public:
    [[nodiscard]] static Result<Geometry> upload(Device& device, std::string_view name,
                                                 std::span<const VertexStream> streams,
                                                 std::span<const uint32_t> indices);
    /// For what changes every frame: stays on the CPU, and each frame that draws it takes it along.
    [[nodiscard]] static Result<Geometry> streamed(std::string_view name,
                                                   std::span<const VertexStream> streams,
                                                   std::span<const uint32_t> indices);
    /// New values of a stream, or one more stream. Waits until frames that read the old ones are done.
    [[nodiscard]] Result<void> put(Device& device, const VertexStream& stream);
    /// A stream as the device has it. Waits for what was submitted. Error: no such stream on the device.
    [[nodiscard]] Result<std::vector<float>> read(Device& device, std::string_view stream) const;
    [[nodiscard]] uint32_t vertex_count() const;
    /// 0 where it has no such stream.
    [[nodiscard]] uint64_t stream_bytes(std::string_view stream) const;
    ~Geometry();
    Geometry(Geometry&&) noexcept;
    Geometry& operator=(Geometry&&) noexcept;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

  private:
    explicit Geometry(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::gpu
