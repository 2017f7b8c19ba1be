#pragma once

#include <array>
#include <cstddef>

#include "tools/input.h"
#include "window/frame_input.h"

struct GLFWwindow;

namespace lapwing::viewer {

/// Passes events to the panels in order. Each frame processes only events that the panels can
/// distinguish (FrameInput). ImGui's GLFW backend for this window must outlive it.
class PanelInput {
 public:
  explicit PanelInput(GLFWwindow* window) : window_(window) {}

  /// Returns whether `hand_on(event)` may be called before the panels are laid out again.
  bool fits(const DesktopEvent& event) const { return frame_.fits(event); }
  void hand_on(const DesktopEvent& event);
  /// Begins a frame with the state of the mouse at the last event of `hand_on`. ImGui's backend
  /// would use the current state of the mouse, which belongs to a later event.
  void new_frame();
  /// Call this after `ImGui::Render`.
  void laid_out();
  /// Returns whether the keyboard focus changes in the next two frames, because a dialog has opened
  /// or a text field is being activated.
  bool focus_is_pending() const;

  /// Returns whether `cursor`, in screen units, is over a panel of the last layout.
  static bool is_over_panel(const Eigen::Vector2d& cursor);
  /// Returns whether the panels process the mouse: if the cursor is over a panel, or if a menu is
  /// open, because a click beside the menu closes it.
  static bool want_mouse(const Eigen::Vector2d& cursor);
  /// Returns whether a text field of the panels has the keyboard focus.
  static bool want_keys();

 private:
  static constexpr std::size_t kButtons = 5;  // the number of mouse buttons in ImGui

  GLFWwindow* window_;
  FrameInput frame_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool is_inside_ = false;  // whether the cursor is in the window
  std::array<bool, kButtons> down_{};
  int popups_ = 0;  // number of open popups before the last frame
  bool popups_changed_ = false;
};

/// Decides which events are for the view under the panels, according to the last layout of the
/// panels. Call `gets` for every event, in order.
class PictureInput {
 public:
  /// Returns whether an event is for the view. `cursor` is in screen units. `button` is used only
  /// for presses and releases.
  bool gets(InputKind kind, MouseButton button, const Eigen::Vector2d& cursor);

  /// Returns the button that was pressed over the view and is still down, or `none`.
  MouseButton dragging() const { return dragging_; }

 private:
  bool gets_press(MouseButton button, const Eigen::Vector2d& cursor);
  bool gets_release(MouseButton button);

  MouseButton dragging_ = MouseButton::none;
  bool types_into_panel_ = false;  // whether the last key event was for a text field
};

}  // namespace lapwing::viewer
