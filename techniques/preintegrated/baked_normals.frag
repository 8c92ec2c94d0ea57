#version 460
#extension GL_GOOGLE_include_directive : require
// Pre-integrated skin from tables and baked normals, with their textures in place of two that it has no use for.
#define DERMIS_TABLES
#define DERMIS_BAKED_NORMALS
#include "techniques/preintegrated/shading.glsl"
