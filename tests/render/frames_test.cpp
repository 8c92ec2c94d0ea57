// Frame after frame of one view: objects that are made again, and files that are read.

#include <dlfcn.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>

#include "render/render_test.h"

namespace {

std::atomic<int> g_opened = 0;

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// The C library's functions for all of the program, its libraries and the driver.
extern "C" {

int open(const char* path, int flags, ...) {
    ++g_opened;
    va_list arguments;
    va_start(arguments, flags);
    const int mode = va_arg(arguments, int);
    va_end(arguments);
    return next(&open, "open")(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
    ++g_opened;
    return next(&fopen, "fopen")(path, mode);
}
}

namespace dermis {
namespace {

class SameView : public RenderTest {
  protected:
    static inline const DrawSettings kSettings = {.width = 48, .height = 48, .shadow_map_size = 128};

    static void submit(Renderer& renderer, const Technique& technique, const ParameterValues& values,
                       int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            const Result<uint64_t> submitted = renderer.submit(technique, values, kSettings);
            ASSERT_TRUE(submitted) << technique.id << ": " << submitted.error().message;
        }
    }
};

}  // namespace

TEST_F(SameView, frames_after_the_first_make_no_vulkan_object_and_open_no_file) {
    const Scene scene = load("builtin:spheres");
    for (const Technique& technique : built_in_catalog().techniques) {
        Renderer renderer = make_renderer(scene);
        const ParameterValues values = small_map_values(technique);
        submit(renderer, technique, values, 3);
        const int opened = g_opened;
        const uint64_t made = device().created_objects();
        submit(renderer, technique, values, technique.id == "lambert" ? 100 : 8);
        EXPECT_EQ(device().created_objects(), made) << technique.id;
        EXPECT_EQ(g_opened, opened) << technique.id;
    }
}

TEST_F(SameView, opened_files_are_counted) {
    const int before = g_opened;
    EXPECT_FALSE(read_text_file("/nowhere"));
    EXPECT_GT(g_opened, before);
}

TEST_F(SameView, frames_that_are_not_waited_for_show_what_those_do_that_are) {
    const Scene scene = load("builtin:spheres");
    for (const Technique& technique : built_in_catalog().techniques) {
        const ParameterValues values = small_map_values(technique);
        Renderer waits = make_renderer(scene), ahead = make_renderer(scene);
        for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(waits.draw(technique, values, kSettings));
        submit(ahead, technique, values, 3);
        EXPECT_EQ(ahead.radiance()->bytes, waits.radiance()->bytes) << technique.id;
    }
}

}  // namespace dermis
