#include "engines/drawn_head/glb.h"

#include <cstring>
#include <map>

#include "dermis/base/file.h"

namespace dermis::drawn_head {

using nlohmann::json;

namespace {

constexpr int kU8 = 5121, kU16 = 5123;

size_t numbers_in(const std::string& type) {
    static const std::map<std::string, size_t> sizes = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    return sizes.at(type);
}

// `count` elements of `each` numbers that begin `offset` bytes into a view.
template <class T>
std::vector<T> numbers_in_view(const Glb& glb, const json& at, size_t count, size_t each) {
    const json& view = glb.document["bufferViews"][size_t(at["bufferView"])];
    const size_t start = view.value("byteOffset", size_t(0)) + at.value("byteOffset", size_t(0));
    const size_t stride = view.value("byteStride", each * sizeof(T));
    std::vector<T> numbers(count * each);
    for (size_t i = 0; i < count; ++i)
        std::memcpy(&numbers[i * each], glb.binary.data() + start + i * stride, each * sizeof(T));
    return numbers;
}

std::vector<uint32_t> integers_in_view(const Glb& glb, const json& at, int kind, size_t count, size_t each) {
    const auto wide = [](const auto& narrow) { return std::vector<uint32_t>(narrow.begin(), narrow.end()); };
    if (kind == kU8) return wide(numbers_in_view<uint8_t>(glb, at, count, each));
    if (kind == kU16) return wide(numbers_in_view<uint16_t>(glb, at, count, each));
    return numbers_in_view<uint32_t>(glb, at, count, each);
}

}  // namespace

Result<Glb> read_glb(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
    uint32_t length = 0;
    if (bytes.size() < 28) return Error{path.string() + ": no GLB"};
    std::memcpy(&length, bytes.data() + 12, 4);
    const char* text = reinterpret_cast<const char*>(bytes.data() + 20);
    return Glb{json::parse(text, text + length), {bytes.begin() + 20 + length + 8, bytes.end()}};
}

std::vector<float> floats_of(const Glb& glb, size_t accessor) {
    const json& at = glb.document["accessors"][accessor];
    const size_t count = at["count"], each = numbers_in(at["type"]);
    std::vector<float> numbers(count * each);
    if (at.contains("bufferView")) numbers = numbers_in_view<float>(glb, at, count, each);
    if (!at.contains("sparse")) return numbers;
    const json& sparse = at["sparse"];
    const size_t changed = sparse["count"];
    const auto places =
        integers_in_view(glb, sparse["indices"], sparse["indices"]["componentType"], changed, 1);
    const auto values = numbers_in_view<float>(glb, sparse["values"], changed, each);
    for (size_t i = 0; i < changed * each; ++i) numbers[places[i / each] * each + i % each] = values[i];
    return numbers;
}

std::vector<uint32_t> integers_of(const Glb& glb, size_t accessor) {
    const json& at = glb.document["accessors"][accessor];
    return integers_in_view(glb, at, at["componentType"], at["count"], numbers_in(at["type"]));
}

}  // namespace dermis::drawn_head
