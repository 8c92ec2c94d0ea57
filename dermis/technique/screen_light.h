#pragma once
// Shared by techniques that blur light on the picture: the skin's diffuse light as the camera sees it, and
// the pass that shades with it once it is blurred (shaders/screen).

#include <string>

#include "dermis/technique/forward.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/technique.h"
#include "dermis/technique/transmission.h"

namespace dermis::inline technique {

/// Declares and fills, one sample a pixel: "skin_light", exitance over albedo with alpha 1 on skin, else 0;
/// "skin_z", the distance in mm along the camera's axis, 0 where there is no skin; and "skin_key_visibility",
/// how much of the key light arrives.
void add_screen_light(PassList& list, SpecularModel specular, const FrameContext& frame);

struct BeyondBlur {
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
};

/// Draws the skin with the diffuse light of `blurred`, an image as "skin_light" is, but without meaning in
/// its alpha. `own_view` shows that light alone.
void add_screen_skin(PassList& list, const std::string& blurred, SpecularModel specular, BeyondBlur beyond,
                     const FrameContext& frame, std::string_view own_view);

}  // namespace dermis::inline technique
