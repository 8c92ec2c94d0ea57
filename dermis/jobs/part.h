#pragma once
// A part of a picture: the sums over a range of its samples in a file. docs/scale.md describes the format.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dermis/image/io.h"
#include "dermis/jobs/picture_file.h"
#include "dermis/reference/picture_sums.h"

namespace dermis::inline jobs {

/// The header of a part.
struct PartFacts {
    PictureFacts picture;
    std::string version;  ///< of the code that made it
    std::string content;  ///< hash of all that the picture depends on but the number of samples
    std::string command;  ///< the shell line that made it, without range and output
    SampleRange range;
    int samples = 0;  ///< a pixel, of the whole picture
    int width = 0, height = 0;
    size_t walks = 0, lost_walks = 0, cut_channels = 0;
    std::string checksum;  ///< of the sums; set by write_part
};

/// Written completely or not at all. Every sum is written as floats that add up to it exactly: the layer
/// `radiance` has the nearest float, `radiance.2` what is left of the sum, and so on as long as any is not 0.
[[nodiscard]] Result<void> write_part(const std::filesystem::path& path, PartFacts facts,
                                      const PictureSums& sums);

struct Part {
    PartFacts facts;
    LayeredImage layers;

    /// `sums` has the part's size.
    void add_to(PictureSums& sums) const;
};

/// Errors: not a part, another format, damaged (cut off, changed).
[[nodiscard]] Result<Part> read_part(const std::filesystem::path& path);
/// The same of a file that is decoded already; `name` is for errors.
[[nodiscard]] Result<Part> part_of(LayeredImage file, std::string_view name);

/// A picture from its parts.
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
