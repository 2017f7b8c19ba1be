#pragma once

#include "tools/input.h"

namespace lapwing::viewer {

/// Whether what a person does is for the picture, by how the panels were laid out last. To be asked
/// of everything that happens, in its order.
class PictureInput {
 public:
  /// `cursor` in screen units; `button` of presses and releases.
  bool gets(InputKind kind, MouseButton button, const Eigen::Vector2d& cursor);

  /// The button that was pressed over the picture and is still down.
  MouseButton dragging() const { return dragging_; }

 private:
  bool gets_press(MouseButton button, const Eigen::Vector2d& cursor);
  bool gets_release(MouseButton button);

  MouseButton dragging_ = MouseButton::none;
  bool types_into_panel_ = false;  // the key pressed last
};

}  // namespace lapwing::viewer
