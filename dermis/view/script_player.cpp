#include "dermis/view/script_player.h"

namespace dermis::view {

const ScriptCommand* ScriptPlayer::next(bool settled) {
    if (begun_ >= commands_.size() || (settling_ && !settled)) return nullptr;
    settling_ = false;
    return &commands_[begun_++];
}

Error ScriptPlayer::error_at(const ScriptCommand& command, const Error& error) const {
    return error.within(name_ + ":" + std::to_string(command.line));
}

}  // namespace dermis::view
