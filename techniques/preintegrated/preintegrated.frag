#version 460
#extension GL_GOOGLE_include_directive : require
// Pre-integrated skin from tables.
#define DERMIS_TABLES
#include "techniques/preintegrated/shading.glsl"
