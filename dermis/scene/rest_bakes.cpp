#include "dermis/scene/rest_bakes.h"

#include <algorithm>
#include <vector>

#include "dermis/base/text.h"

namespace dermis::inline scene {
namespace {

struct RestBake {
    const char* word;
    bool RestBakes::*member;
};
constexpr RestBake kRestBakes[] = {{"normals", &RestBakes::normals},
                                   {"curvature", &RestBakes::curvature},
                                   {"stencils", &RestBakes::stencils},
                                   {"gain", &RestBakes::gain},
                                   {"occlusion", &RestBakes::occlusion}};
constexpr RestBakes kAllRestBakes = {.normals = true, .curvature = true, .gain = true, .occlusion = true};

}  // namespace

Result<RestBakes> parse_rest_bakes(std::string_view text) {
    if (text == "all") return kAllRestBakes;
    if (text == "none") return RestBakes{};
    std::vector<std::string> known = {"all", "none"};
    for (const RestBake& bake : kRestBakes) known.emplace_back(bake.word);
    RestBakes bakes;
    for (const std::string_view word : split(text, '+')) {
        const auto found = std::ranges::find(kRestBakes, word, &RestBake::word);
        if (found == std::end(kRestBakes))
            return Error{unknown_name("rest bake", std::string(word), known) + "; '+' joins them"};
        bakes.*found->member = true;
    }
    if (bakes.curvature && bakes.stencils)
        return Error{"rest bakes: stencils change the curvature that curvature keeps; name one of them"};
    return bakes;
}

Result<void> check_rest_objects(const Scene& scene) {
    for (size_t i = 0; i < scene.rest_objects.size(); ++i) {
        const Mesh &posed = scene.objects[i].mesh, &still = scene.rest_objects[i].mesh;
        if (posed.indices == still.indices && posed.positions_mm.size() == still.positions_mm.size())
            continue;
        return Error{"animation.rest_bakes: '" + scene.objects[i].name + "' has " +
                     std::to_string(still.triangle_count()) + " triangles at rest and " +
                     std::to_string(posed.triangle_count()) +
                     " in its pose, or in another order; only vertices that stay carry bakes along"};
    }
    return {};
}

std::string rest_bakes_text(const RestBakes& bakes) {
    if (bakes == kAllRestBakes) return "all";
    std::vector<std::string> words;
    for (const RestBake& bake : kRestBakes)
        if (bakes.*bake.member) words.emplace_back(bake.word);
    return words.empty() ? "none" : join(words, "+");
}

}  // namespace dermis::inline scene
