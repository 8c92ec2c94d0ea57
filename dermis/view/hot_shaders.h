#pragma once
// Shaders that follow their source files while the program runs. What was not touched comes out of the
// program; what was is compiled, and when that fails the last version without an error stays in use.

#include <map>
#include <optional>
#include <set>

#include "dermis/gpu/executor.h"
#include "dermis/view/file_watch.h"

namespace dermis::view {

class HotShaders {
  public:
    /// `embedded` is what the program was built with; `root` holds shaders/ and techniques/; where it does
    /// not exist nothing ever changes.
    HotShaders(gpu::ShaderSource embedded, std::filesystem::path root);

    /// For renderers; this must outlive them.
    [[nodiscard]] gpu::ShaderSource source();

    /// Looks at the files. True when some changed: then executors have to forget their shaders.
    [[nodiscard]] bool poll();

    /// A frame was drawn with what source() gave.
    void confirm();
    /// A frame could not be drawn with it although all of it compiled (its parts do not fit): back to what
    /// was last confirmed, with `message` to show. False when nothing had changed since.
    [[nodiscard]] bool take_back(const std::string& message);

    /// Present errors, one per shader or frame.
    [[nodiscard]] const std::map<std::string, std::string>& errors() const { return errors_; }

  private:
    using Words = std::vector<uint32_t>;
    [[nodiscard]] Result<Words> get(std::string_view name);

    std::filesystem::path root_;
    gpu::ShaderSource embedded_, disk_;
    FileWatch files_;
    bool header_changed_ = false;    ///< an included file: any shader may read it
    std::set<std::string> touched_;  ///< shaders with a source newer than the program
    std::set<std::string> stale_;    ///< of those, not yet compiled since their last change
    std::map<std::string, Words, std::less<>> compiled_, confirmed_;
    std::map<std::string, std::string> errors_;
};

}  // namespace dermis::view
