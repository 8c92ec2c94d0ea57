// In place of mtlx.cpp where DERMIS_WITH_MATERIALX is off: what find_profile() asks for. mtlx.h is not
// installed.

#include "dermis/base/not_built_in.h"
#include "dermis/optics/mtlx.h"

namespace dermis::inline optics {

Result<Profile> read_mtlx(const std::filesystem::path& path) {
    return not_built_in("MaterialX", "DERMIS_WITH_MATERIALX").within(path.string());
}

}  // namespace dermis::inline optics
