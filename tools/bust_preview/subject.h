#pragma once
// What the preview looks at: the bust in clay or with its skin, a close-up of its field, or somebody else's
// OBJ.

#include <optional>
#include <string>

#include "subjects/bust/bust.h"
#include "subjects/bust/field.h"
#include "subjects/bust/surface.h"

namespace dermis::preview {

struct View {
    std::string name;
    double azimuth_deg, elevation_deg;  ///< of the camera; 0, 0 is the front, positive towards +X and up
    bust::Point target;
    double width_mm;
    bust::Point to_light;
};

/// Null when there is none of that name.
[[nodiscard]] const View* find_view(const std::string& name);
[[nodiscard]] std::string view_names();

struct Subject {
    bust::Surface mesh;
    std::vector<bust::Point> normals;  ///< one a vertex
    std::optional<Bust> skin;          ///< with the albedo made linear; the same vertices as `mesh`
    std::optional<BustField> field;    ///< if there, every pixel's point and normal are moved onto it
};

[[nodiscard]] Result<Subject> skin_subject(const BustParams& params);
[[nodiscard]] Subject clay_subject(const BustParams& params);
/// A coarse mesh whose pixels are moved onto the field: the quickest look at the whole head, some 2 s.
[[nodiscard]] Subject sketch_subject(const BustParams& params);
/// Only what a close-up sees, meshed at its own scale: a fraction of the time.
[[nodiscard]] Subject crop_subject(const BustParams& params, const View& view);
/// Moved so that its crown and its foremost point are the bust's.
[[nodiscard]] Result<Subject> obj_subject(const std::string& path, double mm_per_unit);

}  // namespace dermis::preview
