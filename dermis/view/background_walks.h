#pragma once
// What gain=map and gain=links walk before their first picture takes a minute for a head. It is walked in the
// background, into the cache, from which the renderer takes it.

#include <memory>
#include <string>
#include <vector>

#include "dermis/scene/scene.h"
#include "dermis/technique/gain.h"

namespace dermis::view {

class BackgroundWalks {
  public:
    BackgroundWalks();
    /// Stops walks and waits for them, a fraction of a second.
    ~BackgroundWalks();
    BackgroundWalks(BackgroundWalks&&) noexcept;
    BackgroundWalks& operator=(BackgroundWalks&&) noexcept;

    /// Whether a picture with this gain can be drawn without walking. If not, begins to walk on a copy of the
    /// scene; walks for another skin or shape are stopped first, those for the same skin awaited.
    [[nodiscard]] bool have(const Scene& scene, Gain gain);
    [[nodiscard]] bool are_walking() const { return job_ != nullptr; }
    /// True when walks have ended since the last call; then have() knows more.
    [[nodiscard]] bool take();
    void wait() const;
    /// The scene's shapes are others.
    void forget();

  private:
    struct Job;
    std::unique_ptr<Job> job_;
    std::vector<std::string> made_;  ///< by walks_key()
};

}  // namespace dermis::view
