#include "dermis/bake/table_text.h"

#include <cctype>
#include <cmath>
#include <limits>

#include "dermis/base/text.h"

namespace dermis::inline bake {
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
            return Error{"'" + std::string(cells[i].substr(0, 40)) + "' is no finite number"};
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
