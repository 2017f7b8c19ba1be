#pragma once

#include <array>
#include <cstddef>

#include "window/desktop_event.h"
#include "window/frame_input.h"

struct GLFWwindow;

namespace lapwing::viewer {

/// Tells the panels what happened, in its order: as much before each frame as they can tell apart.
/// ImGui's GLFW backend for this window must be there as long as this.
class PanelInput {
 public:
  explicit PanelInput(GLFWwindow* window) : window_(window) {}

  /// Whether `event` may be handed on before the panels are laid out again (FrameInput).
  bool fits(const DesktopEvent& event) const { return frame_.fits(event); }
  void hand_on(const DesktopEvent& event);
  /// In place of the backend's: what it asks of the desktop is how that is by now, not how it was
  /// at the event that was handed on last.
  void new_frame();
  /// The panels are laid out: `ImGui::Render` was called.
  void laid_out();
  /// Whether who gets the keys is not said before the next frame or the one after: a dialog has
  /// opened, or a field is about to be typed into.
  bool focus_is_on_its_way() const;

  /// As the panels were laid out last. `cursor` in screen units.
  static bool is_over_panel(const Eigen::Vector2d& cursor);
  /// Over a panel, or a menu is open: a click beside that closes it.
  static bool want_mouse(const Eigen::Vector2d& cursor);
  /// Keys that type go into a field of theirs.
  static bool want_keys();

 private:
  static constexpr std::size_t kButtons = 5;  // ImGui's

  GLFWwindow* window_;
  FrameInput frame_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool is_inside_ = false;  // the cursor, the window
  std::array<bool, kButtons> down_{};
  int popups_ = 0;  // open before the last frame
  bool popups_changed_ = false;
};

}  // namespace lapwing::viewer
