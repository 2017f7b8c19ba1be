#pragma once

#include <Eigen/Core>

namespace lapwing::viewer {

/// An event of the desktop for a window, in GLFW's numbers.
struct DesktopEvent {
  enum class Kind { move, enter, button, scroll, key, text, focus };

  Kind kind = Kind::move;
  Eigen::Vector2d cursor = Eigen::Vector2d::Zero();  ///< position at the event, in screen units
  int code = 0;                                      ///< the button, the key, or the character
  int scancode = 0;                                  ///< for keys
  int action = 0;     ///< of buttons and keys; for `enter` and `focus` 1 if gained, 0 if lost
  int modifiers = 0;  ///< pressed at the event
  Eigen::Vector2d scroll = Eigen::Vector2d::Zero();
};

}  // namespace lapwing::viewer
