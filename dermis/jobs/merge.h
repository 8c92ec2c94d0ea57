#pragma once
// A picture from its parts.

#include <filesystem>
#include <functional>
#include <span>

#include "dermis/jobs/part.h"

namespace dermis::inline jobs {

struct MergedPicture {
    ReferencePicture picture;
    PartFacts facts;  ///< of one of them: what all have in common
};

/// Reads one part after the other; the result does not depend on their order. `progress` is called after each
/// with the share that is done. Errors, in one line: a part of another picture (the first fact that differs),
/// parts that overlap, all parts that are damaged and all samples that no part has, with the command for
/// them.
[[nodiscard]] Result<MergedPicture> merge_parts(std::span<const std::filesystem::path> files,
                                                const std::function<void(double)>& progress = {});

}  // namespace dermis::inline jobs
