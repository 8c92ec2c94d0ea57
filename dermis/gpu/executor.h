#pragma once
// Runs a pass list. Bindings come from SPIR-V reflection, barriers and timings from the list.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/gpu/device.h"

namespace dermis::gpu {

/// Values of a uniform block, or of one element of a storage buffer's runtime array, by member name. A member
/// the shader has and the values lack is an error; a value the shader lacks is not.
using Values = std::map<std::string, ShaderValue, std::less<>>;

enum class DrawClass { skin, other, blended, translucent };
/// Whether a pass with this filter takes such a draw.
[[nodiscard]] bool takes(GeometryFilter filter, DrawClass draw);

/// Pixels of the targets, from the top left.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
};

/// One indexed draw. `textures` are the material's maps, `values` fill the shader's block "Material".
struct Draw {
    const Geometry* geometry = nullptr;
    uint32_t first_index = 0, index_count = 0;
    DrawClass draw_class = DrawClass::skin;
    std::map<std::string, const Texture*, std::less<>> textures;
    Values values;
    std::optional<PixelRect> scissor = {};  ///< absent: the whole target
    int profile = 0;                        ///< number of the skin's profile, see Pass::only_profile
};

class Executor;

/// An image of another executor as its last run left it; that executor outlives this one's run.
struct ForeignImage {
    const Executor* executor = nullptr;
    std::string name;
};

/// A buffer of a compute pass: an array, or a stream of a geometry on the device.
struct BufferInput {
    const Array* array = nullptr;
    const Geometry* geometry = nullptr;
    std::string stream = {};
};

/// The frame's inputs beside the list's own images. Priority for duplicate names: draw, pass, frame.
struct FrameInputs {
    int width = 0, height = 0;
    std::map<std::string, const Texture*, std::less<>> textures;
    std::map<std::string, ForeignImage, std::less<>> images;
    std::map<std::string, Values, std::less<>> blocks;  ///< uniform blocks: "Frame", "Params", ...
    std::map<std::string, std::vector<Values>, std::less<>> arrays;  ///< storage buffers: "Lights", ...
    std::map<std::string, BufferInput, std::less<>> buffers;         ///< those of Pass::buffers
    std::vector<Draw> draws;
};

struct PassTiming {
    std::string name;
    double time_ms = 0;
    uint64_t samples_passed = 0;  ///< samples that passed the depth test; 0 for compute and transfers
    uint64_t target_texels = 0;   ///< of the image it draws into
};

struct FrameResult {
    std::vector<PassTiming> passes;
    double frame_ms = 0;  ///< first timestamp to last
    uint64_t frame = 0;   ///< what Executor::submit returned
};

/// Counts of the objects that an executor holds, and of its device's pipelines.
struct Footprint {
    size_t images = 0, pipelines = 0;
    uint64_t image_bytes = 0;  ///< texels of the images, all levels and samples; drivers add padding
};

/// SPIR-V by name ("folder/name.frag"): the embedded library, or compiled from disk for hot reload.
using ShaderSource = std::function<Result<std::vector<uint32_t>>(std::string_view name)>;

/// A shader that the build compiled into the program (cmake/Shaders.cmake).
struct EmbeddedShader {
    std::string_view name;  ///< "folder/file.stage"
    std::span<const uint32_t> words;
};
/// `shaders` must outlive the source. Error: an unknown name.
[[nodiscard]] ShaderSource embedded_shaders(std::span<const EmbeddedShader> shaders);

/// Compiles root/shaders/NAME or root/techniques/NAME on every call by running glslc (about 0.15 s a shader).
/// Errors: no such file, no glslc, or what the compiler says, with file and line.
[[nodiscard]] ShaderSource disk_shaders(std::filesystem::path root);

/// Keeps images (by declaration, so persistent ones keep their content from frame to frame) and buffers
/// between runs, as its device keeps pipelines; a changed list costs only what is new in it.
class Executor {
  public:
    [[nodiscard]] static Result<Executor> create(Device& device, ShaderSource shaders);
    ~Executor();
    Executor(Executor&&) noexcept;
    Executor& operator=(Executor&&) noexcept;

    /// Records, submits and waits. Errors: a problem of the list (pass_list.h), a shader that does not
    /// compile or link, a name nothing supplies, out of memory, device lost. The message names pass, shader
    /// and binding.
    [[nodiscard]] Result<FrameResult> run(const PassList& list, const FrameInputs& inputs);

    /// As run(), but does not wait for the frame, only for the one two before it: the CPU prepares a frame
    /// while the device draws another. Returns the frame's number.
    [[nodiscard]] Result<uint64_t> submit(const PassList& list, const FrameInputs& inputs);
    /// Timings of submitted frames that are done: each once, oldest first; the last few frames only.
    [[nodiscard]] Result<std::vector<FrameResult>> finished();

    /// An image of the last list, as it was left: f16 and f32 formats as such, 8 bit as u8. Depth as one
    /// channel.
    [[nodiscard]] Result<Image> read(std::string_view image, int mip = 0);

    /// Reads all shaders again at the next run.
    void forget_shaders();

    [[nodiscard]] Footprint footprint() const;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

  private:
    explicit Executor(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dermis::gpu
