// Draws the head of a Unity package without Unity: the package's HLSL, compiled by glslc, run by Vulkan over
// the package's own meshes and pictures, as a linear EXR for `dermis compare --picture`.
//
//     build/tests/unity_head PACKAGE picture.exr [--side 96] [--points 4] [--gain] [--lambert]
//                            [--clip NAME --time SECONDS] [--mistake normals|curvature|srgb|frames]
//
// --lambert is the skin without scattering, --gain has what curved skin returns beyond flat skin. A clip
// moves the head as Unity's SkinnedMeshRenderer would.

#include "engines/unity_head/drawing.h"

int main(int count, char** values) {
    return dermis::drawn_head::run(count, values, "unity_head", dermis::unity_head::draw_head);
}
