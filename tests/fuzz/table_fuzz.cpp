// The convention's JSON and the CSV it describes: the JSON up to the first blank line, the rest is the table.
// An accepted table must be the same after it is written and read again.
// Dictionary: dermis/bake/convention_json.cpp dermis/bake/table_io.cpp dermis/bake/convention.cpp

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dermis/bake/table_io.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const size_t blank = text.find("\n\n");
    const std::string_view json = text.substr(0, blank);
    const std::string_view csv = blank == std::string_view::npos ? "" : text.substr(blank + 2);

    const auto parsed = dermis::parse_convention(json, "fuzz.json");
    if (!parsed) return 0;
    const std::string again = dermis::convention_json(parsed->convention, parsed->width, parsed->height);
    const auto twice = dermis::parse_convention(again, "again.json");
    if (!twice || dermis::convention_json(twice->convention, twice->width, twice->height) != again)
        std::abort();

    const auto table = dermis::parse_table_csv(csv, *parsed, "fuzz.csv");
    if (!table) return 0;
    if (!dermis::parse_table_csv(dermis::table_csv(*table), *parsed, "again.csv")) std::abort();
    if (dermis::table_c_header(*table, "fuzz").empty()) std::abort();
    return 0;
}
