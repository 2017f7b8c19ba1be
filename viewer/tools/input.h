#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace lapwing::viewer {

enum class InputKind { press, release, move, scroll, key, text };
enum class MouseButton { none, left, middle, right };

/// Keys other than letters and digits. The code of a letter or digit is its upper-case character.
enum Key : int {
  kEscape = 256,
  kEnter,
  kTab,
  kBackspace,
  kDelete,
  kHome,
  kEnd,
  kLeft,
  kRight,
  kUp,
  kDown,
  kF1,
};

struct Modifiers {
  bool shift = false;
  bool control = false;
  bool alt = false;
  bool operator==(const Modifiers&) const = default;
};

/// In every keymap, the wheel with these modifiers resizes a disk, a brush or a part. Without them
/// it zooms.
inline constexpr Modifiers kSizes{.control = true};

/// An event of the window. Positions are in pixels from the upper left corner.
struct InputEvent {
  InputKind kind = InputKind::move;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  MouseButton button = MouseButton::none;
  Modifiers modifiers = {};
  int key = 0;          ///< for key events, which are presses
  char32_t text = 0;    ///< for text events
  double scroll = 0.0;  ///< for scroll events; positive away from the user
};

/// The outcome of an event.
struct Handled {
  bool taken = false;    ///< no other receiver should act on the event
  bool changed = false;  ///< the view must be drawn again
};

/// Returns by how many steps the event resizes a disk or a brush: [ and ], or the wheel with
/// kSizes. Returns 0 if it does not.
inline double size_steps(const InputEvent& event) {
  if (event.kind == InputKind::scroll && event.modifiers == kSizes) return event.scroll;
  if (event.kind != InputKind::key) return 0.0;
  return event.key == ']' ? 1.0 : event.key == '[' ? -1.0 : 0.0;
}

/// Returns the radius of a brush after `steps` of `size_steps`, within the limits of all brushes.
inline double resized_brush_pt(double radius_pt, double steps) {
  constexpr double kFactorOfStep = 1.15;
  return std::clamp(radius_pt * std::pow(kFactorOfStep, steps), 1.0, 500.0);
}

/// Returns true for mouse events and false for keyboard events.
inline bool is_of_pointer(const InputEvent& event) {
  return event.kind != InputKind::key && event.kind != InputKind::text;
}

}  // namespace lapwing::viewer
