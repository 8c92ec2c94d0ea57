// Many small pictures in one process: memory and descriptors stay what they were. As a test each technique
// four times: lavapipe goes on compiling variants in the second round. For more: DERMIS_SOAK_PICTURES=10000
// build/tests/test_render --gtest_filter='Soak*'.

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/render_test.h"

using namespace dermis;

namespace {

// Of this process, in MiB.
double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    long total = 0, resident = 0;
    statm >> total >> resident;
    return double(resident) * double(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

size_t open_descriptors() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return size_t(std::distance(begin(all), end(all)));
}

class Soak : public RenderTest {};

}  // namespace

TEST_F(Soak, pictures_leave_no_memory_and_no_descriptors_behind) {
    if (!std::filesystem::exists("/proc/self/statm")) GTEST_SKIP() << "no /proc here";
    constexpr int kPicturesARenderer = 4;
    const char* stated = std::getenv("DERMIS_SOAK_PICTURES");
    const Scene scene = load("builtin:spheres");
    const auto& techniques = built_in_catalog().techniques;
    const int pictures = stated ? std::atoi(stated) : int(4 * techniques.size());
    ASSERT_GE(pictures, int(2 * techniques.size()));
    // Without the validation layers, which keep memory.
    Result<gpu::Device> plain = gpu::Device::create({});
    ASSERT_TRUE(plain) << plain.error().message;
    const auto shaders = gpu::embedded_shaders(built_in_catalog().shaders);
    // What a renderer holds depends on what it drew, so both readings are taken after the same techniques.
    const int middle = pictures - int(techniques.size()) * (pictures / int(2 * techniques.size()));
    double middle_mib = 0;
    size_t middle_descriptors = 0;
    std::optional<Renderer> renderer;
    for (int i = 0; i < pictures; ++i) {
        if (i % kPicturesARenderer == 0) {
            Result<Renderer> made = Renderer::create(*plain, shaders, scene);
            ASSERT_TRUE(made) << made.error().message;
            renderer.emplace(std::move(*made));
        }
        const Technique& technique = techniques[size_t(i) % techniques.size()];
        const Image image =
            radiance(*renderer, technique, {.width = 32, .height = 32, .shadow_map_size = 64});
        ASSERT_EQ(image.width, 32);
        if (i + 1 == middle) middle_mib = resident_mib(), middle_descriptors = open_descriptors();
    }
    std::printf("%d pictures: %.0f MiB after half of them, %.0f MiB at the end; %zu descriptors\n", pictures,
                middle_mib, resident_mib(), open_descriptors());
    EXPECT_LT(resident_mib(), middle_mib + 64);
    EXPECT_LE(open_descriptors(), middle_descriptors);
}
