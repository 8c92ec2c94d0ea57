#pragma once
// How long the last pictures took, as a whole and pass by pass.

#include <map>
#include <string>
#include <vector>

#include "dermis/view/panels.h"
#include "dermis/view/stage.h"

namespace dermis::view {

class PictureTimes {
  public:
    /// A picture was drawn. Passes that it did not have are forgotten.
    void add(const gpu::FrameResult& timings);
    /// Size, samples and times of `picture`, and the histories, for the panels.
    void describe(const Picture& picture, PanelFacts& facts) const;

  private:
    std::vector<float> frames_ms_;
    std::map<std::string, std::vector<float>> passes_ms_;
};

}  // namespace dermis::view
