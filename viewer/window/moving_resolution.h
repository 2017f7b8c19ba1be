#pragma once

#include <cstdint>

namespace lapwing::viewer {

/// How coarsely the picture is drawn while something in it moves: coarser when frames take too
/// long, and finer again where there is time to spare. Kept from one motion to the next.
class MovingResolution {
 public:
  /// In milliseconds on the device: a frame that takes longer is felt.
  static constexpr double kLongestFrame = 50.0;
  /// One pixel drawn stands for so many of the window, across and down, at most.
  static constexpr std::uint32_t kCoarsest = 2;

  /// Pixels of the window, across and down, that one pixel drawn stands for.
  std::uint32_t pixels_per_pixel() const { return pixels_; }

  /// How long a frame took that was drawn so.
  void took(double milliseconds);

 private:
  std::uint32_t pixels_ = 1;
  int slow_ = 0;  ///< frames in a row that took too long
  int fast_ = 0;  ///< frames in a row with time to spare
  /// So many of those are waited for. More each time that finer has come out too slow, so that a
  /// mesh whose triangles take the time, and not its pixels, does not go back and forth.
  int patience_ = 4;
};

}  // namespace lapwing::viewer
