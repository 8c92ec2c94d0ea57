// Constants that C++ and the shaders of the atlas share. Valid C++ and GLSL, compiled by both, so that a
// number is written once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_SHADERS_ATLAS_CONSTANTS_H
#define DERMIS_SHADERS_ATLAS_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant space: unit of the blur's lengths.
const int kSpaceTexels = 0, kSpaceMm = 1;

// Specialisation constant light_map_texels, how the final mesh reads a light map: as it is; its alpha being
// the share of skin; or its colour being 0 and its alpha 1 where nothing was written.
const int kTexelsAsTheyAre = 0, kTexelsPremultiplied = 1, kTexelsWritten = 2;

// Specialisation constant channels: content of the colour shadow map.
const int kChannelsNone = 0, kChannelsColor = 1, kChannelsTwoLights = 2;

// Specialisation constant shadow_lookup.
const int kLookupDisk = 0, kLookupSingle = 1;

// Specialisation constant detail.
const int kDetailMap = 0, kDetailPixel = 1;

// Uniform block Skin, detail_kept: of texels from kDetailFirstMm, kDetailPerOctave to each doubling of their
// side.
const int kDetailSamples = 49, kDetailPerOctave = 4;
const float kDetailFirstMm = 1.0f / 64;

// Gosselin, Sander, Mitchell 2004: added to the cosine between normal and view before texels that face away
// are culled. Normals are smoother than triangles.
const float kCullBias = 0.3f;
// Ears and other thin parts, which the source exempts from culls by hand: where the kernel-size map is
// larger.
const float kThinKernel = 0.25f;

// Texels per side of a tile; tiles are kept or dropped whole.
const int kCullTile = 8;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
