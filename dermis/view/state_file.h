#pragma once
// All that the window remembers between runs: its size and the scenes last opened. One small TOML file,
// $XDG_STATE_HOME/dermis/view.toml (else ~/.local/state/dermis/view.toml); deleting it is always safe.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::view {

struct WindowState {
    int width = 1280, height = 800;
    std::vector<std::string> recent;  ///< scenes, the last one first; at most kMaxRecent
};
inline constexpr size_t kMaxRecent = 10;

[[nodiscard]] std::filesystem::path state_path();

/// Unreadable and out-of-range values are ignored.
[[nodiscard]] WindowState parse_state(std::string_view text);
[[nodiscard]] std::string state_text(const WindowState& state);

[[nodiscard]] WindowState load_state();
/// Best effort: when the file cannot be written, nothing is remembered.
void store_state(const WindowState& state);

/// Puts `path` first, once. Files become absolute, names stay names.
void remember(WindowState& state, const std::string& path);

}  // namespace dermis::view
