#pragma once
// The commands of a script, one after the other, each when the window is ready for it.

#include <span>
#include <string>

#include "dermis/view/script.h"

namespace dermis::view {

class ScriptPlayer {
  public:
    /// `commands` must outlive it; may be empty. `name` is for messages.
    ScriptPlayer(std::span<const ScriptCommand> commands, std::string name)
        : commands_(commands), name_(std::move(name)) {}

    [[nodiscard]] bool has_script() const { return !commands_.empty(); }
    /// The command that is due, or null; `settled`: the picture has its full quality.
    [[nodiscard]] const ScriptCommand* next(bool settled);
    /// All commands are done; false without a script.
    [[nodiscard]] bool is_over(bool settled) const {
        return has_script() && begun_ == commands_.size() && (!settling_ || settled);
    }
    /// The next command waits until it is.
    void settle() { settling_ = true; }
    /// How many were begun.
    [[nodiscard]] size_t begun() const { return begun_; }

    /// An error of a command, with its place in the script.
    [[nodiscard]] Error error_at(const ScriptCommand& command, const Error& error) const;

  private:
    std::span<const ScriptCommand> commands_;
    std::string name_;
    size_t begun_ = 0;
    bool settling_ = false;
};

}  // namespace dermis::view
