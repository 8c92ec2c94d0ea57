#pragma once
// Packages as tests read them.

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "catalog/catalog.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "dermis/shading/skin_text.h"

namespace dermis {

/// Content by path. `gain_of_slabs` replaces the skin's; `head` are the files of a head.
inline std::map<std::string, std::string> package_of(const std::string& engine, const std::string& profile,
                                                     std::optional<Rgb> gain_of_slabs = {},
                                                     std::span<const PackageFile> head = {}) {
    std::map<std::string, std::string> files;
    const auto skin = find_profile(profile);
    EXPECT_TRUE(skin);
    if (!skin) return files;
    const auto places = package_shadow_places(*skin);
    EXPECT_TRUE(places) << places.error().message;
    if (!places) return files;
    auto gain = package_gain(*skin);
    EXPECT_TRUE(gain) << gain.error().message;
    if (!gain) return files;
    if (gain_of_slabs) gain->of_slabs = *gain_of_slabs;
    const auto package = make_package(
        engine, {*skin, shading::skin_sources(), built_in_package_templates(), *places, *gain, head});
    EXPECT_TRUE(package) << package.error().message;
    if (!package) return files;
    for (const PackageFile& file : *package)
        files[file.path] = std::string(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    return files;
}

}  // namespace dermis
