// Tables and the closed form as arrays, with their convention.

#include "arrays.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/table_report.h"
#include "dermis/base/text.h"
#include "dermis/optics/closed_form.h"
#include "dermis/optics/gaussian_fit.h"
#include "module.h"
#include "table_options.h"

namespace dermis::python {
namespace {

using cli::MadeTable;

// An empty keyword argument keeps the choice's value.
void take_text(std::string& choice, const std::string& text) {
    if (!text.empty()) choice = text;
}

// A profile itself takes the place of a name.
template <class Options>
MadeTable bake(const py::object& progress, Options options, const std::optional<Profile>& profile) {
    if (profile) options.profile = *profile;
    return watched(progress, [&](Watch&) { return cli::make_table(options); });
}

MadeTable bake_lut(const std::optional<Profile>& profile, const std::vector<std::string>& texts,
                   std::optional<double> variance_scale, const py::object& progress) {
    cli::LutChoice choice;
    std::string* const members[] = {&choice.convention, &choice.construction, &choice.ring_weights,
                                    &choice.size,       &choice.axis,         &choice.range,
                                    &choice.warp};
    for (size_t i = 0; i < std::size(members); ++i) take_text(*members[i], texts.at(i));
    if (variance_scale) choice.variance_scale = finite("--variance-scale", *variance_scale);
    return bake(progress, value_of(choice.options()), profile);
}

MadeTable bake_zh(const std::optional<Profile>& profile, const std::vector<std::string>& texts, int width,
                  const py::object& progress) {
    cli::ZhChoice choice;
    std::string* const members[] = {&choice.construction, &choice.axis, &choice.range, &choice.layout};
    for (size_t i = 0; i < std::size(members); ++i) take_text(*members[i], texts.at(i));
    choice.width = width;
    return bake(progress, value_of(choice.options()), profile);
}

MadeTable bake_shadow(const std::optional<Profile>& profile, const std::vector<std::string>& texts,
                      double sharpening, const py::object& progress) {
    cli::ShadowChoice choice;
    std::string* const members[] = {&choice.size, &choice.range, &choice.warp};
    for (size_t i = 0; i < std::size(members); ++i) take_text(*members[i], texts.at(i));
    choice.sharpening = finite("--sharpening", sharpening);
    return bake(progress, value_of(choice.options()), profile);
}

// The profile is known by its name only.
MadeTable read_table_file(const std::string& path) {
    return {.table = value_of(unlocked([&] { return read_table(path, {}); })), .profile = {}, .note = ""};
}

// The same file as `dermis bake -o PATH --storage STORAGE` writes.
void write_table_file(const MadeTable& made, const std::string& path, const std::string& storage_name) {
    const TableStorage storage = value_of(cli::find_storage(path, storage_name, made.preferred));
    Table table = made.table;
    if (table.convention.kind == TableKind::zonal_harmonics)
        check(cli::check_zonal_storage(path,
                                       table.convention.encoding == TableEncoding::range
                                           ? ZonalLayout::two_rows_remapped_8
                                           : ZonalLayout::three_rows,
                                       storage));
    cli::choose_encoding(table, storage);
    check(unlocked([&] { return write_table(path, table, storage); }));
}

py::array_t<double> axis(const MadeTable& made, int which) {
    const Table& table = made.table;
    const int count = which == 0 ? table.width : table.height;
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(which == 0 ? table.u_value(i) : table.v_value(i));
    return array_of(std::move(values), {count});
}

py::array_t<double> look_up(const MadeTable& made, const py::object& u, const py::object& v) {
    const std::vector<double> us = numbers_from(u, "u"), vs = numbers_from(v, "v");
    if (us.size() != vs.size())
        throw Failure(
            {"v: " + std::to_string(vs.size()) + " numbers for " + std::to_string(us.size()) + " of u"});
    std::vector<double> values;
    for (size_t i = 0; i < us.size(); ++i)
        for (const double channel : lookup(made.table, us[i], vs[i])) values.push_back(channel);
    return array_of(std::move(values), {py::ssize_t(us.size()), 3});
}

// ---- closed form
// ---------------------------------------------------------------------------------------------

ClosedForm fit_form(const Profile& profile, const std::string& construction, double max_curvature_per_mm,
                    int rows, const py::object& progress) {
    const Construction chosen = value_of(find_construction(construction));
    constexpr int kMostRows = 1 << 16;
    if (rows > kMostRows) throw Failure({"rows: " + std::to_string(rows) + ", at most 65536"});
    max_curvature_per_mm = finite("--max-curvature", max_curvature_per_mm);
    return watched(progress, [&](Watch&) {
        return fit_closed_form(to_gaussian_sum(profile).sum, max_curvature_per_mm, rows,
                               {.construction = chosen});
    });
}

py::array_t<double> coefficients(const ClosedForm& form) {
    std::vector<double> values;
    for (const ClosedFormCoefficients& row : form.rows)
        for (const Rgb* part : {&row.a, &row.q, &row.s, &row.k0, &row.k1})
            values.insert(values.end(), part->begin(), part->end());
    return array_of(std::move(values), {py::ssize_t(form.rows.size()), 5, 3});
}

py::array_t<double> evaluate_at(const ClosedForm& form, const py::object& n_dot_l,
                                const py::object& curvature_per_mm) {
    const std::vector<double> cosines = numbers_from(n_dot_l, "n_dot_l"),
                              curvatures = numbers_from(curvature_per_mm, "curvature_per_mm");
    if (cosines.size() != curvatures.size())
        throw Failure({"curvature_per_mm: " + std::to_string(curvatures.size()) + " numbers for " +
                       std::to_string(cosines.size()) + " of n_dot_l"});
    std::vector<double> values;
    for (size_t i = 0; i < cosines.size(); ++i) {
        if (curvatures[i] < 0) throw Failure({"curvature_per_mm: " + to_text(curvatures[i]) + " is below 0"});
        for (const double channel : evaluate(form, cosines[i], curvatures[i])) values.push_back(channel);
    }
    return array_of(std::move(values), {py::ssize_t(cosines.size()), 3});
}

}  // namespace

void add_tables(py::module_& module) {
    py::class_<MadeTable>(module, "Table")
        .def_property_readonly("values",
                               [](const py::object& self) {
                                   const Table& t = self.cast<const MadeTable&>().table;
                                   return view_of(t.data.data(), {t.height, t.width, t.channels}, self);
                               })
        .def_property_readonly("convention",
                               [](const MadeTable& made) {
                                   const Table& t = made.table;
                                   return convention_json(t.convention, t.width, t.height);
                               })
        .def_property_readonly("description", [](const MadeTable& made) { return describe(made.table); })
        .def_property_readonly("note", [](const MadeTable& made) { return made.note; });
    module.def("bake_lut", bake_lut);
    module.def("bake_zh", bake_zh);
    module.def("bake_shadow", bake_shadow);
    module.def("read_table", read_table_file);
    module.def("write_table", write_table_file);
    module.def("table_axis", axis);
    module.def("table_lookup", look_up);
    py::class_<ClosedForm>(module, "ClosedForm")
        .def_readonly("max_curvature_per_mm", &ClosedForm::max_curvature_per_mm)
        .def_property_readonly("rows", [](const ClosedForm& form) { return form.rows.size(); })
        .def_readonly("max_error", &ClosedForm::max_error);
    module.def("bake_closed_form", fit_form);
    module.def("closed_form_coefficients", coefficients);
    module.def("evaluate_closed_form", evaluate_at);
}

}  // namespace dermis::python
