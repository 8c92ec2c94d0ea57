#include "dermis/view/state_file.h"

#include <algorithm>
#include <cstdlib>

#include "dermis/base/file.h"
#include "dermis/scene/toml_document.h"
#include "dermis/scene/toml_values.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr int kMinSide = 160, kMaxSide = 16384;

void read_side(const TomlNode& root, const char* key, int& side) {
    const TomlNode* node = root.find(key);
    if (node && node->kind == TomlKind::integer && node->integer >= kMinSide && node->integer <= kMaxSide)
        side = int(node->integer);
}

bool is_plain(std::string_view text) {
    return !text.empty() && std::ranges::none_of(text, [](unsigned char c) { return c < ' ' || c == 127; });
}

}  // namespace

fs::path state_path() {
    const char* base = std::getenv("XDG_STATE_HOME");
    if (base && *base) return fs::path(base) / "dermis/view.toml";
    const char* home = std::getenv("HOME");
    return fs::path(home && *home ? home : ".") / ".local/state/dermis/view.toml";
}

WindowState parse_state(std::string_view text) {
    WindowState state;
    const Result<TomlNode> root = parse_toml(text, "view.toml");
    if (!root) return state;
    read_side(*root, "width", state.width);
    read_side(*root, "height", state.height);
    const TomlNode* recent = root->find("recent");
    if (!recent || recent->kind != TomlKind::array) return state;
    for (const TomlNode& item : recent->items)
        if (item.kind == TomlKind::string && is_plain(item.text) && state.recent.size() < kMaxRecent)
            state.recent.push_back(item.text);
    return state;
}

std::string state_text(const WindowState& state) {
    std::string text = "# Window size and recent scenes of dermis view; this file may be deleted.\nwidth = " +
                       std::to_string(state.width) + "\nheight = " + std::to_string(state.height) +
                       "\nrecent = [\n";
    for (const std::string& path : state.recent)
        if (is_plain(path)) text += "    " + toml_string(path) + ",\n";
    return text + "]\n";
}

WindowState load_state() {
    const Result<std::string> text = read_text_file(state_path());
    return text ? parse_state(*text) : WindowState{};
}

void store_state(const WindowState& state) {
    (void)write_text_file(state_path(), state_text(state));
}

void remember(WindowState& state, const std::string& path) {
    std::error_code ec;
    const std::string kept =
        fs::is_regular_file(path, ec) ? fs::absolute(path, ec).lexically_normal().string() : path;
    std::erase(state.recent, kept);
    state.recent.insert(state.recent.begin(), kept);
    if (state.recent.size() > kMaxRecent) state.recent.resize(kMaxRecent);
}

}  // namespace dermis::view
