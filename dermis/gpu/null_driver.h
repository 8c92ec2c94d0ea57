#pragma once
// Mesa's RADV without hardware (RADV_FORCE_FAMILY): compiles pipelines, holds no image, draws nothing.

#include "dermis/gpu/device.h"

namespace dermis::gpu {

[[nodiscard]] bool null_driver_installed();

/// `chip` is one of cost/card.h: RADV ends the process at a chip that it does not know. Error: no RADV on
/// this machine, and what to install.
[[nodiscard]] Result<Device> open_null_driver(std::string_view chip);

}  // namespace dermis::gpu
