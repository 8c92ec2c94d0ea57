#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "dermis/gpu/texture_state.h"

namespace dermis::gpu {
namespace {

Error geometry_error(std::string_view name, const std::string& what) {
    return Error{"geometry '" + std::string(name) + "': " + what};
}

// The number of vertices all streams agree on.
Result<size_t> check_streams(std::string_view name, std::span<const VertexStream> streams,
                             std::span<const uint32_t> indices) {
    if (streams.empty() || indices.empty()) return geometry_error(name, "has no vertices or no triangles");
    if (indices.size() % 3) return geometry_error(name, "its indices are no whole number of triangles");
    size_t count = 0;
    for (const VertexStream& stream : streams) {
        if (stream.components < 1 || stream.components > 4 ||
            stream.values.size() % size_t(stream.components))
            return geometry_error(name, "stream '" + stream.name + "' is not a whole number of vertices");
        const size_t vertices = stream.values.size() / size_t(stream.components);
        if (&stream != &streams.front() && vertices != count)
            return geometry_error(name, fmt::format("stream '{}' has {} vertices, '{}' has {}", stream.name,
                                                    vertices, streams.front().name, count));
        count = vertices;
    }
    if (const uint32_t last = *std::ranges::max_element(indices); last >= count)
        return geometry_error(name, fmt::format("index {} of only {} vertices", last, count));
    return count;
}

}  // namespace

Result<Buffer> upload_buffer(Device::State& device, std::string_view name, VkBufferUsageFlags usage,
                             std::span<const std::byte> bytes) {
    const Context& context = device.context;
    DERMIS_TRY_ASSIGN(Buffer buffer,
                      make_buffer(context, name, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  MemoryUse::device));
    DERMIS_TRY_ASSIGN(Buffer staging, make_buffer(context, "staging " + std::string(name), bytes.size(),
                                                  VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload));
    std::memcpy(staging.mapped, bytes.data(), bytes.size());
    DERMIS_TRY(run_once(device, "the upload of " + std::string(name), [&](VkCommandBuffer commands) {
        const VkBufferCopy region = {.size = bytes.size()};
        context.vk.vkCmdCopyBuffer(commands, staging.handle.get(), buffer.handle.get(), 1, &region);
    }));
    return buffer;
}

namespace {

// Compute passes move vertices.
constexpr VkBufferUsageFlags kStreamUsage =
    VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

// `put` makes data of a name, a use of buffers, and bytes.
template <class Put>
Result<std::unique_ptr<Geometry::State>> make_state(std::string_view name,
                                                    std::span<const VertexStream> streams,
                                                    std::span<const uint32_t> indices, const Put& put) {
    DERMIS_TRY_ASSIGN(const size_t vertices, check_streams(name, streams, indices));
    auto state = std::make_unique<Geometry::State>();
    state->name = name;
    state->vertex_count = uint32_t(vertices);
    state->index_count = uint32_t(indices.size());
    for (const VertexStream& stream : streams) {
        DERMIS_TRY_ASSIGN(GeometryData data,
                          put(state->name + " " + stream.name, kStreamUsage, std::as_bytes(stream.values)));
        state->streams[stream.name] = {stream.components, std::move(data)};
    }
    DERMIS_TRY_ASSIGN(state->indices, put(state->name + " indices", VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                          std::as_bytes(indices)));
    return state;
}

}  // namespace

Result<Geometry> Geometry::upload(Device& device, std::string_view name,
                                  std::span<const VertexStream> streams, std::span<const uint32_t> indices) {
    const auto put = [&](const std::string& part, VkBufferUsageFlags usage,
                         std::span<const std::byte> bytes) -> Result<GeometryData> {
        DERMIS_TRY_ASSIGN(Buffer buffer, upload_buffer(device.state(), part, usage, bytes));
        return GeometryData{.buffer = std::move(buffer)};
    };
    DERMIS_TRY_ASSIGN(std::unique_ptr<State> state, make_state(name, streams, indices, put));
    return Geometry(std::move(state));
}

Result<Geometry> Geometry::streamed(std::string_view name, std::span<const VertexStream> streams,
                                    std::span<const uint32_t> indices) {
    const auto put = [](const std::string&, VkBufferUsageFlags,
                        std::span<const std::byte> bytes) -> Result<GeometryData> {
        return GeometryData{.bytes = {bytes.begin(), bytes.end()}};
    };
    DERMIS_TRY_ASSIGN(std::unique_ptr<State> state, make_state(name, streams, indices, put));
    return Geometry(std::move(state));
}

Result<void> Geometry::put(Device& device, const VertexStream& stream) {
    const auto found = state_->streams.find(stream.name);
    const bool is_other = found != state_->streams.end() && found->second.components != stream.components;
    if (is_other || stream.values.size() != size_t(stream.components) * state_->vertex_count)
        return geometry_error(state_->name, "stream '" + stream.name + "' does not fit its vertices");
    DERMIS_TRY_ASSIGN(Buffer buffer, upload_buffer(device.state(), state_->name + " " + stream.name,
                                                   kStreamUsage, std::as_bytes(stream.values)));
    State::Stream& kept = state_->streams[stream.name];
    kept.components = stream.components;
    kept.data.buffer = std::move(buffer);
    return {};
}

Result<std::vector<float>> Geometry::read(Device& device, std::string_view stream) const {
    const auto found = state_->streams.find(stream);
    if (found == state_->streams.end() || !found->second.data.buffer.handle)
        return geometry_error(state_->name, "has no stream '" + std::string(stream) + "' on the device");
    const Buffer& source = found->second.data.buffer;
    const Context& context = device.state().context;
    DERMIS_TRY(device.finish());
    DERMIS_TRY_ASSIGN(const Buffer copy, make_buffer(context, "copy of " + state_->name, source.size,
                                                     VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback));
    DERMIS_TRY(run_once(device.state(), "reading " + state_->name, [&](VkCommandBuffer commands) {
        const VkBufferCopy region = {.size = source.size};
        context.vk.vkCmdCopyBuffer(commands, source.handle.get(), copy.handle.get(), 1, &region);
    }));
    std::vector<float> values(size_t(found->second.components) * state_->vertex_count);
    std::memcpy(values.data(), copy.mapped, values.size() * sizeof(float));
    return values;
}

Result<Array> Array::upload(Device& device, std::string_view name, std::span<const std::byte> bytes) {
    DERMIS_TRY_ASSIGN(Buffer buffer,
                      upload_buffer(device.state(), name, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, bytes));
    return Array(std::make_unique<State>(State{{.buffer = std::move(buffer)}}));
}

Array Array::streamed(std::span<const std::byte> bytes) {
    return Array(std::make_unique<State>(State{{.bytes = {bytes.begin(), bytes.end()}}}));
}

uint64_t Array::bytes() const {
    return state_->data.buffer.handle ? state_->data.buffer.size : state_->data.bytes.size();
}

Array::Array(std::unique_ptr<State> state) : state_(std::move(state)) {}
Array::~Array() = default;
Array::Array(Array&&) noexcept = default;
Array& Array::operator=(Array&&) noexcept = default;

uint32_t Geometry::vertex_count() const {
    return state_->vertex_count;
}

uint64_t Geometry::stream_bytes(std::string_view stream) const {
    const auto found = state_->streams.find(stream);
    if (found == state_->streams.end()) return 0;
    return uint64_t(state_->vertex_count) * uint64_t(found->second.components) * sizeof(float);
}

Geometry::Geometry(std::unique_ptr<State> state) : state_(std::move(state)) {}
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

}  // namespace dermis::gpu
