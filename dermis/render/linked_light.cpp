#include "dermis/render/linked_light.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "dermis/technique/forward.h"
#include "shaders/renderer/linking.h"

namespace dermis::inline render {
namespace {

// As the shaders have them.
struct DeviceRow {
    uint32_t first = 0, count = 0;
    float scale = 0;
};
struct DeviceLink {
    uint32_t vertex = 0, weights = 0;
};

Result<gpu::Array> uploaded(gpu::Device& device, std::string_view name, const auto& values) {
    return gpu::Array::upload(device, name, std::as_bytes(std::span(values)));
}

// Red, green, blue of 11, 11, 10 bits with sign. What rounding takes from a weight, the next one gets, so
// that the sum of a row stays.
class RoundedWeights {
  public:
    explicit RoundedWeights(float scale) : per_scale_(1 / scale) {}
    uint32_t next(Vec3 weight) {
        const auto bits = [this](float value, float& left, uint32_t width) {
            const auto most = float((1u << (width - 1)) - 1);
            const float wanted = value * per_scale_ + left;
            const float rounded = std::clamp(std::round(wanted * most), -most, most);
            left = wanted - rounded / most;
            return uint32_t(int32_t(rounded)) & ((1u << width) - 1);
        };
        return bits(weight.x, left_.x, kLinkBits0) | bits(weight.y, left_.y, kLinkBits1) << kLinkBits0 |
               bits(weight.z, left_.z, kLinkBits2) << (kLinkBits0 + kLinkBits1);
    }

  private:
    float per_scale_;
    Vec3 left_;
};

struct DeviceLinks {
    std::vector<DeviceRow> rows;  // by row of VertexLinks
    std::vector<DeviceLink> links;
};

DeviceLinks packed(const VertexLinks& links) {
    DeviceLinks made;
    for (size_t r = 0; r + 1 < links.first.size(); ++r) {
        const auto row = std::span(links.links).subspan(links.first[r], links.first[r + 1] - links.first[r]);
        float scale = 0;
        for (const VertexLink& link : row)
            scale =
                std::max({scale, std::abs(link.weight.x), std::abs(link.weight.y), std::abs(link.weight.z)});
        made.rows.push_back({links.first[r], scale > 0 ? uint32_t(row.size()) : 0, scale});
        RoundedWeights rounded(scale > 0 ? scale : 1);
        for (const VertexLink& link : row) made.links.push_back({link.vertex, rounded.next(link.weight)});
    }
    if (made.links.empty()) made.links.emplace_back();  // no buffer is empty
    return made;
}

bool has_skin(const SceneObject& object) {
    return std::ranges::find(object.classes, MaterialClass::skin) != object.classes.end();
}

std::string buffer_name(size_t object, const std::string& stream) {
    return "linked " + std::to_string(object) + " " + stream;
}

}  // namespace

Result<void> LinkedLight::check(const Scene& scene) {
    // Vulkan requires 65,535 groups of every device.
    constexpr size_t kMostVertices = size_t(65535) * kLinkBlock / kLinkLanes;
    for (const SceneObject& object : scene.objects)
        if (has_skin(object) && object.mesh.positions_mm.size() > kMostVertices)
            return Error{"gain=links: " + object.name + " has " +
                         std::to_string(object.mesh.positions_mm.size()) + " vertices, more than " +
                         std::to_string(kMostVertices) + "; set gain=map or reduce the mesh"};
    return {};
}

Result<LinkedLight> LinkedLight::upload(gpu::Device& device, const Scene& scene, const VertexLinks& links) {
    const DeviceLinks made = packed(links);
    std::vector<DeviceRow> of_vertices;
    std::vector<LinkedObject> objects;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        if (has_skin(scene.objects[i]))
            objects.push_back({i, uint32_t(of_vertices.size()), uint32_t(links.rows[i].size())});
        for (const uint32_t row : links.rows[i]) of_vertices.push_back(made.rows[row]);
    }
    const std::vector<uint64_t> dark(of_vertices.size());
    DERMIS_TRY_ASSIGN(gpu::Array rows, uploaded(device, "rows of links", of_vertices));
    DERMIS_TRY_ASSIGN(gpu::Array packed_links, uploaded(device, "links", made.links));
    DERMIS_TRY_ASSIGN(gpu::Array entering, uploaded(device, "entering light", dark));
    return LinkedLight(std::move(rows), std::move(packed_links), std::move(entering), std::move(objects));
}

void LinkedLight::add_passes(PassList& list, const SharedPassSettings& settings) const {
    std::vector<Pass> passes;
    const auto add = [&](const LinkedObject& object, const std::string& name, uint32_t threads,
                         std::vector<ImageRead> buffers) {
        passes.push_back({.name = name + " light " + std::to_string(object.number + 1),
                          .kind = PassKind::compute,
                          .shader = "renderer/" + name + "_light.comp",
                          .threads = threads,
                          .buffers = std::move(buffers),
                          .values = {{"first_vertex", int32_t(object.first_vertex)},
                                     {"vertices", int32_t(object.vertices)}}});
    };
    for (const LinkedObject& object : objects_) {
        add(object, "entering", object.vertices,
            {{"Entering", "entering light"},
             {"PositionStream", buffer_name(object.number, "position_mm")},
             {"NormalStream", buffer_name(object.number, "normal")},
             {"OcclusionStream", buffer_name(object.number, "occlusion")}});
        read_shadows(passes.back(), 1 + int(settings.shadow_lights.size()), settings.has_translucent);
    }
    for (const LinkedObject& object : objects_)
        add(object, "linked", object.vertices * kLinkLanes,
            {{"Entering", "entering light"},
             {"Rows", "rows of links"},
             {"Links", "links"},
             {"LinkedStream", buffer_name(object.number, "walked_gain")}});
    const auto fills_shadow_map = [](const Pass& pass) { return pass.kind == PassKind::geometry_light; };
    const auto after = std::find_if(list.passes.rbegin(), list.passes.rend(), fills_shadow_map).base();
    list.passes.insert(after, passes.begin(), passes.end());
}

void LinkedLight::add_inputs(std::span<const gpu::Geometry* const> geometries,
                             gpu::FrameInputs& inputs) const {
    inputs.buffers["rows of links"] = {.array = &rows_};
    inputs.buffers["links"] = {.array = &links_};
    inputs.buffers["entering light"] = {.array = &entering_};
    for (const LinkedObject& object : objects_)
        for (const char* stream : {"position_mm", "normal", "occlusion", "walked_gain"})
            inputs.buffers[buffer_name(object.number, stream)] = {.geometry = geometries[object.number],
                                                                  .stream = stream};
}

}  // namespace dermis::inline render
