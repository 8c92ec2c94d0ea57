#pragma once
// How much each pass of a frame has to do: counted in a frame that any Vulkan device drew, for a frame of
// another size. Plain data: what the model (model.h) needs to know of a frame.

#include <map>
#include <string>
#include <vector>

#include "dermis/render/renderer.h"
#include "dermis/technique/technique_list.h"

namespace dermis::inline report {

struct TextureBytes {
    uint64_t bytes = 0;
    size_t bytes_per_texel = 0;
};

struct PassWork {
    std::string pass;
    uint64_t vertices = 0;   ///< each vertex of a draw once; 3 for a full-screen triangle
    uint64_t indices = 0;    ///< 0 for a full-screen triangle
    uint64_t fragments = 0;  ///< that passed the depth test
    uint64_t threads = 0;    ///< of a compute pass
    /// Bytes that the frame can bind, by name; the sum for draws with different maps.
    std::map<std::string, TextureBytes> textures;
};

struct FrameWork {
    int width = 0, height = 0;  ///< of the frame that is asked for
    PassList list;
    std::vector<PassWork> passes;  ///< one for each pass of the list
};

/// Draws two frames at a quarter of each side (the second is what follows when nothing moves, as in a
/// benchmark) and scales what it counts to width x height. Errors as Renderer::draw().
[[nodiscard]] Result<FrameWork> count_work(Renderer& renderer, const Contestant& contestant, int width,
                                           int height);

}  // namespace dermis::inline report
