// Scripts of dermis view: commands, or an error with the script's name; input commands become events.
// Dictionary: dermis/view/script.cpp dermis/view/script_commands.cpp

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dermis/view/script.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto script = dermis::view::parse_script(text, "fuzz.txt");
    if (!script) {
        const std::string& message = script.error().message;
        if (!message.starts_with("fuzz.txt:") || message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    for (const dermis::view::ScriptCommand& command : *script) {
        // A wait becomes as many frames as it says.
        const auto frames = dermis::view::input_frames(command);
        if (command.kind != dermis::view::CommandKind::wait && frames.size() > 16) std::abort();
    }
    return 0;
}
