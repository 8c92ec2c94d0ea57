#pragma once
// The results of `dermis compare` on the terminal: tables and JSON.

#include <nlohmann/json.hpp>
#include <vector>

#include "dermis/judge/clip.h"
#include "dermis/judge/comparison.h"

namespace dermis::cli {

void print_table(const Comparison& comparison);

/// A row a scene, a column a technique; the exact answer beside them shows how far the reference can be
/// trusted.
void print_set_table(const std::vector<SubjectCase>& cases, const std::vector<Comparison>& comparisons);

/// Of each reference: mean and worst over the frames, and the share of each frame of a short clip.
void print_clip_table(const std::vector<ClipFrame>& frames);

/// `of_frames`: an array of to_json() with time_s.
[[nodiscard]] nlohmann::ordered_json clip_json(const std::string& clip, const std::vector<ClipFrame>& frames,
                                               const nlohmann::ordered_json& of_frames);

[[nodiscard]] nlohmann::ordered_json to_json(const std::string& output, const SubjectCase& one,
                                             const Comparison& comparison);

}  // namespace dermis::cli
