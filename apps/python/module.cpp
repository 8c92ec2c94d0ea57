#include "module.h"

#include "catalog/catalog.h"
#include "dermis/bake/convention.h"
#include "dermis/scene/scene_files.h"
#include "dermis/technique/technique.h"
#include "parameter_list.h"

#include <nlohmann/json.hpp>

namespace dermis::python {
namespace {

std::vector<std::string> technique_names() {
    std::vector<std::string> names;
    for (const Technique& technique : built_in_catalog().techniques) names.push_back(technique.id);
    return names;
}

std::vector<std::string> subject_names() {
    std::vector<std::string> names;
    for (const Subject& subject : built_in_catalog().subjects) names.push_back("builtin:" + subject.name);
    return names;
}

std::string technique_parameters(const std::string& name) {
    const Technique* technique = value_of(find_technique(built_in_catalog().techniques, name));
    return cli::parameters_json(technique->parameters).dump();
}

}  // namespace

PYBIND11_MODULE(_dermis, module) {
    // Made once and kept: the exception outlives every call.
    static PyObject* error = PyErr_NewExceptionWithDoc(
        "dermis.Error", "What the command line would print: what is wrong, where, and how to correct it.",
        nullptr, nullptr);
    module.add_object("Error", py::reinterpret_borrow<py::object>(error));
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            PyErr_SetString(error, failure.what());
        }
    });
    module.def("version", [] { return std::string(tool_version()); });
    module.def("technique_names", technique_names);
    module.def("technique_parameters", technique_parameters);
    module.def("scene_names", [] { return dermis::scene_names(); });
    module.def("subject_names", subject_names);
    add_profiles(module);
    add_tables(module);
    add_meshes(module);
    add_maps(module);
    add_exports(module);
    add_pictures(module);
    add_comparisons(module);
    add_metrics(module);
}

}  // namespace dermis::python
