#include "window/picture_input.h"

#include "window/panel_input.h"

namespace lapwing::viewer {

bool PictureInput::gets(InputKind kind, MouseButton button, const Eigen::Vector2d& cursor) {
  switch (kind) {
    case InputKind::move:
      return true;
    case InputKind::press:
      return gets_press(button, cursor);
    case InputKind::release:
      return gets_release(button);
    case InputKind::scroll:
      return !PanelInput::want_mouse(cursor);
    case InputKind::key:
      // The text of a key goes where the key went, even if that opened a field.
      types_into_panel_ = PanelInput::want_keys();
      return !types_into_panel_;
    case InputKind::text:
      return !types_into_panel_;
  }
  return false;
}

bool PictureInput::gets_press(MouseButton button, const Eigen::Vector2d& cursor) {
  if (dragging_ != MouseButton::none || PanelInput::want_mouse(cursor)) return false;
  dragging_ = button;
  return true;
}

bool PictureInput::gets_release(MouseButton button) {
  if (dragging_ != button) return false;
  dragging_ = MouseButton::none;
  return true;
}

}  // namespace lapwing::viewer
