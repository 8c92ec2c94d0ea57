#include "dermis/view/words.h"

#include <utility>

namespace dermis::view {

std::optional<std::vector<std::string>> quoted_words(std::string_view text, std::string_view quotes,
                                                     char comment) {
    std::vector<std::string> words;
    std::string word;
    char quote = 0;
    bool in_word = false;
    for (const char c : text) {
        if (quote ? c == quote : quotes.find(c) != quotes.npos) {
            quote = quote ? 0 : c;
            in_word = true;
        } else if (!quote && comment && c == comment) {
            break;
        } else if (!quote && (c == ' ' || c == '\t' || c == '\r' || c == '\n')) {
            if (in_word) words.push_back(std::exchange(word, ""));
            in_word = false;
        } else {
            word += c;
            in_word = true;
        }
    }
    if (in_word) words.push_back(word);
    if (quote) return std::nullopt;
    return words;
}

}  // namespace dermis::view
