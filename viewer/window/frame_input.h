#pragma once

#include <vector>

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

/// Collects the input events of one frame for the panels. The panels read the state of the mouse
/// and the keys once per frame. They would therefore miss a click that begins and ends within one
/// frame, or count two clicks as one. An event that does not fit waits until
/// the panels have been laid out with the earlier events.
class FrameInput {
 public:
  /// Whether the panels can tell `event` from the events since the last layout, in this order. The
  /// first event always fits.
  bool fits(const DesktopEvent& event) const;
  void add(const DesktopEvent& event);
  /// Call this when the panels have been laid out.
  void clear();

 private:
  bool fits_key(const DesktopEvent& event) const;
  /// Whether a key was pressed or typed. Modifiers alone do not count, because they affect only
  /// later events.
  bool has_keys() const { return typed_ || !keys_.empty(); }

  bool pressed_or_released_ = false;  // a mouse button
  bool scrolled_ = false;
  bool typed_ = false;
  bool ends_with_key_ = false;  // the next text event belongs to that key
  std::vector<int> keys_;       // pressed
  std::vector<int> modifiers_;  // pressed
  std::vector<int> released_;
};

}  // namespace lapwing::viewer
