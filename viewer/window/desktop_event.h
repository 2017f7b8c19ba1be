#pragma once

#include <Eigen/Core>

namespace lapwing::viewer {

/// What the desktop says happened to a window, in GLFW's own numbers.
struct DesktopEvent {
  enum class Kind { move, enter, button, scroll, key, text, focus };

  Kind kind = Kind::move;
  Eigen::Vector2d cursor = Eigen::Vector2d::Zero();  ///< where it was then, in screen units
  int code = 0;                                      ///< the button, the key, or the character
  int scancode = 0;                                  ///< of keys
  int action = 0;  ///< of buttons and keys; of `enter` and `focus` 1 where it came, 0 where it went
  int modifiers = 0;  ///< that were down then
  Eigen::Vector2d scroll = Eigen::Vector2d::Zero();
};

}  // namespace lapwing::viewer
