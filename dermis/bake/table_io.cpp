#include "dermis/bake/table_io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"

namespace dermis::inline bake {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTextKey = "dermis";

struct Format {
    std::string_view extension;
    TableStorage automatic;
    std::vector<TableStorage> others;
    std::string_view holds;
};

const std::vector<Format>& formats() {
    static const std::vector<Format> all = {
        {".exr", TableStorage::f16, {TableStorage::f32}, "half or float"},
        {".png", TableStorage::u16, {TableStorage::u8}, "16 or 8 bit"},
        {".ktx2", TableStorage::f16, {}, "half"},
        {".dds", TableStorage::f16, {}, "half"},
        {".h", TableStorage::f32, {}, "float"},
        {".csv", TableStorage::f32, {}, "float"},
    };
    return all;
}

std::string_view name_of(TableStorage storage) {
    constexpr std::string_view kNames[] = {"automatic", "8 bit", "16 bit", "half", "float"};
    return kNames[size_t(storage)];
}

PixelFormat pixel_format(TableStorage storage) {
    switch (storage) {
        case TableStorage::u8:
            return PixelFormat::u8;
        case TableStorage::u16:
            return PixelFormat::u16;
        case TableStorage::f16:
            return PixelFormat::f16;
        default:
            return PixelFormat::f32;
    }
}

int file_row(const Table& table, int y) {
    return table.convention.v_origin == VOrigin::top ? y : table.height - 1 - y;
}

// Encoded values; the encoding flag is set so that a PNG says sRGB when its numbers are.
Image encoded_image(const Table& table, TableStorage storage) {
    const bool srgb = table.convention.encoding == TableEncoding::srgb;
    Image image(table.width, table.height, table.channels, pixel_format(storage),
                srgb ? Encoding::srgb : Encoding::linear);
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x)
            for (int c = 0; c < table.channels; ++c)
                image.set(x, file_row(table, y), c,
                          float(encode_value(table.convention, table.at(x, y, c), table.u_value(x))));
    return image;
}

std::vector<std::byte> to_bytes(std::string_view text) {
    const auto bytes = as_bytes(text);
    return {bytes.begin(), bytes.end()};
}

// The embedded text where there is one, else the sidecar; both must agree.
Result<ParsedConvention> load_convention(const fs::path& path, const std::string& embedded) {
    const fs::path beside = sidecar_path(path);
    std::error_code ec;
    std::string sidecar;
    if (fs::exists(beside, ec)) {
        DERMIS_TRY_ASSIGN(std::string text, read_text_file(beside));
        sidecar = std::move(text);
    }
    if (embedded.empty() && sidecar.empty())
        return Error{path.string() + ": has no convention (neither inside nor as " +
                     beside.filename().string() + "); 'dermis lint' finds out what it is"};
    if (!embedded.empty() && !sidecar.empty() && trim(embedded) != trim(sidecar))
        return Error{path.string() + ": the convention inside differs from the one in " +
                     beside.filename().string() + "; delete the wrong one"};
    return embedded.empty() ? parse_convention(sidecar, beside.string())
                            : parse_convention(embedded, path.string());
}

Result<Table> decoded_table(const LoadedImage& loaded, const ParsedConvention& parsed, const fs::path& path) {
    const Image& image = loaded.image;
    if (image.width != parsed.width || image.height != parsed.height)
        return Error{path.string() + ": is " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " texels, convention keys 'width' and 'height' say " +
                     std::to_string(parsed.width) + " x " + std::to_string(parsed.height)};
    const Image stored = to_linear_float(image);
    Table table{.width = image.width,
                .height = image.height,
                .channels = parsed.convention.kind == TableKind::beckmann ? 1 : 3,
                .convention = parsed.convention};
    if (stored.channels < table.channels)
        return Error{path.string() + ": has " + std::to_string(stored.channels) + " channel(s), a " +
                     std::string(dermis::name_of(parsed.convention.kind)) + " table has 3"};
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x)
            for (int c = 0; c < table.channels; ++c) {
                const float value = stored.at(x, file_row(table, y), c);
                if (!std::isfinite(value))
                    return Error{path.string() + ": texel (" + std::to_string(x) + ", " + std::to_string(y) +
                                 ") is not finite"};
                table.data.push_back(float(decode_value(table.convention, value, table.u_value(x))));
            }
    return table;
}

Result<Table> read_csv(const fs::path& path, const TableUse& use) {
    DERMIS_TRY_ASSIGN(const ParsedConvention parsed, load_convention(path, ""));
    DERMIS_TRY(check_use(parsed.convention, use, path.string()));
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
    return parse_table_csv(text, parsed, path.string());
}

Result<void> check_flag(std::span<const std::byte> file, const Convention& convention, const fs::path& path) {
    if (convention.encoding == TableEncoding::srgb || !png_is_flagged_srgb(file)) return {};
    return Error{path.string() + ": the PNG is flagged sRGB, but convention key 'encoding' is '" +
                 std::string(dermis::name_of(convention.encoding)) +
                 "'; another tool saved it again: bake it again or remove its sRGB chunk"};
}

}  // namespace

fs::path sidecar_path(const fs::path& path) {
    fs::path beside = path;
    beside += ".json";
    return beside;
}

Result<TableStorage> storage_for(const fs::path& path, TableStorage storage) {
    std::vector<std::string> extensions;
    for (const Format& format : formats()) {
        extensions.emplace_back(format.extension);
        if (format.extension != to_lower(path.extension().string())) continue;
        if (storage == TableStorage::automatic || storage == format.automatic) return format.automatic;
        if (std::ranges::count(format.others, storage)) return storage;
        return Error{path.string() + ": a " + std::string(format.extension) + " table holds " +
                     std::string(format.holds) + ", not " + std::string(name_of(storage))};
    }
    return Error{path.string() + ": " +
                 unknown_name("table extension", path.extension().string(), extensions)};
}

TableEncoding encoding_for(TableKind kind, TableStorage storage) {
    if (storage != TableStorage::u8) return TableEncoding::linear;
    if (kind == TableKind::beckmann) return TableEncoding::tenth_power;
    return TableEncoding::srgb;
}

Result<std::vector<std::byte>> table_bytes(const fs::path& path, const Table& table, TableStorage storage) {
    DERMIS_TRY_ASSIGN(const TableStorage chosen, storage_for(path, storage));
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".csv") return to_bytes(table_csv(table));
    if (extension == ".h") return to_bytes(table_c_header(table, path.stem().string()));
    const std::string json = convention_json(table.convention, table.width, table.height);
    Result<std::vector<std::byte>> image =
        encode_image(extension, encoded_image(table, chosen), {{kTextKey, json}});
    if (!image) return Error{path.string() + ": " + image.error().message};
    return image;
}

Result<void> write_table(const fs::path& path, const Table& table, TableStorage storage) {
    DERMIS_TRY_ASSIGN(const auto content, table_bytes(path, table, storage));
    const std::string json = convention_json(table.convention, table.width, table.height) + "\n";
    const FileContent files[] = {{path, content}, {sidecar_path(path), as_bytes(json)}};
    return write_files(files);
}

Result<Table> read_table(const fs::path& path, const TableUse& use) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".csv") return read_csv(path, use);
    if (extension == ".h")
        return Error{path.string() + ": a .h table is for a compiler; read .exr, .png or .csv"};
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
    DERMIS_TRY_ASSIGN(const LoadedImage loaded, decode_image(file, path.string(), ImageUse::data));
    const auto text = loaded.text.find(kTextKey);
    DERMIS_TRY_ASSIGN(const ParsedConvention parsed,
                      load_convention(path, text == loaded.text.end() ? std::string() : text->second));
    DERMIS_TRY(check_use(parsed.convention, use, path.string()));
    DERMIS_TRY(check_flag(file, parsed.convention, path));
    return decoded_table(loaded, parsed, path);
}

bool png_is_flagged_srgb(std::span<const std::byte> file) {
    constexpr unsigned char kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (file.size() < 8 || std::memcmp(file.data(), kSignature, 8) != 0) return false;
    // Chunks: length (big-endian), four letters, that many bytes, a checksum.
    for (size_t at = 8; at + 12 <= file.size();) {
        uint32_t length = 0;
        for (size_t i = 0; i < 4; ++i) length = length << 8 | uint32_t(file[at + i]);
        const std::string_view type(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
        if (type == "sRGB") return true;
        if (type == "IDAT") return false;
        at += 12 + size_t(length);
    }
    return false;
}

namespace {

std::string csv_header(const Convention& convention, int channels) {
    return convention.axes[0].name + "," + convention.axes[1].name + (channels == 3 ? ",r,g,b" : ",value");
}

int channels_of(TableKind kind) {
    return kind == TableKind::beckmann ? 1 : 3;
}

// Stores the values of one line of the CSV, or says what is wrong with it.
Result<void> parse_line(std::string_view line, const Table& table, int x, int y, float* values) {
    const std::vector<std::string_view> cells = split(line, ',');
    if (cells.size() != size_t(2 + table.channels))
        return Error{"has " + std::to_string(cells.size()) + " cells, needs " +
                     std::to_string(2 + table.channels)};
    const double expected[] = {table.u_value(x), table.v_value(y)};
    for (size_t i = 0; i < cells.size(); ++i) {
        const std::optional<double> number = parse_number(trim(cells[i]));
        if (!number || !std::isfinite(*number))
            return Error{"'" + std::string(cells[i].substr(0, 40)) + "' is not a finite number"};
        if (i >= 2) {
            if (std::abs(*number) > double(std::numeric_limits<float>::max()))
                return Error{"'" + std::string(cells[i].substr(0, 40)) +
                             "' is beyond a float, 3.4e38 at most"};
            values[i - 2] = float(*number);
            continue;
        }
        const TableAxis& axis = table.convention.axes[i];
        if (std::abs(*number - expected[i]) > 1e-4 * std::abs(axis.max - axis.min))
            return Error{axis.name + " is " + to_text(*number) + ", the convention puts " +
                         to_text(expected[i]) + " there"};
    }
    return {};
}

}  // namespace

std::string table_csv(const Table& table) {
    std::string csv = csv_header(table.convention, table.channels) + "\n";
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x) {
            csv += to_text(float(table.u_value(x))) + "," + to_text(float(table.v_value(y)));
            for (int c = 0; c < table.channels; ++c) csv += "," + to_text(table.at(x, y, c));
            csv += "\n";
        }
    return csv;
}

Result<Table> parse_table_csv(std::string_view text, const ParsedConvention& parsed, std::string_view place) {
    const auto fail = [&](size_t line, const std::string& what) {
        return Error{std::string(place) + ":" + std::to_string(line) + ": " + what};
    };
    Table table{.width = parsed.width,
                .height = parsed.height,
                .channels = channels_of(parsed.convention.kind),
                .convention = parsed.convention};
    std::vector<std::string_view> lines = split(text, '\n');
    while (!lines.empty() && trim(lines.back()).empty()) lines.pop_back();
    const std::string header = csv_header(table.convention, table.channels);
    if (lines.empty() || trim(lines[0]) != header) return fail(1, "the header must be '" + header + "'");
    // Checked before anything of the claimed size is allocated.
    const size_t texels = size_t(table.width) * size_t(table.height);
    if (lines.size() - 1 != texels)
        return fail(lines.size(), "has " + std::to_string(lines.size() - 1) + " rows, a " +
                                      std::to_string(table.width) + " x " + std::to_string(table.height) +
                                      " table needs " + std::to_string(texels));
    table.data.resize(texels * size_t(table.channels));
    for (size_t i = 0; i < texels; ++i) {
        const int x = int(i % size_t(table.width)), y = int(i / size_t(table.width));
        float* values = table.data.data() + i * size_t(table.channels);
        if (Result<void> line = parse_line(trim(lines[i + 1]), table, x, y, values); !line)
            return fail(i + 2, line.error().message);
    }
    return table;
}

std::string table_c_header(const Table& table, std::string_view name) {
    std::string identifier = "dermis_";
    for (char c : name) identifier += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    const Convention& convention = table.convention;
    std::string text = "/* " + tool_version() + ": " + std::string(name_of(convention.kind)) + " table, " +
                       std::to_string(table.width) + " columns of " + convention.axes[0].name + ", " +
                       std::to_string(table.height) + " rows of " + convention.axes[1].name +
                       ", first row first.\n" + convention_json(convention, table.width, table.height) +
                       "\n*/\n";
    text += "static const float " + identifier + "[" + std::to_string(table.height) + "][" +
            std::to_string(table.width) + "][" + std::to_string(table.channels) + "] = {\n";
    for (int y = 0; y < table.height; ++y) {
        text += "{";
        for (int x = 0; x < table.width; ++x) {
            text += x % 4 == 0 && x > 0 ? ",\n {" : x > 0 ? ", {" : "{";
            for (int c = 0; c < table.channels; ++c) {
                std::string number = to_text(table.at(x, y, c));
                if (number.find_first_of(".en") == std::string::npos) number += ".0";
                text += (c ? ", " : "") + number + "f";
            }
            text += "}";
        }
        text += y + 1 < table.height ? "},\n" : "}\n";
    }
    return text + "};\n";
}

}  // namespace dermis::inline bake
