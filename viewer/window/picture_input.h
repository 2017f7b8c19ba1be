#pragma once

#include "tools/input.h"

namespace lapwing::viewer {

/// Decides which events are for the picture, by the last layout of the panels. Call `gets` for
/// every event, in order.
class PictureInput {
 public:
  /// Whether the picture gets an event. `cursor` is in screen units, `button` for presses and
  /// releases.
  bool gets(InputKind kind, MouseButton button, const Eigen::Vector2d& cursor);

  /// The button that was pressed over the picture and is still down.
  MouseButton dragging() const { return dragging_; }

 private:
  bool gets_press(MouseButton button, const Eigen::Vector2d& cursor);
  bool gets_release(MouseButton button);

  MouseButton dragging_ = MouseButton::none;
  bool types_into_panel_ = false;  // the last key did
};

}  // namespace lapwing::viewer
