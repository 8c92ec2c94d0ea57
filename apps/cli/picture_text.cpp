#include "picture_text.h"

#include "dermis/base/text.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "command.h"

namespace dermis::cli {

void print_picture(const WrittenPicture& written, const ReferencePicture& picture) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(written.text);
    print_warnings(json["warnings"].get<std::vector<std::string>>());
    json["time_ms"] = picture.time_ms;
    if (written.json)
        std::printf("%s\n", json.dump(2).c_str());
    else
        std::printf("%s: %s%d passes, relative error %.4f, %.1f s%s%s\n",
                    printable_line(written.output).c_str(), written.stopped ? "stopped after " : "",
                    picture.passes, picture.relative_error, picture.time_ms / 1000,
                    written.credit.empty() ? "" : "\n", written.credit.c_str());
}

}  // namespace dermis::cli
