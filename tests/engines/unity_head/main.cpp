// Draws the head of a Unity package without Unity: the package's HLSL, compiled by glslc, run by Vulkan over
// the package's own meshes and pictures, as a linear EXR for `dermis compare --picture`.
//
//     build/tests/unity_head PACKAGE picture.exr [--side 96] [--points 4] [--gain] [--lambert]
//                            [--clip NAME --time SECONDS] [--mistake normals|curvature|srgb|frames]
//
// --lambert is the skin without scattering, --gain has what curved skin returns beyond flat skin. A clip
// moves the head as Unity's SkinnedMeshRenderer would.

#include <cstdio>
#include <cstdlib>

#include "dermis/image/io.h"
#include "engines/unity_head/drawing.h"

int main(int count, char** values) {
    dermis::unity_head::DrawingSettings settings;
    std::vector<std::string> files;
    for (int i = 1; i < count; ++i) {
        const std::string word = values[i], next = i + 1 < count ? values[i + 1] : "";
        if (word == "--gain" || word == "--lambert") {
            (word == "--gain" ? settings.gain : settings.lambert) = true;
        } else if (word == "--side" || word == "--points") {
            (word == "--side" ? settings.side : settings.points) = std::atoi(next.c_str());
            ++i;
        } else if (word == "--mistake" || word == "--clip") {
            (word == "--clip" ? settings.moment.clip : settings.mistake) = next;
            ++i;
        } else if (word == "--time") {
            settings.moment.time_s = std::atof(next.c_str());
            ++i;
        } else {
            files.push_back(word);
        }
    }
    if (files.size() != 2 || settings.side < 1 || settings.points < 1) {
        std::fprintf(stderr, "unity_head: give a package and a picture: unity_head PACKAGE picture.exr\n");
        return 2;
    }
    settings.package = files[0];
    const auto drawn = dermis::unity_head::draw_head(settings);
    const auto written = drawn ? dermis::write_image(files[1], *drawn) : dermis::Result<void>(drawn.error());
    if (written) return 0;
    std::fprintf(stderr, "unity_head: %s\n", written.error().message.c_str());
    return 1;
}
