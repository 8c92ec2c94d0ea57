#pragma once
// The colour shadow map of Gosselin, Sander, Mitchell 2004, as passes: opaque depth in alpha, then
// translucent surfaces added into RGB with the depth test on, depth writes off and alpha untouched.

#include "dermis/technique/technique.h"
#include "shaders/atlas/constants.h"

namespace dermis::inline technique {

enum class ShadowChannels : int32_t {
    none = kChannelsNone,
    color = kChannelsColor,  ///< RGB the key light's optical depth (single: opacity), A its depth
    two_lights =
        kChannelsTwoLights  ///< R and A the key light's, G and B the second light's opacity and depth
};
/// disk: filtered over the penumbra's width. single: as the source has it, one texel with a constant bias;
/// opacities are added, so that two surfaces pass 1 - a - b, and N.L x colour is saturated.
enum class ShadowLookup : int32_t { disk = kLookupDisk, single = kLookupSingle };

struct ShadowChannelSettings {
    bool translucent = true;  ///< draw the translucent surfaces, if the scene has any
    bool second_light = false;
    bool single_channel = false;  ///< of opacity; always so with a second light
    ShadowLookup lookup = ShadowLookup::disk;
};

/// The channels that the settings need in this frame: none if the scene has nothing translucent, no second
/// light is asked for and the lookup is filtered (then the frame's own shadow map will do).
[[nodiscard]] ShadowChannels shadow_channels_of(const ShadowChannelSettings& settings,
                                                const FrameContext& frame);

/// Declares "shadow_channels" (half float) and appends its passes; nothing for `none`. The pass
/// that uses them calls read_shadow_channels().
void add_shadow_channels(PassList& list, const ShadowChannelSettings& settings, const FrameContext& frame);

/// For a pass whose shader includes shaders/atlas/shadow_channels.glsl: its reads and constants.
void read_shadow_channels(Pass& pass, const ShadowChannelSettings& settings, const FrameContext& frame);

}  // namespace dermis::inline technique
