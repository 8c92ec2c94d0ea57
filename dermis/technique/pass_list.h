#pragma once
// A frame as data: the images it needs and the passes that fill them. dermis/gpu executes it; nothing here
// uses Vulkan.
//
// Names tie it together. A texture, block or specialisation constant in a shader is bound to what carries its
// name: an image of this list, an input of the frame (shadow_map, environment_cube, ...), a map of the
// material being drawn, or a value. A map is a sampler2D, with the address modes that its material states.
// Everything else is a texture2D, and samplers have fixed names: linear_clamp, nearest_clamp,
// trilinear_clamp, shadow_compare.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/optics/diffused_normals.h"

namespace dermis::inline technique {

enum class ImageFormat { r8, rg8, rgba8, rgb10a2, rgba16, r16f, rg16f, rgba16f, r32f, rgba32f, depth32f };
[[nodiscard]] std::string_view format_name(ImageFormat format);
[[nodiscard]] size_t bytes_per_texel(ImageFormat format);

/// width = height = 0: the frame's size times frame_scale.
struct ImageSize {
    int width = 0, height = 0;
    float frame_scale = 1;
    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

struct ImageDeclaration {
    std::string name;
    ImageFormat format = ImageFormat::rgba16f;
    ImageSize size;
    int samples = 1;          ///< 1 or 4
    int mips = 1;             ///< 0: a full chain
    bool persistent = false;  ///< keeps its content into the next frame
    friend bool operator==(const ImageDeclaration&, const ImageDeclaration&) = default;
};

struct TexelSize {
    int width = 0, height = 0;
};
/// Size of an image in a frame of this size.
[[nodiscard]] TexelSize size_in_frame(const ImageSize& size, int frame_width, int frame_height);
/// Bytes of all levels and samples.
[[nodiscard]] uint64_t bytes_in_frame(const ImageDeclaration& image, int frame_width, int frame_height);

/// The work of a pass. geometry_screen: through the camera; geometry_uv_atlas: at uv * 2 - 1;
/// geometry_light: from the key light. resolve, generate_mips and copy are transfers from reads[0] (to
/// colors[0]).
enum class PassKind {
    fullscreen,
    compute,
    geometry_screen,
    geometry_uv_atlas,
    geometry_light,
    resolve,
    generate_mips,
    copy
};

/// Which of the scene's draws a geometry pass takes; opaque: all but translucent.
enum class GeometryFilter { skin, other, blended, opaque, translucent, all };

enum class LoadOp { clear, load, discard };
enum class Blend { none, additive, alpha, multiply };
enum class Compare { less, less_equal, equal, always };
enum class Cull { none, back, front };

struct ColorTarget {
    std::string image;
    LoadOp load = LoadOp::clear;
    std::array<float, 4> clear = {0, 0, 0, 0};
    Blend blend = Blend::none;
    uint32_t write_mask = 0xF;  ///< bits: 1 red, 2 green, 4 blue, 8 alpha
    int mip = 0;
};

/// Depth that is loaded and not written may be read by the same pass.
struct DepthTarget {
    std::string image;
    LoadOp load = LoadOp::clear;
    float clear = 1;
    bool write = true;
    Compare compare = Compare::less_equal;
};

/// Binds the shader's `texture` (or storage image) to `image`; one name when both are the same.
struct ImageRead {
    std::string texture, image;
    ImageRead(const char* name) : texture(name), image(name) {}
    ImageRead(std::string name) : texture(name), image(std::move(name)) {}
    ImageRead(std::string texture_name, std::string image_name)
        : texture(std::move(texture_name)), image(std::move(image_name)) {}
};

using ShaderValue = std::variant<int32_t, float, Vec2, Vec3, Vec4, Mat4>;
using NamedValue = std::pair<std::string, ShaderValue>;

struct Pass {
    std::string name;
    PassKind kind = PassKind::fullscreen;
    /// Fragment or compute, "folder/name.frag". Empty: geometry that writes depth only, or a fullscreen pass
    /// that only clears its targets.
    std::string shader;
    std::string vertex_shader;  ///< empty: the shared one of the kind
    std::vector<ImageRead> reads;
    std::vector<ColorTarget> colors;
    std::optional<DepthTarget> depth;
    std::vector<ImageRead> storage;  ///< images a compute pass writes; the first one's size gives its groups
    /// Compute passes without storage images: threads along x, and FrameInputs::buffers by the names
    /// of the shader's storage buffers. The shader may write them.
    uint32_t threads = 0;
    std::vector<ImageRead> buffers;
    GeometryFilter geometry = GeometryFilter::skin;
    Cull cull = Cull::none;
    float depth_bias_constant = 0, depth_bias_slope = 0;
    std::vector<std::pair<std::string, int32_t>> constants;  ///< specialisation constants by name
    std::vector<NamedValue> values;                          ///< members of the shader's push-constant block
    /// Number of the skin's profile that the pass works for, 0 for all where there is one: uniform blocks
    /// named "Skin@1" take precedence over "Skin". With `only_profile` it takes skin of this profile only.
    int profile = 0;
    bool only_profile = false;
};

/// "Skin@1" for profile 1; the name itself for profile 0.
[[nodiscard]] std::string profile_name(const std::string& name, int profile);

/// Asks for the textures "seam_map" and "chart_map" of the skin's atlas (mesh/uv_seams.h), `size` texels a
/// side: where the surface of each gutter texel lies, as x / 8 and rest, y / 8 and rest, negative for
/// nowhere; and whose chart it is.
struct SeamRequest {
    int size = 1024;
    int width_texels = 32;
    friend bool operator==(const SeamRequest&, const SeamRequest&) = default;
};

/// The textures that PassList::diffused_normals asks for. Red's mean normal: its direction, n * .5 + .5, in
/// rgb; of length 0 where there is no skin. Green's direction less red's: of each part the root with its
/// sign, from -1 at 1 / 255 to 1, in rgb; in alpha sqrt(1 - length) of red's mean. How unevenly red's normals
/// spread: p and q of rays/diffused_normals.h, x
/// * .5 + .5.
inline constexpr std::array<const char*, 3> kDiffusedNormalsTextures = {
    "diffused_normals_red", "diffused_normals_green", "diffused_normals_uneven"};

struct PassList {
    std::vector<ImageDeclaration> images;
    std::vector<Pass> passes;
    /// Specialisation constants of the whole frame: a shader takes those that it declares, unless its pass
    /// has them. Where neither has on_cpu, it is 1 on a software device.
    std::vector<std::pair<std::string, int32_t>> constants;
    std::optional<SeamRequest> seams;
    std::optional<DiffusedNormalsRequest> diffused_normals;
    /// Material maps that these settings need. A skin material without one of them gets a warning.
    std::vector<std::string> needed_maps;
    /// Warnings: what is drawn instead of a setting's best, as the scene lacks something.
    std::vector<std::string> notices;
    /// Why the scene cannot be drawn with these settings, and what to change; empty: it can.
    std::string refusal;

    [[nodiscard]] const ImageDeclaration* find_image(std::string_view name) const;
};

/// Everything wrong with a list, one line each; empty when it can run. `inputs` are the images the frame
/// supplies. Found: duplicate names, images read or loaded before anything wrote them (persistent ones
/// excepted), a pass that reads what it writes, targets of one pass with different sizes or sample counts,
/// missing shaders, no targets.
[[nodiscard]] std::vector<std::string> problems(const PassList& list, const std::vector<std::string>& inputs);

/// As text: a line per image and per pass.
[[nodiscard]] std::string describe(const PassList& list);

}  // namespace dermis::inline technique
