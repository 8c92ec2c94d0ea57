// Draws the head of an Unreal package without Unreal: the plugin's script is run with unreal.py in place of
// the editor's module, and what it makes is drawn by Vulkan with the HLSL of the plugin, compiled by glslc,
// as a linear EXR for `dermis compare --picture`. Needs python3.
//
//     build/tests/unreal_head PACKAGE picture.exr [--side 96] [--points 4] [--gain] [--lambert]
//                             [--mistake normals|curvature|srgb|shadow]
//
// --lambert is the skin without scattering, --gain has what curved skin returns beyond flat skin.

#include "engines/unreal_head/drawing.h"

int main(int count, char** values) {
    return dermis::drawn_head::run(count, values, "unreal_head", dermis::unreal_head::draw_head);
}
