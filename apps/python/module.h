#pragma once
// The parts of the module _dermis, a file each. What they define is for apps/python/dermis/*.py, which have
// the names, the defaults and the documentation that users see.

#include "calls.h"

namespace dermis::python {

void add_profiles(py::module_& module);
void add_tables(py::module_& module);
void add_meshes(py::module_& module);
void add_maps(py::module_& module);
void add_exports(py::module_& module);
void add_pictures(py::module_& module);
void add_comparisons(py::module_& module);
void add_metrics(py::module_& module);

}  // namespace dermis::python
