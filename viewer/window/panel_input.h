#pragma once

#include <array>
#include <cstddef>

#include "tools/input.h"
#include "window/frame_input.h"

struct GLFWwindow;

namespace lapwing::viewer {

/// Hands events to the panels in order, before each frame as many as they can tell apart. ImGui's
/// GLFW backend for this window must outlive it.
class PanelInput {
 public:
  explicit PanelInput(GLFWwindow* window) : window_(window) {}

  /// Whether `event` may be handed on before the panels are laid out again (FrameInput).
  bool fits(const DesktopEvent& event) const { return frame_.fits(event); }
  void hand_on(const DesktopEvent& event);
  /// Begins a frame with the mouse as it was at the last event handed on. The backend alone would
  /// take its current state.
  void new_frame();
  /// Call this after `ImGui::Render`.
  void laid_out();
  /// Whether the keyboard focus changes in the next two frames, because a dialog has opened or a
  /// field is about to be typed into.
  bool focus_is_pending() const;

  /// Whether `cursor`, in screen units, is over a panel of the last layout.
  static bool is_over_panel(const Eigen::Vector2d& cursor);
  /// Whether the panels take the mouse: it is over one, or a menu is open that a click beside it
  /// closes.
  static bool want_mouse(const Eigen::Vector2d& cursor);
  /// Whether typed keys go into a text field of the panels.
  static bool want_keys();

 private:
  static constexpr std::size_t kButtons = 5;  // as in ImGui

  GLFWwindow* window_;
  FrameInput frame_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool is_inside_ = false;  // the cursor is in the window
  std::array<bool, kButtons> down_{};
  int popups_ = 0;  // open before the last frame
  bool popups_changed_ = false;
};

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
