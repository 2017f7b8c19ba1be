#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace lapwing::viewer {

enum class InputKind { press, release, move, scroll, key, text };
enum class MouseButton { none, left, middle, right };

/// Keys that are no letters; letters and digits are their upper-case character.
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

/// What sizes a disk, a brush or a part with the wheel, in every keymap: without it the wheel
/// zooms.
inline constexpr Modifiers kSizes{.control = true};

/// What a person did to the window. Positions in pixels from the upper left corner.
struct InputEvent {
  InputKind kind = InputKind::move;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  MouseButton button = MouseButton::none;
  Modifiers modifiers;
  int key = 0;          ///< of key events, when pressed
  char32_t text = 0;    ///< of text events
  double scroll = 0.0;  ///< of scroll events: away from the person is positive
};

}  // namespace lapwing::viewer
