#pragma once
// Everything that an engine's build includes; docs/library.md shows its use.

#include "dermis/bake/convention.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/table.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/file.h"
#include "dermis/base/result.h"
#include "dermis/base/shared_bytes.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/material.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/pose.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/medium.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/profile.h"
#include "dermis/optics/profile_file.h"
#include "dermis/optics/tabulated_profile.h"
#include "dermis/shading/shading.h"
#include "dermis/shading/skin_text.h"
#include "dermis/shading/syntax.h"

// Scenes and rays are part of full builds only: they need Embree.
#if __has_include("dermis/rays/bake_map.h")
#include "dermis/rays/bake_map.h"
#include "dermis/rays/map_file.h"
#include "dermis/scene/scene.h"
#endif
