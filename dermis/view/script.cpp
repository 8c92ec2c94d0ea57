#include "dermis/view/script.h"

#include <algorithm>
#include <span>

#include "dermis/base/text.h"
#include "dermis/view/words.h"

namespace dermis::view {
namespace {

// The arguments of a command: 'w' a word, 'n' a number in its range, 'b' a mouse button, 'k' a key, 'm' any
// modifiers.
struct Grammar {
    std::string_view name;
    CommandKind kind;
    std::string_view wants;
    std::string_view example;
};
constexpr Grammar kGrammar[] = {{"open", CommandKind::open, "w", "open head.obj"},
                                {"technique", CommandKind::technique, "w", "technique wrap"},
                                {"set", CommandKind::set, "w", "set wrap=0.4"},
                                {"view", CommandKind::view, "w", "view curvature"},
                                {"tone", CommandKind::tone, "n", "tone 5"},
                                {"scene", CommandKind::scene, "w", "scene material.M_Lips.class=skin"},
                                {"clip", CommandKind::clip, "w", "clip talk"},
                                {"time", CommandKind::time, "n", "time 1.2"},
                                {"play", CommandKind::play, "", "play"},
                                {"pause", CommandKind::pause, "", "pause"},
                                {"morph", CommandKind::morph, "wn", "morph jawOpen 0.6"},
                                {"drag", CommandKind::drag, "bnnnnm", "drag left 300 300 420 280 ctrl"},
                                {"scroll", CommandKind::scroll, "nnn", "scroll 300 300 -2"},
                                {"key", CommandKind::key, "k", "key ctrl+C"},
                                {"type", CommandKind::type, "w", "type head.glb"},
                                {"slide", CommandKind::slide, "wn", "slide wrap 0.7"},
                                {"click", CommandKind::click, "w", "click head.M_Lips.visible"},
                                {"undo", CommandKind::undo, "", "undo"},
                                {"redo", CommandKind::redo, "", "redo"},
                                {"drop", CommandKind::drop, "w", "drop head.glb"},
                                {"copy", CommandKind::copy, "ww", "copy broken.frag shaders/a/b.frag"},
                                {"save", CommandKind::save, "w", "save scene.toml"},
                                {"clipboard", CommandKind::clipboard, "w", "clipboard \"yaw_deg=30\""},
                                {"resize", CommandKind::resize, "nn", "resize 640 480"},
                                {"minimise", CommandKind::minimise, "", "minimise"},
                                {"restore", CommandKind::restore, "", "restore"},
                                {"wait", CommandKind::wait, "n", "wait 5"},
                                {"settle", CommandKind::settle, "", "settle"},
                                {"screenshot", CommandKind::screenshot, "w", "screenshot picture.png"},
                                {"capture", CommandKind::capture, "w", "capture window.png"},
                                {"lose_device", CommandKind::lose_device, "", "lose_device"},
                                {"print", CommandKind::print, "", "print"},
                                {"quit", CommandKind::quit, "", "quit"}};

// The maximum of pixels, frames and steps of the wheel in a script.
constexpr double kMaxNumber = 1e5;
constexpr int kDragFrames = 4;

Result<MouseButton> parse_button(std::string_view text) {
    static const std::vector<std::string> kNames = {"left", "right", "middle"};
    const auto found = std::ranges::find(kNames, text);
    if (found == kNames.end()) return Error{unknown_name("mouse button", text, kNames)};
    return MouseButton(found - kNames.begin());
}

Result<void> take_word(ScriptCommand& command, char want, const std::string& word) {
    if (want == 'w') {
        command.words.push_back(word);
    } else if (want == 'n') {
        const auto number = parse_number(word);
        if (!number || !(std::abs(*number) <= kMaxNumber))
            return Error{"'" + word + "' is not a number within -100000 to 100000"};
        command.numbers.push_back(*number);
    } else if (want == 'b') {
        const Result<MouseButton> button = parse_button(word);
        if (!button) return button.error();
        command.button = *button;
    } else if (want == 'k') {
        const Result<KeyChord> chord = parse_key_chord(word);
        if (!chord) return chord.error();
        command.chord = *chord;
    } else {
        DERMIS_TRY_ASSIGN(const KeyChord chord, parse_key_chord(word + "+A"));
        command.modifiers = chord.modifiers;
    }
    return {};
}

Result<ScriptCommand> parse_command(std::span<const std::string> words) {
    std::vector<std::string> names;
    for (const Grammar& grammar : kGrammar) names.emplace_back(grammar.name);
    const auto grammar = std::ranges::find(kGrammar, words[0], &Grammar::name);
    if (grammar == std::end(kGrammar)) return Error{unknown_name("command", words[0], names)};
    const Error wrong{words[0] + ": write it like this: " + std::string(grammar->example)};
    const bool optional_last = grammar->wants.ends_with('m');
    const size_t most = grammar->wants.size(), least = most - (optional_last ? 1 : 0);
    if (words.size() - 1 < least || words.size() - 1 > most) return wrong;
    ScriptCommand command{.kind = grammar->kind};
    for (size_t i = 1; i < words.size(); ++i)
        if (const Result<void> taken = take_word(command, grammar->wants[i - 1], words[i]); !taken)
            return Error{words[0] + ": " + taken.error().message};
    if (command.kind == CommandKind::resize && (command.numbers[0] < 1 || command.numbers[1] < 1))
        return wrong;
    return command;
}

Event moved(Vec2 at_px) {
    return {.kind = EventKind::mouse_move, .position_px = at_px};
}

Event button(const ScriptCommand& command, Vec2 at_px, bool pressed) {
    return {.kind = EventKind::mouse_button,
            .position_px = at_px,
            .button = command.button,
            .pressed = pressed,
            .modifiers = command.modifiers};
}

std::deque<std::vector<Event>> drag_frames(const ScriptCommand& command, Vec2 from_px, Vec2 to_px) {
    std::deque<std::vector<Event>> frames = {{moved(from_px)}, {button(command, from_px, true)}};
    for (int i = 1; i <= kDragFrames; ++i)
        frames.push_back({moved(from_px + (to_px - from_px) * (float(i) / kDragFrames))});
    frames.push_back({button(command, to_px, false)});
    return frames;
}

}  // namespace

Result<std::vector<ScriptCommand>> parse_script(std::string_view text, const std::string& file) {
    if (text.size() > kMaxScriptBytes) return Error{file + ": a script of more than 1 MiB"};
    std::vector<ScriptCommand> commands;
    int line_number = 0;
    for (const std::string_view line : split(without_byte_order_mark(text), '\n')) {
        ++line_number;
        const std::string place = file + ":" + std::to_string(line_number) + ": ";
        const auto words = quoted_words(line, "\"", '#');
        if (!words) return Error{place + "a quotation mark is missing"};
        if (words->empty()) continue;
        Result<ScriptCommand> command = parse_command(*words);
        if (!command) return Error{place + command.error().message};
        command->line = line_number;
        commands.push_back(std::move(*command));
    }
    return commands;
}

FileUse script_files(const std::vector<ScriptCommand>& script) {
    FileUse files;
    for (const ScriptCommand& command : script) {
        const bool saves = command.kind == CommandKind::save;
        if (!saves && command.kind != CommandKind::screenshot && command.kind != CommandKind::capture)
            continue;
        const std::filesystem::path& path = command.words[0];
        if (!saves || std::ranges::find(files.outputs, path) == files.outputs.end())
            files.outputs.push_back(path);
    }
    return files;
}

std::deque<std::vector<Event>> input_frames(const ScriptCommand& command) {
    const auto point = [&](size_t first) {
        return Vec2{float(command.numbers[first]), float(command.numbers[first + 1])};
    };
    switch (command.kind) {
        case CommandKind::drag:
            return drag_frames(command, point(0), point(2));
        case CommandKind::scroll:
            return {
                {moved(point(0))},
                {{.kind = EventKind::scroll, .position_px = point(0), .scroll = float(command.numbers[2])}}};
        case CommandKind::key: {
            Event press = {.kind = EventKind::key,
                           .pressed = true,
                           .key = command.chord.key,
                           .modifiers = command.chord.modifiers};
            Event release = press;
            release.pressed = false;
            release.modifiers = {};
            return {{press}, {release}};
        }
        case CommandKind::type: {
            std::vector<Event> typed;
            for (const char c : command.words[0])
                typed.push_back({.kind = EventKind::text, .character = static_cast<unsigned char>(c)});
            return {typed, {}};
        }
        case CommandKind::drop:
            return {{{.kind = EventKind::drop, .paths = {command.words[0]}}}};
        case CommandKind::wait:
            return std::deque<std::vector<Event>>(size_t(std::max(command.numbers[0], 0.0)));
        default:
            return {};
    }
}

std::deque<std::vector<Event>> click_frames(const Region& widget) {
    const ScriptCommand left;
    const Vec2 at_px = {widget.x + widget.width / 2, widget.y + widget.height / 2};
    return {{moved(at_px)}, {button(left, at_px, true)}, {button(left, at_px, false)}, {}};
}

std::deque<std::vector<Event>> slide_frames(const Region& widget, double share) {
    const ScriptCommand left;
    const float y = widget.y + widget.height / 2;
    return drag_frames(left, {widget.x + widget.width / 2, y}, {widget.x + widget.width * float(share), y});
}

}  // namespace dermis::view
