#pragma once
// How finely a picture is drawn: coarse while something moves on a slow device (fewer pixels, and what
// Technique::coarse leaves out: texels, taps, passes of the blur), whole when it stops, with four samples a
// pixel when nothing has moved for a while.

#include <optional>

namespace dermis::view {

struct Quality {
    float scale = 1;  ///< of both sides of the picture
    int samples = 1;
    friend bool operator==(const Quality&, const Quality&) = default;
};

struct QualityLimits {
    double moving_ms = 50;      ///< a frame while something moves
    double always_fine_ms = 6;  ///< a whole frame under this is drawn with all samples at once
    double still_s = 0.35;      ///< before the samples are raised
    int samples = 4;
};

/// Estimates the time of a pixel. One for each picture.
class QualityLadder {
  public:
    explicit QualityLadder(double guessed_ms_per_megapixel) : ms_per_megapixel_(guessed_ms_per_megapixel) {}

    /// The next drawing; nothing if the picture has its full quality, or is not due yet. `changed`: since
    /// the last drawing; `still_s`: since anything changed.
    [[nodiscard]] std::optional<Quality> due(bool changed, double still_s, double megapixels,
                                             const QualityLimits& limits) const;
    void drawn(Quality quality) { last_ = quality; }
    /// The time of a drawing, known some frames later.
    void measured(Quality quality, double megapixels, double time_ms);
    /// Whether the last drawing was the best there is.
    [[nodiscard]] bool is_final(const QualityLimits& limits) const;

  private:
    [[nodiscard]] Quality moving(double megapixels, const QualityLimits& limits) const;

    double ms_per_megapixel_ = 1;  ///< with one sample
    std::optional<Quality> last_;
};

}  // namespace dermis::view
