#pragma once

#include <vector>

#include <Eigen/Core>

namespace lapwing::viewer {

/// An event of the desktop for a window, with GLFW's codes for buttons, keys and modifiers.
struct DesktopEvent {
  enum class Kind { move, enter, button, scroll, key, text, focus };

  Kind kind = Kind::move;
  Eigen::Vector2d cursor = Eigen::Vector2d::Zero();  ///< position at the event, in screen units
  int code = 0;                                      ///< the button, the key, or the character
  int scancode = 0;                                  ///< for keys
  int action = 0;     ///< of a button or key; for `enter` and `focus`, 1 if gained, 0 if lost
  int modifiers = 0;  ///< modifiers that were pressed at the event
  Eigen::Vector2d scroll = Eigen::Vector2d::Zero();
};

/// Determines which input events the panels can process in one frame. The panels read the state of
/// mouse and keys once per frame. They would therefore miss a click that begins and ends within one
/// frame, or count two clicks as one. An event that does not fit waits until the panels have been
/// laid out with the earlier events.
class FrameInput {
 public:
  /// Returns whether the panels can distinguish `event` from the events since the last layout, and
  /// see them in the right order. The first event always fits.
  bool fits(const DesktopEvent& event) const;
  void add(const DesktopEvent& event);
  /// Call this after the panels have been laid out.
  void clear();

 private:
  bool fits_key(const DesktopEvent& event) const;
  /// Returns whether a key was pressed or a character typed. Modifiers do not count, because they
  /// affect only later events.
  bool has_keys() const { return typed_ || !keys_.empty(); }

  bool pressed_or_released_ = false;  // whether a mouse button was pressed or released
  bool scrolled_ = false;
  bool typed_ = false;
  bool ends_with_key_ = false;  // the last event pressed a key; the next text event belongs to it
  std::vector<int> keys_;       // pressed keys
  std::vector<int> modifiers_;  // pressed modifiers
  std::vector<int> released_;   // released keys and modifiers
};

}  // namespace lapwing::viewer
