#include "dermis/optics/profile_file.h"

#include <algorithm>
#include <optional>

#include "dermis/base/file.h"
#include "dermis/base/text.h"

namespace dermis::inline optics {
namespace {

constexpr std::string_view kTableHeader = "r_mm,r,g,b", kSumHeader = "variance_mm2,r,g,b";

struct Rows {
    bool is_sum = false;
    std::vector<double> first;  // r_mm or variance_mm2
    std::vector<Rgb> rgb;
};

std::string without_spaces(std::string_view text) {
    std::string out = to_lower(text);
    std::erase_if(out, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
    return out;
}

Result<std::array<double, 4>> parse_row(std::string_view line, const std::string& place) {
    const std::vector<std::string_view> cells = split(line, ',');
    if (cells.size() != 4)
        return Error{place + ": " + std::to_string(cells.size()) +
                     " values; a row has 4, separated by commas"};
    std::array<double, 4> row;
    for (size_t i = 0; i < 4; ++i) {
        const auto number = parse_number(cells[i]);
        if (!number)
            return Error{place + ": '" + std::string(trim(cells[i])).substr(0, 40) + "' is not a number"};
        row[i] = *number;
    }
    return row;
}

Result<Rows> parse_rows(std::string_view text, std::string_view place) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a spreadsheet's byte order mark
    Rows rows;
    bool has_header = false;
    int number = 0;
    for (const std::string_view untrimmed : split(text, '\n')) {
        const std::string here = std::string(place) + ":" + std::to_string(++number);
        const std::string_view line = trim(untrimmed);
        if (line.empty() || line.starts_with('#')) continue;
        if (!has_header) {
            const std::string header = without_spaces(line);
            if (header != kTableHeader && header != kSumHeader)
                return Error{here + ": the header is '" + std::string(line.substr(0, 60)) +
                             "'; it must be '" + std::string(kTableHeader) + "' or '" +
                             std::string(kSumHeader) + "'"};
            rows.is_sum = header == kSumHeader;
            has_header = true;
            continue;
        }
        DERMIS_TRY_ASSIGN(const auto row, parse_row(line, here));
        if (rows.first.size() == kMaxProfileRows)
            return Error{here + ": more than " + std::to_string(kMaxProfileRows) + " rows"};
        rows.first.push_back(row[0]);
        rows.rgb.push_back({row[1], row[2], row[3]});
    }
    if (!has_header)
        return Error{std::string(place) + ": empty; its first line must be '" + std::string(kTableHeader) +
                     "' or '" + std::string(kSumHeader) + "'"};
    return rows;
}

std::string row_text(double first, const Rgb& rgb) {
    return to_text(first) + "," + to_text(rgb[0]) + "," + to_text(rgb[1]) + "," + to_text(rgb[2]) + "\n";
}

}  // namespace

Result<Profile> parse_profile_csv(std::string_view text, std::string_view place) {
    const Result<Rows> rows = parse_rows(text, place);
    if (!rows) return rows.error();
    const std::string name = utf8_path(place).stem().string(), source(place);
    if (!rows->is_sum) {
        DERMIS_TRY_ASSIGN(TabulatedProfile table, TabulatedProfile::make(rows->first, rows->rgb, place));
        return Profile{name, source, std::move(table)};
    }
    GaussianSum sum{.name = name};
    for (size_t i = 0; i < rows->first.size(); ++i) sum.terms.push_back({rows->first[i], rows->rgb[i]});
    const Profile profile{name, source, std::move(sum)};
    if (const auto checked = check(profile); !checked)
        return Error{std::string(place) + ": " + checked.error().message};
    return profile;
}

Result<Profile> read_profile_csv(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
    return parse_profile_csv(text, path.string());
}

std::string profile_csv(const Profile& profile, std::span<const double> radii_mm) {
    std::string out = "# " + profile.name + "; " + profile.source + "\n";
    if (const auto* sum = std::get_if<GaussianSum>(&profile.model)) {
        out += std::string(kSumHeader) + "\n";
        for (const GaussianTerm& term : sum->terms) out += row_text(term.variance_mm2, term.weight);
        return out;
    }
    out += std::string(kTableHeader) + "\n";
    for (const double r : radii_mm) {
        Rgb rgb;
        for (int c = 0; c < 3; ++c) rgb[size_t(c)] = reflectance_per_mm2(profile, c, r);
        out += row_text(r, rgb);
    }
    return out;
}

}  // namespace dermis::inline optics
