#pragma once
// The scenes in which the packages for browsers are compared with the renderer: a sphere of 8 mm under one
// kind of light each, as files for both. A page reads scene.json, environment.hdr, bumps.png and
// thickness.png (tests/engines/hosts).

#include <filesystem>
#include <string>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis {

/// Of a comparison at the pixels of the sphere.
struct HostScene {
    const char* name;            ///< the page's query, and the file of the renderer's scene
    int largest_level;           ///< of 255: the bound
    double share_beyond = 0;     ///< of the pixels that may be beyond it
    double min_n_dot_l = -1;     ///< pixels with less are left out
    double skipped_edge_mm = 0;  ///< half the width of what is left out at the edge of the shadow
    const char* engine = "";     ///< the only engine that has it; empty: both
    const char* settings = "";   ///< of the technique, beside those of all scenes
    bool transmission = false;   ///< is added to the renderer's picture: host_transmission.h
};

inline constexpr HostScene kHostScenes[] = {
    // Reflections are filtered in each one's own way; at the sphere's edge they are brightest.
    {.name = "environment", .largest_level = 4},
    {.name = "probe", .largest_level = 2, .engine = "three", .settings = "--set specular=none"},
    {.name = "hemisphere", .largest_level = 2, .settings = "--set specular=none"},
    {.name = "point", .largest_level = 2},
    // The cone's edge crosses the sphere. three.js has its own curve there, Babylon that of glTF as Dermis.
    {.name = "spot", .largest_level = 2, .share_beyond = 0.05, .engine = "three"},
    {.name = "spot", .largest_level = 2, .share_beyond = 0.002, .engine = "babylon"},
    {.name = "lights", .largest_level = 2},
    // The edge of the shadow is filtered in each one's own way; engines have shadows of the sphere on itself
    // near the terminator. Babylon has a pixel of 4 levels here and one in "bumps".
    {.name = "shadow",
     .largest_level = 3,
     .share_beyond = 0.00005,
     .min_n_dot_l = 0.4,
     .skipped_edge_mm = 1.5,
     .settings = "--set shadow=plain"},
    // A few pixels of the edge, where the reflection is steep, are beyond.
    {.name = "through", .largest_level = 2, .share_beyond = 0.0005, .transmission = true},
    {.name = "bumps", .largest_level = 3, .share_beyond = 0.00005, .settings = "--set normals=sharp"},
};

inline constexpr float kHostRadiusMm = 8;

/// Of the sphere at a pixel of a picture.
[[nodiscard]] Vec3 sphere_normal(int x, int y, int side);

/// What pages read.
void write_host_data(const std::filesystem::path& folder);
/// What the renderer reads: NAME.toml with its files, beside those of write_host_data().
void write_renderer_scenes(const std::filesystem::path& folder);

/// Whether a pixel of the sphere is compared.
[[nodiscard]] bool is_compared(const HostScene& scene, int x, int y, int side);

}  // namespace dermis
