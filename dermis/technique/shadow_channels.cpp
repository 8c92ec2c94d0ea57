#include "dermis/technique/shadow_channels.h"

#include "dermis/technique/forward.h"

namespace dermis::inline technique {
namespace {

constexpr uint32_t kRedBit = 1, kGreenBit = 2, kBlueBit = 4, kAlphaBit = 8;
constexpr const char* kMap = "shadow_channels";

// The channels and images of one light.
struct LightChannels {
    std::string suffix, depth_image, vertex_shader;
    uint32_t opacity = 0, depth = 0;
};

Pass depth_pass(const LightChannels& light, LoadOp load, bool draws_depth) {
    // The key light's depth image is the frame's shadow map: points that are equal to it are those that the
    // light reaches first.
    return {.name = "shadow channels" + light.suffix,
            .kind = PassKind::geometry_light,
            .shader = "atlas/shadow_channels_depth.frag",
            .vertex_shader = light.vertex_shader,
            .colors = {{.image = kMap, .load = load, .clear = {0, 0, 0, 1}, .write_mask = light.depth}},
            .depth = DepthTarget{.image = light.depth_image,
                                 .load = draws_depth ? LoadOp::clear : LoadOp::load,
                                 .write = draws_depth,
                                 .compare = draws_depth ? Compare::less_equal : Compare::equal},
            .geometry = GeometryFilter::opaque};
}

Pass tint_pass(const LightChannels& light, bool single_channel, ShadowLookup lookup) {
    return {.name = "shadow tint" + light.suffix,
            .kind = PassKind::geometry_light,
            .shader = "renderer/shadow_tint.frag",
            .vertex_shader = light.vertex_shader,
            .colors = {{.image = kMap,
                        .load = LoadOp::load,
                        .blend = Blend::additive,
                        .write_mask = light.opacity}},
            .depth = DepthTarget{.image = light.depth_image, .load = LoadOp::load, .write = false},
            .geometry = GeometryFilter::translucent,
            .constants = {{"single_channel", int32_t(single_channel)},
                          {"adds_opacity", int32_t(lookup == ShadowLookup::single)}}};
}

}  // namespace

ShadowChannels shadow_channels_of(const ShadowChannelSettings& settings, const FrameContext& frame) {
    if (settings.second_light && frame.has_second_light) return ShadowChannels::two_lights;
    const bool tinted = settings.translucent && frame.has_translucent;
    return tinted || settings.lookup == ShadowLookup::single ? ShadowChannels::color : ShadowChannels::none;
}

void add_shadow_channels(PassList& list, const ShadowChannelSettings& settings, const FrameContext& frame) {
    const ShadowChannels channels = shadow_channels_of(settings, frame);
    if (channels == ShadowChannels::none) return;
    const ImageSize size = {frame.shadow_map_size, frame.shadow_map_size};
    list.images.push_back({.name = kMap, .format = ImageFormat::rgba16f, .size = size});
    const bool two = channels == ShadowChannels::two_lights;
    const bool tinted = settings.translucent && frame.has_translucent;
    const LightChannels key = {"", "shadow_map", "", two ? kRedBit : kRedBit | kGreenBit | kBlueBit,
                               kAlphaBit};
    list.passes.push_back(depth_pass(key, LoadOp::clear, false));
    if (tinted) list.passes.push_back(tint_pass(key, two || settings.single_channel, settings.lookup));
    if (!two) return;
    list.passes[list.passes.size() - (tinted ? 2 : 1)].colors[0].clear = {0, 0, 1, 1};
    list.images.push_back({.name = "second_shadow_depth", .format = ImageFormat::depth32f, .size = size});
    const LightChannels second = {" 2", "second_shadow_depth", "atlas/second_light.vert", kGreenBit,
                                  kBlueBit};
    list.passes.push_back(depth_pass(second, LoadOp::load, true));
    if (tinted) list.passes.push_back(tint_pass(second, true, settings.lookup));
}

void read_shadow_channels(Pass& pass, const ShadowChannelSettings& settings, const FrameContext& frame) {
    const ShadowChannels channels = shadow_channels_of(settings, frame);
    read_shadows(pass, frame.shadow_map_count, frame.has_translucent);
    // A texture that the constants switch off must be bound to something too.
    pass.reads.emplace_back("shadow_channels",
                            channels == ShadowChannels::none ? "no_image" : "shadow_channels");
    pass.constants.emplace_back("channels", int32_t(channels));
    pass.constants.emplace_back("shadow_lookup", int32_t(settings.lookup));
}

}  // namespace dermis::inline technique
