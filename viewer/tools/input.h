#pragma once

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

/// Returns true for mouse events and false for keyboard events.
inline bool is_of_pointer(const InputEvent& event) {
  return event.kind != InputKind::key && event.kind != InputKind::text;
}

}  // namespace lapwing::viewer
