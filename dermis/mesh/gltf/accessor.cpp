// glTF 2.0, section 3.6.2: typed strided views into buffers, with sparse substitution on top.

#include "dermis/mesh/gltf/accessor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace dermis::inline mesh::gltf {
namespace {

enum ComponentType : uint64_t { kI8 = 5120, kU8 = 5121, kI16 = 5122, kU16 = 5123, kU32 = 5125, kF32 = 5126 };

size_t size_of(uint64_t type) {
    switch (type) {
        case kI8:
        case kU8:
            return 1;
        case kI16:
        case kU16:
            return 2;
        case kU32:
        case kF32:
            return 4;
        default:
            return 0;
    }
}

size_t components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    if (type == "MAT4") return 16;
    return 0;
}

struct Layout {
    uint64_t type = 0;
    size_t components = 0;
    uint64_t count = 0;
    bool normalized = false;

    [[nodiscard]] size_t element_size() const { return size_of(type) * components; }
};

template <class T>
T load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// Section 3.6.2.2: the exact dequantisation, signed values clamped at -1.
float load_float(const std::byte* at, const Layout& layout) {
    const bool n = layout.normalized;
    switch (layout.type) {
        case kI8:
            return n ? std::max(load<int8_t>(at) / 127.0f, -1.0f) : load<int8_t>(at);
        case kU8:
            return n ? load<uint8_t>(at) / 255.0f : load<uint8_t>(at);
        case kI16:
            return n ? std::max(load<int16_t>(at) / 32767.0f, -1.0f) : load<int16_t>(at);
        case kU16:
            return n ? load<uint16_t>(at) / 65535.0f : load<uint16_t>(at);
        case kU32:
            return float(load<uint32_t>(at));
        default:
            return load<float>(at);
    }
}

uint32_t load_index(const std::byte* at, uint64_t type) {
    if (type == kU8) return load<uint8_t>(at);
    if (type == kU16) return load<uint16_t>(at);
    return load<uint32_t>(at);
}

struct Strided {
    const std::byte* first = nullptr;
    size_t stride = 0;
};

// The view that `holder` (an accessor, or one half of a sparse one) names, checked to hold `layout`.
Strided locate(Document& document, const JsonView& holder, const Layout& layout) {
    const uint64_t view_index = holder["bufferView"].integer(0), offset = holder["byteOffset"].integer(0);
    const std::span<const std::byte> bytes = buffer_view(document, view_index);
    if (holder.failed()) return {};
    const uint64_t stated = document.view()["bufferViews"][size_t(view_index)]["byteStride"].integer(0);
    const uint64_t stride = stated == 0 ? layout.element_size() : stated;
    if (stride < layout.element_size() || stride > 65536)
        return holder.fail(fmt::format("byteStride {} does not fit elements of {} bytes", stride,
                                       layout.element_size())),
               Strided{};
    const uint64_t needed = layout.count == 0 ? 0 : (layout.count - 1) * stride + layout.element_size();
    if (offset > bytes.size() || needed > bytes.size() - offset)
        return holder.fail(fmt::format("passes the end of its buffer view ({} bytes)", bytes.size())),
               Strided{};
    return {bytes.data() + offset, size_t(stride)};
}

Layout read_layout(Document& document, const JsonView& accessor, size_t components) {
    Layout layout;
    layout.type = accessor["componentType"].integer(0);
    layout.components = components_of(accessor["type"].text(""));
    layout.count = accessor["count"].integer(0);
    layout.normalized = accessor["normalized"].boolean(false);
    if (accessor.failed()) return {};
    if (size_of(layout.type) == 0)
        return accessor["componentType"].fail(std::to_string(layout.type) + " is not a component type"),
               Layout{};
    if (layout.components != components)
        return accessor["type"].fail(fmt::format("must have {} components here", components)), Layout{};
    // Six indices a vertex is what a closed triangle mesh has.
    if (layout.count > uint64_t{document.max_vertices} * (components == 1 ? 6 : 1))
        return accessor["count"].fail(std::to_string(layout.count) + " is more than dermis loads"), Layout{};
    return layout;
}

// Calls set(element number, its bytes) for the base and then for the sparse substitutions.
template <class Set>
void for_each_element(Document& document, const JsonView& accessor, const Layout& layout, Set&& set) {
    if (accessor["bufferView"].exists()) {
        const Strided base = locate(document, accessor, layout);
        if (accessor.failed()) return;
        for (size_t i = 0; i < layout.count; ++i) set(i, base.first + i * base.stride);
    }
    const JsonView sparse = accessor["sparse"];
    if (!sparse.exists()) return;
    Layout values = layout, indices{.components = 1};
    values.count = indices.count = sparse["count"].integer(0);
    indices.type = sparse["indices"]["componentType"].integer(0);
    if (sparse.failed()) return;
    if (values.count > layout.count) return sparse["count"].fail("is more than the accessor's");
    if (indices.type != kU8 && indices.type != kU16 && indices.type != kU32)
        return sparse["indices"].fail("must be unsigned integers");
    const Strided at = locate(document, sparse["indices"], indices),
                  from = locate(document, sparse["values"], values);
    if (sparse.failed()) return;
    for (size_t i = 0; i < values.count; ++i) {
        const uint32_t target = load_index(at.first + i * at.stride, indices.type);
        if (target >= layout.count)
            return sparse["indices"].fail(fmt::format("index {} is out of range", target));
        set(target, from.first + i * from.stride);
    }
}

}  // namespace

std::vector<float> read_floats(Document& document, uint64_t index, size_t components) {
    const JsonView accessor = document.view()["accessors"][size_t(index)];
    const Layout layout = read_layout(document, accessor, components);
    // Before anything is allocated: a tiny file may state a huge count.
    if (!accessor.failed() && accessor["bufferView"].exists()) (void)locate(document, accessor, layout);
    if (accessor.failed()) return {};
    std::vector<float> values(layout.count * components);
    for_each_element(document, accessor, layout, [&](size_t i, const std::byte* at) {
        for (size_t c = 0; c < components; ++c)
            values[i * components + c] = load_float(at + c * size_of(layout.type), layout);
    });
    return accessor.failed() ? std::vector<float>{} : values;
}

std::vector<uint32_t> read_indices(Document& document, uint64_t index) {
    const JsonView accessor = document.view()["accessors"][size_t(index)];
    const Layout layout = read_layout(document, accessor, 1);
    if (accessor.failed()) return {};
    if (layout.type != kU8 && layout.type != kU16 && layout.type != kU32)
        return accessor.fail("indices must be unsigned integers"), std::vector<uint32_t>{};
    if (accessor["bufferView"].exists()) (void)locate(document, accessor, layout);
    if (accessor.failed()) return {};
    std::vector<uint32_t> values(layout.count);
    for_each_element(document, accessor, layout,
                     [&](size_t i, const std::byte* at) { values[i] = load_index(at, layout.type); });
    const uint32_t largest = layout.type == kU8 ? 0xff : layout.type == kU16 ? 0xffff : kRestart;
    if (std::ranges::find(values, largest) != values.end())
        accessor.warn("has the largest index, which glTF forbids; taken as the start of a new primitive");
    std::ranges::replace(values, largest, kRestart);
    return accessor.failed() ? std::vector<uint32_t>{} : values;
}

}  // namespace dermis::inline mesh::gltf
