// The containers of glTF 2.0 (sections 3.6 and 4.4 of the specification). Offsets and sizes from the file are
// compared by subtraction, so that none of them can overflow.

#include "dermis/mesh/gltf/document.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

#include "dermis/base/text.h"

namespace dermis::inline mesh::gltf {
namespace {

constexpr uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinChunk = 0x004E4942;
constexpr int kMaxJsonDepth = 128;  // real files need about 12

uint32_t read_u32(std::span<const std::byte> bytes, size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
};

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container split_glb(std::span<const std::byte> bytes, Messages& messages) {
    Container container;
    const auto fail = [&](const std::string& text) { return messages.fail("", text), Container{}; };
    if (bytes.size() < 20)
        return fail("truncated: a GLB has at least 20 bytes, this has " + std::to_string(bytes.size()));
    if (const uint32_t version = read_u32(bytes, 4); version != 2)
        return fail(fmt::format("GLB version {}; only 2 is read", version));
    const uint32_t stated = read_u32(bytes, 8);
    if (stated > bytes.size())
        return fail(
            fmt::format("truncated: the header says {} bytes, the file has {}", stated, bytes.size()));
    bytes = bytes.first(std::max<size_t>(stated, 12)).subspan(12);
    for (int chunk = 0; bytes.size() >= 8; ++chunk) {
        const uint32_t size = read_u32(bytes, 0), type = read_u32(bytes, 4);
        bytes = bytes.subspan(8);
        if (size > bytes.size())
            return fail(fmt::format("truncated: chunk {} passes the end of the file", chunk));
        const auto content = bytes.first(size);
        if (chunk == 0 && type != kJsonChunk) return fail("the first chunk of a GLB must be its JSON");
        if (chunk == 0) container.json = as_text(content);
        if (chunk == 1 && type == kBinChunk) container.binary = content;
        bytes = bytes.subspan(std::min<size_t>(bytes.size(), (size_t{size} + 3) & ~size_t{3}));
    }
    return container;
}

// Nesting outside of strings. The JSON library's parser has no stack to overflow, but what walks and frees
// its result has.
bool too_deep(std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth) return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

void parse_json(std::string_view text, Document& document) {
    if (text.empty()) return document.messages.fail("", "the file is empty");
    if (too_deep(text)) return document.messages.fail("", "JSON nested deeper than 128 levels");
    try {
        document.root = nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::exception& wrong) {
        const auto* where = dynamic_cast<const nlohmann::json::parse_error*>(&wrong);
        return document.messages.fail(
            "", "invalid JSON" + (where ? " at byte " + std::to_string(where->byte) : std::string()));
    }
    if (!document.root.is_object()) document.messages.fail("", "the JSON must be an object");
}

// Extensions that are not read: an error where the file cannot do without, else a warning for each.
void check_extensions(Document& document) {
    static const std::set<std::string> kRead = {
        "KHR_materials_volume",           "KHR_materials_diffuse_transmission",
        "KHR_materials_volume_scatter",   "KHR_materials_scatter",
        "KHR_materials_specular",         "KHR_materials_ior",
        "KHR_mesh_quantization",          "KHR_texture_transform",
        "KHR_materials_emissive_strength"};
    const JsonView required = document.view()["extensionsRequired"], used = document.view()["extensionsUsed"];
    for (size_t i = 0; i < required.size(); ++i) {
        const std::string name = required[i].text("");
        if (!kRead.contains(name))
            required[i].fail("the file needs " + name + ", which is not supported; export it without");
    }
    std::set<std::string> named;
    for (size_t i = 0; i < used.size(); ++i)
        if (const std::string name = used[i].text(""); !kRead.contains(name) && named.insert(name).second)
            used.warn(name + " is ignored");
}

// "2.0" and later minor versions, which may be read as 2.0 unless minVersion says otherwise.
void check_version(Document& document) {
    const JsonView asset = document.view()["asset"];
    const std::string version = asset["version"].text(""), needed = asset["minVersion"].text("2.0");
    if (document.messages.error) return;
    if (!version.starts_with("2."))
        asset["version"].fail("'" + version.substr(0, 20) + "'; only glTF 2.x is read");
    if (needed != "2.0")
        asset["minVersion"].fail("the file needs glTF " + needed.substr(0, 20) + "; 2.0 is read");
}

void load_buffer(const JsonView& buffer, std::optional<std::span<const std::byte>> binary,
                 const ReadSibling& read_sibling, std::vector<std::byte>& bytes) {
    const uint64_t size = buffer["byteLength"].integer(0);
    const std::string uri = buffer["uri"].text("");
    if (buffer.failed()) return;
    if (uri.empty()) {
        if (!binary) return buffer.fail("has no uri, and there is no binary chunk");
        bytes.assign(binary->begin(), binary->end());
    } else if (uri.starts_with("data:")) {
        auto decoded = decode_data_uri(uri);
        if (!decoded) return buffer.fail("malformed data URI");
        bytes = std::move(*decoded);
    } else {
        const std::string path = decode_percent(uri);
        if (!stays_inside(path))
            return buffer.fail("uri '" + path.substr(0, 200) + "' leaves the file's directory");
        auto read = read_sibling ? read_sibling(path) : Error{path + ": no directory to read from"};
        if (!read) return buffer.fail("cannot be read: " + read.error().message);
        bytes = std::move(*read);
    }
    if (bytes.size() < size)
        return buffer.fail(fmt::format("truncated: {} bytes stated, {} found", size, bytes.size()));
}

}  // namespace

void open_document(std::span<const std::byte> bytes, const std::filesystem::path& name,
                   const ReadSibling& read_sibling, const MeshOptions& options, Document& document) {
    document.messages.file = name.string();
    document.directory = name.parent_path();
    document.max_vertices = options.max_vertices;
    document.max_nodes = options.max_nodes;
    Messages& messages = document.messages;
    Container container{as_text(bytes), {}};
    // By content: exporters name files wrongly.
    if (bytes.size() >= 4 && read_u32(bytes, 0) == kGlbMagic) container = split_glb(bytes, messages);
    if (messages.error) return;
    parse_json(container.json, document);
    if (messages.error) return;
    check_version(document);
    check_extensions(document);
    const JsonView buffers = document.view()["buffers"];
    for (size_t i = 0; i < buffers.size() && !messages.error; ++i)
        load_buffer(buffers[i], i == 0 ? container.binary : std::nullopt, read_sibling,
                    document.buffers.emplace_back());
}

std::span<const std::byte> buffer_view(Document& document, uint64_t index) {
    const JsonView view = document.view()["bufferViews"][size_t(index)];
    const uint64_t buffer = view["buffer"].integer(0);
    const uint64_t offset = view["byteOffset"].integer(0), size = view["byteLength"].integer(0);
    if (view.failed()) return {};
    if (buffer >= document.buffers.size())
        return view.fail(fmt::format("buffer {} does not exist", buffer)), std::span<const std::byte>{};
    const std::vector<std::byte>& bytes = document.buffers[size_t(buffer)];
    if (offset > bytes.size() || size > bytes.size() - offset)
        return view.fail(fmt::format("passes the end of its buffer ({} bytes)", bytes.size())),
               std::span<const std::byte>{};
    return std::span(bytes).subspan(size_t(offset), size_t(size));
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    if (!uri.substr(0, comma).ends_with(";base64")) {
        const std::string text = decode_percent(uri.substr(comma + 1));
        const auto raw = std::as_bytes(std::span(text));
        return std::vector<std::byte>(raw.begin(), raw.end());
    }
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static constexpr auto kValues = [] {
        std::array<int8_t, 256> values{};
        values.fill(-1);
        for (size_t i = 0; i < kDigits.size(); ++i) values[uint8_t(kDigits[i])] = int8_t(i);
        return values;
    }();
    std::string_view digits = uri.substr(comma + 1);
    while (digits.ends_with('=')) digits.remove_suffix(1);
    if (digits.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(digits.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    for (size_t i = 0; i < digits.size(); ++i) {
        const int value = kValues[uint8_t(digits[i])];
        if (value < 0) return std::nullopt;
        bits = bits << 6 | uint32_t(value);
        // Every digit but the first of four completes a byte: with 4, 2 or 0 bits to spare.
        if (i % 4 > 0) bytes.push_back(std::byte(bits >> (6 - 2 * (i % 4))));
    }
    return bytes;
}

std::string decode_percent(std::string_view uri) {
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            path += char(code);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

void Messages::fail(const std::string& place, const std::string& text) {
    if (!error) error = Error{file + ": " + (place.empty() ? "" : place + ": ") + text};
}

void Messages::warn(const std::string& place, const std::string& text) {
    warnings.push_back(file + ": " + (place.empty() ? "" : place + ": ") + text);
}

JsonView JsonView::operator[](const char* key) const {
    const std::string place = place_.empty() ? key : place_ + "." + key;
    const nlohmann::json* found = nullptr;
    if (value_ && value_->is_object()) {
        const auto at = value_->find(key);
        if (at != value_->end()) found = &*at;
    } else if (value_) {
        fail("must be an object");
    }
    return {found, place, *messages_};
}

JsonView JsonView::operator[](size_t index) const {
    const nlohmann::json* found = nullptr;
    if (index < size())
        found = &(*value_)[index];
    else
        fail(fmt::format("has no element {} (it has {})", index, size()));
    return {found, fmt::format("{}[{}]", place_, index), *messages_};
}

size_t JsonView::size() const {
    if (!value_) return 0;
    if (!value_->is_array()) return fail("must be an array"), 0;
    return value_->size();
}

double JsonView::number(double fallback) const {
    if (!value_) return fallback;
    if (!value_->is_number()) return fail("must be a number"), fallback;
    const double number = value_->get<double>();
    // Everything ends as a float.
    if (!std::isfinite(float(number))) return fail("is out of range"), fallback;
    return number;
}

uint64_t JsonView::integer(uint64_t fallback) const {
    if (!value_) return fallback;
    const double number = value_->is_number() ? value_->get<double>() : -1;
    if (number < 0 || number > 9007199254740992.0 || number != std::floor(number))
        return fail("must be a non-negative integer"), fallback;
    return uint64_t(number);
}

std::string JsonView::text(const std::string& fallback) const {
    if (!value_) return fallback;
    if (!value_->is_string()) return fail("must be a string"), fallback;
    return value_->get<std::string>();
}

bool JsonView::boolean(bool fallback) const {
    if (!value_) return fallback;
    if (!value_->is_boolean()) return fail("must be true or false"), fallback;
    return value_->get<bool>();
}

}  // namespace dermis::inline mesh::gltf
