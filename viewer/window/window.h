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

/// Thrown if no window can be opened, for example without a display.
class WindowError : public Error {
 public:
  using Error::Error;
};

/// A GLFW window and its input. At most one may exist at a time. Use it only on the main thread.
class Window {
 public:
  /// Sizes are in screen units. Throws WindowError with GLFW's message if there is no display.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Returns the instance extensions that `create_surface` needs. Throws GpuError if Vulkan cannot
  /// draw on this desktop.
  std::vector<const char*> instance_extensions() const;
  /// Creates a surface, which the caller must destroy. Throws GpuError.
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// Installs a handler that ends the program immediately if the connection to the display is lost.
  /// The handler prints a message to standard error and exits with `code`. A normal shutdown would
  /// wait for the lost display.
  static void exit_when_display_goes(int code);

  /// Waits for an event, at most `seconds`.
  void wait(double seconds);
  /// Adds pending events to the queue without waiting.
  void poll();
  /// Ends `wait`, so that another frame is drawn. May be called from any thread.
  static void wake();

  /// Returns whether the queue contains an event.
  bool has_input() const { return handed_on_ < waiting_.size(); }
  /// Removes the oldest event from the queue and passes it to the panels. Returns the event if it
  /// is also for the view, according to the last layout of the panels. If
  /// `panels().fits(next_input())` is false, lay the panels out first.
  std::optional<InputEvent> hand_on();
  const DesktopEvent& next_input() const { return waiting_[handed_on_]; }
  PanelInput& panels() { return *panels_; }
  std::vector<std::filesystem::path> take_dropped_files();
  /// Returns whether an event since the last call may have changed the panels.
  bool take_changed();

  /// Returns whether the user has asked to close the window since the last call.
  bool take_close_request();
  /// Returns the size in pixels. It is 0 while the window is minimized.
  VkExtent2D pixels() const;
  /// Returns the number of pixels per point (Projection), which scales panels and marks.
  double content_scale() const;
  void set_title(const std::string& title);

 private:
  friend struct WindowCallbacks;

  std::optional<InputEvent> input_event(const DesktopEvent& event) const;
  Eigen::Vector2d in_pixels(const Eigen::Vector2d& cursor) const;

  GLFWwindow* handle_ = nullptr;
  std::unique_ptr<PanelInput> panels_;
  std::vector<DesktopEvent> waiting_;
  std::size_t handed_on_ = 0;  ///< number of events at the front of waiting_ that were removed
  std::vector<std::filesystem::path> dropped_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();  ///< latest position, in screen units
  int buttons_down_ = 0;                              ///< number of pressed mouse buttons
  PictureInput picture_;
  bool was_over_panel_ = false;  ///< whether the cursor was over a panel at the last event
  bool changed_ = true;
};

}  // namespace lapwing::viewer
