#include "dermis/view/scene_edit.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/scene/toml_values.h"

namespace dermis::view {
namespace {

struct Line {
    std::string text;
    std::string table;  ///< the section that the line is in; "" before the first
    int index = 0;      ///< of an array of tables
    bool header = false;
};

// "[camera]" and "[[light]] # key": the name between the brackets, each part quoted as toml_key() does; empty
// for any other line.
std::string header_name(std::string_view line) {
    const std::string_view text = trim(line);
    const size_t open = text.find_first_not_of('[');
    if (open == 0 || open == text.npos) return "";
    std::string name, part;
    char quote = 0;
    for (size_t i = open; i < text.size(); ++i) {
        const char c = text[i];
        if (quote) {
            if (c == quote)
                quote = 0;
            else if (c == '\\' && quote == '"' && i + 1 < text.size())
                part += text[++i];
            else
                part += c;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '.' || c == ']') {
            name += (name.empty() ? "" : ".") + toml_key(part);
            part.clear();
            if (c == ']') return name;
        } else if (c != ' ' && c != '\t') {
            part += c;
        }
    }
    return "";
}

// The end of the value: a '#' or the end of the line, outside of quotes. Adds the brackets that it opens to
// `depth`.
size_t value_end(std::string_view line, size_t from, int& depth) {
    char quote = 0;
    for (size_t i = from; i < line.size(); ++i) {
        const char c = line[i];
        if (quote) {
            if (c == '\\' && quote == '"')
                ++i;
            else if (c == quote)
                quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '#') {
            return i;
        } else {
            depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        }
    }
    return line.size();
}

std::string key_of(std::string_view line) {
    const size_t equals = line.find('=');
    return equals == line.npos || trim(line).starts_with('#') ? ""
                                                              : std::string(trim(line.substr(0, equals)));
}

class Editor {
  public:
    explicit Editor(std::string_view text) {
        std::string table;
        int index = 0, depth = 0;
        std::vector<std::pair<std::string, int>> counts;
        for (const std::string_view raw : split(text, '\n')) {
            // Inside an array over several lines a '[' opens no section.
            const std::string name = depth > 0 ? "" : header_name(raw);
            if (!name.empty()) {
                table = name;
                const auto known = std::ranges::find(counts, name, &std::pair<std::string, int>::first);
                index = known == counts.end() ? 0 : ++known->second;
                if (known == counts.end()) counts.emplace_back(name, 0);
            } else {
                (void)value_end(raw, 0, depth);
                depth = std::max(depth, 0);
            }
            lines_.push_back({std::string(raw), table, index, !name.empty()});
        }
    }

    void apply(const TomlEdit& edit) {
        const auto mine = [&](const Line& line) {
            return line.table == edit.table && (edit.table.empty() || line.index == edit.index);
        };
        const auto found = std::ranges::find_if(lines_, [&](const Line& line) {
            return mine(line) && !line.header && key_of(line.text) == edit.key;
        });
        if (found != lines_.end()) return replace(found, edit);
        if (edit.value.empty()) return;
        const std::string written = edit.key + " = " + edit.value;
        auto last = lines_.begin();
        bool known = edit.table.empty();
        for (auto line = lines_.begin(); line != lines_.end(); ++line)
            if (mine(*line) && !trim(line->text).empty()) last = std::next(line), known = true;
        if (!known) {
            if (!lines_.empty() && !trim(lines_.back().text).empty())
                lines_.push_back({"", edit.table, edit.index, false});
            lines_.push_back({"[" + edit.table + "]", edit.table, edit.index, true});
            last = lines_.end();
        }
        last = std::next(lines_.insert(last, {written, edit.table, edit.index, false}));
        if (last != lines_.end() && last->header) lines_.insert(last, {"", edit.table, edit.index, false});
    }

    [[nodiscard]] std::string text() const {
        std::string result;
        for (const Line& line : lines_) result += line.text + '\n';
        while (result.ends_with("\n\n")) result.pop_back();
        return result;
    }

  private:
    void replace(std::vector<Line>::iterator line, const TomlEdit& edit) {
        const size_t equals = line->text.find('=');
        int depth = 0;
        size_t end = value_end(line->text, equals + 1, depth);
        auto last = line;
        while (depth > 0 && std::next(last) != lines_.end()) end = value_end((++last)->text, 0, depth);
        const std::string comment = last->text.substr(end);
        if (edit.value.empty()) {
            lines_.erase(line, std::next(last));
            return;
        }
        line->text =
            line->text.substr(0, equals + 1) + ' ' + edit.value + (comment.empty() ? "" : "  " + comment);
        lines_.erase(std::next(line), std::next(last));
    }

    std::vector<Line> lines_;
};

}  // namespace

std::string edit_toml(std::string_view text, const std::vector<TomlEdit>& edits) {
    Editor editor(text);
    for (const TomlEdit& edit : edits) editor.apply(edit);
    return editor.text();
}

}  // namespace dermis::view
