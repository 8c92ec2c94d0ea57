#version 460
#extension GL_GOOGLE_include_directive : require
// Pre-integrated skin without any table.
#include "techniques/preintegrated/shading.glsl"
