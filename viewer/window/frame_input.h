#pragma once

#include <vector>

#include "window/desktop_event.h"

namespace lapwing::viewer {

/// What the panels are told for one frame. They see mouse and keys as these are at each frame: of a
/// click within one they would see nothing, of two clicks one, and of a click and a move a click at
/// the wrong place. And who gets a key hangs on what the panels made of the click before it. So
/// an event that does not fit waits until they have been laid out.
class FrameInput {
 public:
  /// Whether the panels can tell `event` from what they were told since they were laid out, in this
  /// order. Anything fits at first.
  bool fits(const DesktopEvent& event) const;
  void add(const DesktopEvent& event);
  /// They have been laid out.
  void clear();

 private:
  bool fits_key(const DesktopEvent& event) const;
  /// Pressed or typed, but for modifiers, which only go with what follows.
  bool has_keys() const { return typed_ || !keys_.empty(); }

  bool pressed_or_released_ = false;  // a button
  bool scrolled_ = false;
  bool typed_ = false;
  bool ends_with_key_ = false;  // the text that comes next is what that key types
  std::vector<int> keys_;       // that went down
  std::vector<int> modifiers_;  // that went down
  std::vector<int> released_;
};

}  // namespace lapwing::viewer
