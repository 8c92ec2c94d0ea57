#pragma once
// What unity_head and unreal_head share: a head of an exported package, drawn by the package's own HLSL with
// the declarations of a test in place of the engine's.

#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/gpu/executor.h"
#include "dermis/image/image.h"

namespace dermis::drawn_head {

struct Settings {
    std::filesystem::path package;
    int side = 96, points = 4;  ///< pixels; points along a side of a pixel
    bool gain = false, lambert = false;
    std::string clip;  ///< empty: the nodes as the file opens
    double time_s = 0;
    /// "normals": baked normals are not bound; "curvature": in 1/m; "srgb": directions imported as colours;
    /// "frames": the bakes do not turn with the surface; "shadow": the light is not that of its map;
    /// "reflections": the environment has none.
    std::string mistake;
};

/// The program: `NAME PACKAGE picture.exr [options]`; what it returns is the exit code.
int run(int count, char** values, const std::string& name, Result<Image> (*draw)(const Settings&));

/// HLSL text by glslc; `name` ends in .vert or .frag. Error: what the compiler says.
[[nodiscard]] Result<std::vector<uint32_t>> compiled_hlsl(const std::filesystem::path& scratch,
                                                          const std::string& name, const std::string& text,
                                                          const std::vector<std::string>& options);

/// A picture as an importer has it that leaves it uncompressed. `first_row_last`: the engine has v = 0 at
/// the bottom.
[[nodiscard]] Result<gpu::TextureData> imported_picture(const std::filesystem::path& path, bool srgb,
                                                        bool has_mips, bool first_row_last);
/// One texel in the place of a map: "white", "black", "bump".
[[nodiscard]] gpu::TextureData standard_picture(const std::string& name);

/// Everything that the draws point to.
struct Uploads {
    std::deque<gpu::Geometry> meshes;
    std::deque<gpu::Texture> textures;
};

/// Of a camera: axes of length 1, right and up across the view.
struct View {
    Vec3 eye, right, up, forward;
    float vertical_fov_rad = 1, near = 0.05f, far = 20;
};
/// Rows of the matrix into clip space, stub_clip_0 to stub_clip_3, and stub_eye.
[[nodiscard]] gpu::Values view_values(const View& view);

/// The pass head.vert, head.frag over this background, and its images, of which "radiance" is the picture.
[[nodiscard]] PassList head_pass(const nlohmann::json& background_linear);

/// Runs the list and returns the mean of each pixel's points.
[[nodiscard]] Result<Image> drawn(gpu::Device& device, const gpu::ShaderSource& shaders, const PassList& list,
                                  gpu::FrameInputs frame, const Settings& settings);

}  // namespace dermis::drawn_head
