#pragma once
// Words and numbers of one line of an OBJ or MTL file. Internal to dermis/mesh.

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dermis::inline mesh {

/// Reads from the front of a line and removes what it read.
class TextCursor {
  public:
    explicit TextCursor(std::string_view line) : rest_(line) {}

    /// The next word, empty at the end of the line.
    std::string_view word() {
        skip_blanks();
        size_t size = 0;
        while (size < rest_.size() && !is_blank(rest_[size])) ++size;
        return take(size);
    }

    /// The next number, or nothing if the next word is not a number.
    std::optional<float> number() {
        skip_blanks();
        if (rest_.starts_with('+')) rest_.remove_prefix(1);
        float value = 0;
        const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (read.ec ==
            std::errc::result_out_of_range)  // from_chars leaves the value alone: 1e-50 is 0, 1e50 is not
            value = tiny(rest_.substr(0, size_t(read.ptr - rest_.data()))) ? 0.0f : HUGE_VALF;
        else if (read.ec != std::errc{})
            return std::nullopt;
        rest_.remove_prefix(size_t(read.ptr - rest_.data()));
        return value;
    }

    std::optional<int64_t> integer() {
        int64_t value = 0;
        const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (read.ec != std::errc{}) return std::nullopt;
        rest_.remove_prefix(size_t(read.ptr - rest_.data()));
        return value;
    }

    bool skip(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    }

    [[nodiscard]] bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

    [[nodiscard]] std::string_view rest() const { return rest_; }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
    static bool tiny(std::string_view number) {
        const size_t exponent = number.find_first_of("eE");
        if (exponent == std::string_view::npos) return number.find_first_of("123456789") > number.find('.');
        return number.substr(exponent + 1).starts_with('-');
    }
    std::string_view take(size_t size) {
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }

    std::string_view rest_;
};

/// Lines of a text, one at a time; a backslash at a line's end joins it with the next (stored in `joined`).
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    }

    [[nodiscard]] bool done() const { return rest_.empty(); }
    [[nodiscard]] size_t line_number() const { return number_; }  ///< of the line last read, from 1

    std::string_view next() {
        number_ += 1 + extra_;
        extra_ = 0;
        std::string_view line = physical();
        if (!continues(line)) return line;
        joined_.clear();
        while (continues(line) && !done()) {
            joined_.append(line.substr(0, line.find_last_of('\\')));
            joined_ += ' ';
            line = physical();
            ++extra_;
        }
        if (continues(line)) line = line.substr(0, line.find_last_of('\\'));
        return joined_ += line;
    }

  private:
    static bool continues(std::string_view line) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line.ends_with('\\');
    }
    std::string_view physical() {
        const size_t end = rest_.find('\n');
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        return line;
    }

    std::string_view rest_;
    std::string joined_;
    size_t number_ = 0, extra_ = 0;
};

}  // namespace dermis::inline mesh
