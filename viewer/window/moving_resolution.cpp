#include "window/moving_resolution.h"

#include <algorithm>

namespace lapwing::viewer {
namespace {

constexpr double kTimeToSpare = MovingResolution::kLongestFrame / 2.0;
// A single slow frame may have compiled a shader, or waited for something else.
constexpr int kSlowFrames = 2;
constexpr int kMostPatience = 256;

}  // namespace

void MovingResolution::took(double milliseconds) {
  slow_ = milliseconds > kLongestFrame ? slow_ + 1 : 0;
  fast_ = milliseconds < kTimeToSpare ? fast_ + 1 : 0;
  if (slow_ >= kSlowFrames && pixels_ < kCoarsest) {
    ++pixels_;
    slow_ = 0;
    patience_ = std::min(2 * patience_, kMostPatience);
  } else if (fast_ >= patience_ && pixels_ > 1) {
    --pixels_;
    fast_ = 0;
  }
}

}  // namespace lapwing::viewer
