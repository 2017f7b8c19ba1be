#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <volk.h>

#include "lapwing/base/errors.h"
#include "tools/input.h"
#include "window/panel_input.h"

struct GLFWwindow;

namespace lapwing::viewer {

/// No window can be opened: there is no display, or it refuses.
class WindowError : public Error {
 public:
  using Error::Error;
};

/// A window of the desktop, by GLFW, and its input. One at a time, on the main thread.
class Window {
 public:
  /// Sizes are in screen units. Throws WindowError, with GLFW's reason, if there is no display.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Returns the instance extensions that `create_surface` needs. Throws GpuError if Vulkan cannot
  /// draw on this desktop.
  std::vector<const char*> instance_extensions() const;
  /// Creates a surface, which the caller must destroy. Throws GpuError.
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// Installs a handler that ends the program at once if the connection to the display is lost. It
  /// prints a message to standard error and exits with `code`. A normal shutdown would wait for the
  /// lost display.
  static void exit_when_display_goes(int code);

  /// Waits for an event, at most `seconds`.
  void wait(double seconds);
  /// Takes pending events without waiting.
  void poll();
  /// Wakes `wait` for another frame. May be called from any thread.
  static void wake();

  /// Whether an event waits to be handed on.
  bool has_input() const { return handed_on_ < waiting_.size(); }
  /// Hands the oldest event to the panels. Returns it if it is (also) for the picture, by the last
  /// layout. If it does not fit, lay the panels out first (`panels().fits(next_input())`).
  std::optional<InputEvent> hand_on();
  const DesktopEvent& next_input() const { return waiting_[handed_on_]; }
  PanelInput& panels() { return *panels_; }
  std::vector<std::filesystem::path> take_dropped_files();
  /// Whether anything since the last call may change the panels.
  bool take_changed();

  /// Whether the user asked to close the window since the last call.
  bool take_close_request();
  /// Returns the size in pixels; 0 while minimized.
  VkExtent2D pixels() const;
  /// Returns the pixels per point (Projection), the scale of panels and marks.
  double content_scale() const;
  void set_title(const std::string& title);

 private:
  friend struct WindowCallbacks;

  std::optional<InputEvent> input_event(const DesktopEvent& event) const;
  Eigen::Vector2d in_pixels(const Eigen::Vector2d& cursor) const;

  GLFWwindow* handle_ = nullptr;
  std::unique_ptr<PanelInput> panels_;
  std::vector<DesktopEvent> waiting_;
  std::size_t handed_on_ = 0;  ///< number of waiting_ handed on
  std::vector<std::filesystem::path> dropped_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();  ///< latest, in screen units
  int buttons_down_ = 0;                              ///< now
  PictureInput picture_;
  bool was_over_panel_ = false;  ///< the cursor, at the last event
  bool changed_ = true;
};

}  // namespace lapwing::viewer
