#include "catalog/catalog.h"

#include "catalog/parts.h"

namespace dermis {

const Catalog& built_in_catalog() {
    static const Catalog catalog = {
        .techniques = built_in_techniques(), .subjects = built_in_subjects(), .shaders = built_in_shaders()};
    return catalog;
}

}  // namespace dermis
