#pragma once

#include <cstdint>

namespace lapwing::viewer {

/// Chooses the resolution while something moves: coarser if frames take too long, and finer again
/// if there is time to spare. Persists from one motion to the next.
class MovingResolution {
 public:
  /// In milliseconds on the device. A longer frame is noticeable.
  static constexpr double kLongestFrame = 50.0;
  /// Most window pixels, across and down, per pixel drawn.
  static constexpr std::uint32_t kCoarsest = 2;

  /// Window pixels, across and down, per pixel drawn.
  std::uint32_t pixels_per_pixel() const { return pixels_; }

  /// Reports the time of a frame at this resolution.
  void took(double milliseconds);

 private:
  std::uint32_t pixels_ = 1;
  int slow_ = 0;  ///< frames in a row that took too long
  int fast_ = 0;  ///< frames in a row with time to spare
  /// Value of fast_ at which the picture gets finer. Doubles whenever it gets coarser, so that a
  /// mesh whose triangles take the time, and not its pixels, does not go back and forth.
  int patience_ = 4;
};

}  // namespace lapwing::viewer
