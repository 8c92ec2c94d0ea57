#pragma once
// The parameters of a technique or a subject, declared once: the table drives the slider, --set name=value,
// the scene file's checks, the documentation and the shader's constant block.

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis::inline base {

enum class ParameterKind { number, integer, toggle, choice, color };

/// One row of the table. Numbers and integers have a closed range; a choice's value is its index into
/// `choices` (a toggle's choices are off, on); a colour's components share the range.
struct Parameter {
    std::string name, unit, doc;
    ParameterKind kind = ParameterKind::number;
    double min = 0, max = 1;
    std::array<double, 3> default_value = {};
    std::vector<std::string> choices;
    size_t offset = 0;              ///< of the member in Params
    bool double_precision = false;  ///< of the member, for a number

    [[nodiscard]] size_t component_count() const { return kind == ParameterKind::color ? 3 : 1; }
};

/// A value for every parameter, under one name: "cheap".
struct ParameterPreset {
    std::string name, doc;
    std::vector<std::byte> values;  ///< a Params
};

struct ParameterTable {
    std::vector<Parameter> parameters;
    std::vector<ParameterPreset> presets = {
        {.name = "default", .doc = "used where no preset is named", .values = {}}};

    [[nodiscard]] const Parameter* find(std::string_view name) const;
    /// "preset", then the parameters: the names that ParameterValues::set() knows.
    [[nodiscard]] std::vector<std::string> names() const;
};

/// A Params whose members are accessible by name through its table, which must outlive it.
class ParameterValues {
  public:
    explicit ParameterValues(const ParameterTable& table)
        : table_(&table), bytes_(table.presets.front().values) {}

    [[nodiscard]] const ParameterTable& table() const { return *table_; }

    /// From text as in --set and scene files: a number, on/off, a choice's name, or three numbers
    /// separated by commas or spaces. "preset" sets every parameter to those of the preset. Errors name the
    /// parameter, the value, and its range or choices.
    [[nodiscard]] Result<void> set(std::string_view name, std::string_view text);
    /// "name=value" each, in this order.
    [[nodiscard]] Result<void> set_all(std::span<const std::string> settings);
    /// Unordered settings, as in a file: applies the preset first.
    [[nodiscard]] Result<void> set_all(const std::map<std::string, std::string>& settings);
    /// The first preset that has these values; null: none.
    [[nodiscard]] const ParameterPreset* preset() const;
    /// The inverse of set(): round-trips.
    [[nodiscard]] std::string text(const Parameter& parameter) const;
    [[nodiscard]] std::array<double, 3> get(const Parameter& parameter) const;
    void put(const Parameter& parameter, std::array<double, 3> value);
    /// Sets all members without checks; `Params` is the type of the table.
    template <class Params>
    void put_all(const Params& params) {
        std::memcpy(bytes_.data(), &params, sizeof params);
    }

    /// Error: a value that set() refuses.
    [[nodiscard]] Result<void> check() const;

    template <class Params>
    [[nodiscard]] Params as() const {
        Params params;
        std::memcpy(&params, bytes_.data(), sizeof params);
        return params;
    }

    friend bool operator==(const ParameterValues& a, const ParameterValues& b);

  private:
    Result<void> set_preset(std::string_view name);

    const ParameterTable* table_;
    std::vector<std::byte> bytes_;
};

/// Collects {member, name, unit, min, max, doc}; defaults are read from a default-constructed Params, which
/// must be trivially copyable. Members: float or double for number, int32_t for integer, bool for toggle, an
/// enum over int32_t for choice, Vec3 for color.
template <class Params>
class ParameterTableBuilder {
    static_assert(std::is_trivially_copyable_v<Params> && std::is_standard_layout_v<Params>);

  public:
    ParameterTableBuilder() { table_.presets.front().values = bytes_of(defaults_); }

    template <class Real>
    ParameterTableBuilder& number(Real Params::*member, std::string name, std::string unit, double min,
                                  double max, std::string doc) {
        static_assert(std::is_floating_point_v<Real>);
        return add(member, {std::move(name),
                            std::move(unit),
                            std::move(doc),
                            ParameterKind::number,
                            min,
                            max,
                            {defaults_.*member}});
    }
    ParameterTableBuilder& integer(int32_t Params::*member, std::string name, std::string unit, double min,
                                   double max, std::string doc) {
        return add(member, {std::move(name),
                            std::move(unit),
                            std::move(doc),
                            ParameterKind::integer,
                            min,
                            max,
                            {double(defaults_.*member)}});
    }
    ParameterTableBuilder& toggle(bool Params::*member, std::string name, std::string doc) {
        return add(member, {std::move(name),
                            "",
                            std::move(doc),
                            ParameterKind::toggle,
                            0,
                            1,
                            {double(defaults_.*member)},
                            {"off", "on"}});
    }
    template <class Enum>
    ParameterTableBuilder& choice(Enum Params::*member, std::string name, std::vector<std::string> choices,
                                  std::string doc) {
        static_assert(std::is_same_v<std::underlying_type_t<Enum>, int32_t>);
        const double last = double(choices.size()) - 1;
        return add(member, {std::move(name),
                            "",
                            std::move(doc),
                            ParameterKind::choice,
                            0,
                            last,
                            {double(static_cast<int32_t>(defaults_.*member))},
                            std::move(choices)});
    }
    ParameterTableBuilder& color(Vec3 Params::*member, std::string name, double min, double max,
                                 std::string doc) {
        const Vec3 c = defaults_.*member;
        return add(
            member,
            {std::move(name), "linear", std::move(doc), ParameterKind::color, min, max, {c.x, c.y, c.z}});
    }

    /// Adds the rows of a part of Params that several techniques share; `rows` is the part's table.
    template <class Part>
    ParameterTableBuilder& part(Part Params::*member, const ParameterTable& rows) {
        ParameterValues values(rows);
        values.put_all(defaults_.*member);
        for (Parameter row : rows.parameters) {
            row.default_value = values.get(row);
            row.offset += offset_of(member);
            table_.parameters.push_back(std::move(row));
        }
        return *this;
    }

    /// Beyond "default", which is a default-constructed Params.
    ParameterTableBuilder& preset(std::string name, std::string doc, const Params& values) {
        table_.presets.push_back({std::move(name), std::move(doc), bytes_of(values)});
        return *this;
    }

    [[nodiscard]] ParameterTable build() const { return table_; }

  private:
    static std::vector<std::byte> bytes_of(const Params& values) {
        const auto* bytes = reinterpret_cast<const std::byte*>(&values);
        return {bytes, bytes + sizeof values};
    }
    template <class Member>
    ParameterTableBuilder& add(Member Params::*member, Parameter parameter) {
        parameter.double_precision = std::is_same_v<Member, double>;
        parameter.offset = offset_of(member);
        table_.parameters.push_back(std::move(parameter));
        return *this;
    }
    template <class Member>
    [[nodiscard]] size_t offset_of(Member Params::*member) const {
        const auto* base = reinterpret_cast<const std::byte*>(&defaults_);
        return size_t(reinterpret_cast<const std::byte*>(&(defaults_.*member)) - base);
    }

    Params defaults_ = {};
    ParameterTable table_;
};

}  // namespace dermis::inline base
