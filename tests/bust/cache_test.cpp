#include <gtest/gtest.h>

#include <filesystem>

#include "bust/standard_bust.h"
#include "dermis/base/parallel.h"

namespace dermis {
namespace {

bool same(const Bust& a, const Bust& b) {
    return a.mesh.positions_mm == b.mesh.positions_mm && a.mesh.normals == b.mesh.normals &&
           a.mesh.tangents == b.mesh.tangents && a.mesh.uvs == b.mesh.uvs &&
           a.mesh.indices == b.mesh.indices && a.albedo.bytes == b.albedo.bytes &&
           a.normal.bytes == b.normal.bytes && a.roughness.bytes == b.roughness.bytes &&
           a.specular.bytes == b.specular.bytes && a.kernel_size.bytes == b.kernel_size.bytes &&
           a.melanin.bytes == b.melanin.bytes && a.blood.bytes == b.blood.bytes;
}

TEST(BustCache, GivesBackWhatWasMade) {
    const Bust& made = standard_bust();
    ASSERT_FALSE(std::filesystem::is_empty(TestCache::folder() / "bust"));
    const Bust again = make_bust().value();
    EXPECT_TRUE(same(made, again));
    EXPECT_EQ(again.albedo.encoding, Encoding::srgb);
    EXPECT_EQ(again.mesh.submeshes.size(), 1u);
    EXPECT_EQ(again.mesh.submeshes[0].index_count, again.mesh.indices.size());
}

TEST(BustCache, OneThreadMakesTheSameMeshAsAllOfThem) {
    const Bust& made = standard_bust();
    set_thread_limit(1);
    const Bust alone = build_bust({}, 64).value();
    set_thread_limit(0);
    EXPECT_EQ(made.mesh.positions_mm, alone.mesh.positions_mm);
    EXPECT_EQ(made.mesh.uvs, alone.mesh.uvs);
    EXPECT_EQ(made.mesh.indices, alone.mesh.indices);
}

}  // namespace
}  // namespace dermis
