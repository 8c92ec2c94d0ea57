#pragma once
// What `dermis reference` and `dermis merge` print of a picture that is written.

#include <string>

#include "dermis/reference/picture.h"

namespace dermis::cli {

struct WrittenPicture {
    std::string output;
    std::string text;  ///< described(): what is in the file
    std::string credit;
    bool json = false;     ///< print one JSON object
    bool stopped = false;  ///< by a signal
};

/// The warnings, then a line or an object with the time, which is not in the file: the same seed gives the
/// same bytes.
void print_picture(const WrittenPicture& written, const ReferencePicture& picture);

}  // namespace dermis::cli
