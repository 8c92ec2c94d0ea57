// scores.csv: one table of columns for writing, reading and JSON.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dermis/base/text.h"
#include "dermis/judge/comparison.h"
#include "dermis/judge/scores.h"

namespace dermis::inline judge {
namespace {

using Value = std::optional<double>;

template <double Scores::*member>
constexpr ScoreColumn error_column(std::string_view name) {
    return {name, [](const ScoreRow& row) { return Value(row.scores.*member); },
            [](ScoreRow& row, Value value) { row.scores.*member = *value; }};
}

template <Value Scores::*member>
constexpr ScoreColumn part_column(std::string_view name) {
    return {name, [](const ScoreRow& row) { return row.scores.*member; },
            [](ScoreRow& row, Value value) { row.scores.*member = value; }, true};
}

template <double ScoreRow::*member>
constexpr ScoreColumn row_column(std::string_view name) {
    return {name, [](const ScoreRow& row) { return Value(row.*member); },
            [](ScoreRow& row, Value value) { row.*member = *value; }};
}

using Share = std::optional<Captured> ScoreRow::*;

// The row has the share from the first of its columns with a value on.
Captured& made(std::optional<Captured>& captured) {
    if (captured) return *captured;
    captured.emplace();
    for (CapturedShare* share :
         {&captured->all, &captured->channels[0], &captured->channels[1], &captured->channels[2]})
        share->share = std::nan("");
    return *captured;
}

constexpr size_t kAllChannels = 3;

template <size_t channel>
auto& share_in(auto& captured) {
    if constexpr (channel == kAllChannels)
        return captured.all;
    else
        return captured.channels[channel];
}

// The columns of one share. A share that was too noisy when it was written has no number when it is read.
template <Share which, size_t channel>
constexpr ScoreColumn channel_column(std::string_view name) {
    return {name,
            [](const ScoreRow& row) {
                if (!(row.*which)) return Value();
                const CapturedShare& share = share_in<channel>(*(row.*which));
                return share.known() ? Value(share.share) : Value();
            },
            [](ScoreRow& row, Value value) {
                if (value) share_in<channel>(made(row.*which)).share = *value;
            },
            true};
}

template <Share which, double CapturedShare::*member>
constexpr ScoreColumn share_column(std::string_view name) {
    return {name, [](const ScoreRow& row) { return row.*which ? Value((row.*which)->all.*member) : Value(); },
            [](ScoreRow& row, Value value) {
                if (value) made(row.*which).all.*member = *value;
            },
            true};
}

template <Share which>
constexpr ScoreColumn interval_column(std::string_view name) {
    return {name,
            [](const ScoreRow& row) {
                return row.*which && (row.*which)->all.known() ? Value((row.*which)->all.error) : Value();
            },
            [](ScoreRow& row, Value value) {
                if (value) made(row.*which).all.error = *value;
            },
            true};
}

constexpr Share kWalk = &ScoreRow::walk, kSurface = &ScoreRow::surface;

constexpr ScoreColumn kColumns[] = {
    channel_column<kWalk, kAllChannels>("walk_captured"),
    channel_column<kWalk, 0>("walk_captured_r"),
    channel_column<kWalk, 1>("walk_captured_g"),
    channel_column<kWalk, 2>("walk_captured_b"),
    interval_column<kWalk>("walk_captured_error"),
    share_column<kWalk, &CapturedShare::effect_rms>("walk_effect_rms"),
    share_column<kWalk, &CapturedShare::reference_noise>("walk_reference_noise"),
    channel_column<kSurface, kAllChannels>("captured"),
    channel_column<kSurface, 0>("captured_r"),
    channel_column<kSurface, 1>("captured_g"),
    channel_column<kSurface, 2>("captured_b"),
    interval_column<kSurface>("captured_error"),
    share_column<kSurface, &CapturedShare::effect_rms>("effect_rms"),
    share_column<kSurface, &CapturedShare::reference_noise>("reference_noise"),
    error_column<&Scores::rmse>("rmse"),
    error_column<&Scores::rel_mse>("rel_mse"),
    error_column<&Scores::psnr_db>("psnr_db"),
    error_column<&Scores::ssim>("ssim"),
    error_column<&Scores::delta_e_2000>("delta_e_2000"),
    error_column<&Scores::flip>("flip"),
    part_column<&Scores::terminator_rmse>("terminator_rmse"),
    part_column<&Scores::penumbra_rmse>("penumbra_rmse"),
    row_column<&ScoreRow::time_ms>("time_ms"),
    {"bytes", [](const ScoreRow& row) { return Value(double(row.bytes)); },
     [](ScoreRow& row, Value value) {
         constexpr double kMostBytes = 1e15;
         row.bytes = size_t(std::clamp(*value, 0.0, kMostBytes));
     }},
    row_column<&ScoreRow::time_ratio>("time_ratio"),
    row_column<&ScoreRow::reference_rmse>("reference_rmse"),
    {"model_ratio", [](const ScoreRow& row) { return row.model_ratio; },
     [](ScoreRow& row, Value value) { row.model_ratio = value; }, true},
    channel_column<&ScoreRow::walk_motion, kAllChannels>("walk_motion"),
    interval_column<&ScoreRow::walk_motion>("walk_motion_error"),
    channel_column<&ScoreRow::surface_motion, kAllChannels>("motion"),
    interval_column<&ScoreRow::surface_motion>("motion_error")};

constexpr std::string_view kNames[] = {"scene", "technique", "settings"};

std::string heading() {
    std::vector<std::string> names(std::begin(kNames), std::end(kNames));
    for (const ScoreColumn& column : kColumns) names.emplace_back(column.name);
    return join(names, ",");
}

std::string csv_field(std::string text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    for (size_t i = 0; (i = text.find('"', i)) != std::string::npos; i += 2) text.insert(i, 1, '"');
    return '"' + text + '"';
}

// Four figures are more than the accuracy of any of the numbers; bytes are whole.
std::string number(Value value) {
    if (!value) return "";
    char text[32];
    const bool whole = std::abs(*value) >= 1e4 && *value == std::floor(*value);
    std::snprintf(text, sizeof text, whole ? "%.0f" : "%.4g", *value);
    return text;
}

// Fields of one line; quotes as RFC 4180 has them.
std::vector<std::string> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

// The name of the column reference_noise in files of earlier versions.
constexpr std::string_view kOldReferenceNoise = "truth_noise";

// The columns of a file in order. None: the heading lacks one that no row may be without, or has another.
std::vector<const ScoreColumn*> columns_of(std::string_view line) {
    const std::vector<std::string_view> names = split(line, ',');
    size_t at = 0;
    const auto next_is = [&](std::string_view name) { return at < names.size() && names[at] == name; };
    for (const std::string_view name : kNames) {
        if (!next_is(name)) return {};
        ++at;
    }
    std::vector<const ScoreColumn*> columns;
    for (const ScoreColumn& column : kColumns) {
        if (next_is(column.name) || (column.name == "reference_noise" && next_is(kOldReferenceNoise))) {
            columns.push_back(&column);
            ++at;
        } else if (!column.may_be_missing) {
            return {};
        }
    }
    return at == names.size() ? columns : std::vector<const ScoreColumn*>();
}

Result<ScoreRow> parse_row(std::string_view line, size_t line_number,
                           const std::vector<const ScoreColumn*>& columns) {
    const std::vector<std::string> fields = csv_fields(line);
    const auto wrong = [&](const std::string& what) {
        return Error{"scores line " + std::to_string(line_number) + ": " + what};
    };
    const size_t expected = std::size(kNames) + columns.size();
    if (fields.size() != expected)
        return wrong("has " + std::to_string(fields.size()) + " columns, not " + std::to_string(expected));
    ScoreRow row{.scene = fields[0], .technique = fields[1], .settings = fields[2]};
    for (size_t i = 0; i < columns.size(); ++i) {
        const ScoreColumn& column = *columns[i];
        const std::string& field = fields[std::size(kNames) + i];
        const Value value = parse_number(field);
        const auto place = "'" + field + "' under " + std::string(column.name);
        if (!value && !(column.may_be_missing && field.empty())) return wrong(place + " is not a number");
        // Rows are sorted and plotted by these. Equal pictures have an infinite PSNR.
        const bool sound = !value || std::isfinite(*value) || (column.name == "psnr_db" && *value > 0);
        if (!sound) return wrong(place + " is not finite");
        column.set(row, value);
    }
    return row;
}

}  // namespace

std::span<const ScoreColumn> score_columns() {
    return kColumns;
}

std::string scores_csv(const std::vector<ScoreRow>& rows) {
    std::string text = heading() + "\n";
    for (const ScoreRow& row : rows) {
        std::vector<std::string> fields = {csv_field(row.scene), csv_field(row.technique),
                                           csv_field(row.settings)};
        for (const ScoreColumn& column : kColumns) fields.push_back(number(column.get(row)));
        text += join(fields, ",") + "\n";
    }
    return text;
}

std::string regions_csv(const std::string& scene, const Comparison& comparison) {
    const std::span<const ScoreColumn> columns = score_columns().first(2 * kShareColumns);
    std::string text = "scene,technique,settings,region,pixels";
    for (const ScoreColumn& column : columns) text += "," + std::string(column.name);
    text += "\n";
    const auto share_by = [&](Integrator integrator, const Compared& row, size_t region) {
        const Judgement* found = judgement_by(integrator, comparison, row);
        return found ? found->regions[region].captured : std::nullopt;
    };
    for (const Compared& row : comparison.rows)
        for (size_t region = 0; region < row.first.regions.size(); ++region) {
            const RegionShare& share = row.first.regions[region];
            if (!share.captured) continue;
            std::vector<std::string> fields = {
                csv_field(scene), csv_field(row.contestant.technique->id), csv_field(row.contestant.settings),
                std::string(region_name(share.region)), std::to_string(share.captured->pixels)};
            const ScoreRow numbers{.walk = share_by(Integrator::walk, row, region),
                                   .surface = share_by(Integrator::surface, row, region)};
            for (const ScoreColumn& column : columns) fields.push_back(number(column.get(numbers)));
            text += join(fields, ",") + "\n";
        }
    return text;
}

Result<std::vector<ScoreRow>> parse_scores(std::string_view text) {
    std::vector<ScoreRow> rows;
    std::vector<const ScoreColumn*> columns;
    size_t line_number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++line_number;
        if (line_number == 1) {
            columns = columns_of(trim(line));
            if (columns.empty()) return Error{"scores line 1: the heading is not " + heading()};
        }
        if (line_number == 1 || trim(line).empty()) continue;
        DERMIS_TRY_ASSIGN(ScoreRow row, parse_row(trim(line), line_number, columns));
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace dermis::inline judge
