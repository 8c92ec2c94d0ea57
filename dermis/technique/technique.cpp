#include "dermis/technique/technique.h"

#include "dermis/base/text.h"

namespace dermis::inline technique {

Result<const Technique*> find_technique(std::span<const Technique> techniques, std::string_view id) {
    std::vector<std::string> ids;
    for (const Technique& technique : techniques) {
        if (technique.id == id) return &technique;
        ids.push_back(technique.id);
    }
    return Error{unknown_name("technique", id, ids)};
}

}  // namespace dermis::inline technique
