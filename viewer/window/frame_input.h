#pragma once

#include <vector>

#include "window/desktop_event.h"

namespace lapwing::viewer {

/// The input that the panels get for one frame. They see mouse and keys only as these are at each
/// frame: they would miss a click within a frame, take two clicks for one, and see a click before a
/// move at the wrong place. Where a key goes also depends on the click before it. So an event that
/// does not fit waits until the panels have been laid out.
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
