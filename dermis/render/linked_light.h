#pragma once
// The light that walks bring to each vertex beyond the profile, by two compute passes before a technique's:
// the irradiance of all vertices of skin, then the sums over their links (dermis/rays/vertex_links.h).

#include <span>
#include <vector>

#include "dermis/gpu/executor.h"
#include "dermis/rays/vertex_links.h"
#include "dermis/render/shared_passes.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

class LinkedLight {
  public:
    /// Before links are walked. Error: an object with more vertices than a dispatch has on every device.
    [[nodiscard]] static Result<void> check(const Scene& scene);

    /// `links` are of the scene's objects, which passed check(). Memory: 8 bytes a link, 20 a vertex. Errors:
    /// the device.
    [[nodiscard]] static Result<LinkedLight> upload(gpu::Device& device, const Scene& scene,
                                                    const VertexLinks& links);

    /// Puts the passes behind those that fill the shadow maps. They write the stream "walked_gain" of the
    /// geometries: irradiance over albedo, linear, of any sign.
    void add_passes(PassList& list, const SharedPassSettings& settings) const;
    /// `geometries`: one an object of the scene.
    void add_inputs(std::span<const gpu::Geometry* const> geometries, gpu::FrameInputs& inputs) const;

  private:
    struct LinkedObject {
        size_t number;  // in the scene
        uint32_t first_vertex, vertices;
    };

    LinkedLight(gpu::Array rows, gpu::Array links, gpu::Array entering, std::vector<LinkedObject> objects)
        : rows_(std::move(rows)),
          links_(std::move(links)),
          entering_(std::move(entering)),
          objects_(std::move(objects)) {}

    gpu::Array rows_, links_, entering_;
    std::vector<LinkedObject> objects_;  // those with links
};

}  // namespace dermis::inline render
