#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <volk.h>

#include "tools/input.h"
#include "window/panel_input.h"
#include "window/picture_input.h"

struct GLFWwindow;

namespace lapwing::viewer {

/// A window of the desktop, by GLFW, and what a person does to it. One at a time, on the main
/// thread.
class Window {
 public:
  /// Throws WindowError, with GLFW's reason, when there is no display. Sizes in screen units.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// The instance extensions that `create_surface` needs. Throws GpuError when the Vulkan loader
  /// knows no way to this desktop.
  std::vector<const char*> instance_extensions() const;
  /// The caller's to destroy. Throws GpuError.
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// From now on, a display that goes away (its server ends, its connection breaks) ends the
  /// program at once, with `code` and a word on standard error. Nothing is put down in order then:
  /// what draws waits for the display, too.
  static void exit_when_display_goes(int code);

  /// Waits for something to happen, at most `seconds`.
  void wait(double seconds);
  /// Takes what has happened without waiting.
  void poll();
  /// Wakes `wait` for another frame. May be called from any thread.
  static void wake();

  /// Whether something that happened is yet to be handed on.
  bool has_input() const { return handed_on_ < waiting_.size(); }
  /// Of that the oldest, to the panels; returned if it is (also) for the picture. As the panels
  /// were laid out last: first they are to be laid out again where it does not fit
  /// (`panels().fits(next_input())`).
  std::optional<InputEvent> hand_on();
  const DesktopEvent& next_input() const { return waiting_[handed_on_]; }
  PanelInput& panels() { return *panels_; }
  std::vector<std::filesystem::path> take_dropped_files();
  /// Whether anything was handed on or happened since the last call that may change the panels.
  bool take_changed();

  /// Whether the person wanted the window closed since the last call.
  bool take_close_request();
  /// In pixels; 0 while minimized.
  VkExtent2D pixels() const;
  /// Pixels of a point (Projection's): what is to be seen and touched is enlarged by it.
  double content_scale() const;
  void set_title(const std::string& title);

 private:
  friend struct WindowCallbacks;

  std::optional<InputEvent> input_event(const DesktopEvent& event) const;
  Eigen::Vector2d in_pixels(const Eigen::Vector2d& cursor) const;

  GLFWwindow* handle_ = nullptr;
  std::unique_ptr<PanelInput> panels_;
  std::vector<DesktopEvent> waiting_;
  std::size_t handed_on_ = 0;  ///< of those that wait
  std::vector<std::filesystem::path> dropped_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();  ///< in screen units, by now
  int buttons_down_ = 0;                              ///< by now
  PictureInput picture_;
  bool was_over_panel_ = false;  ///< the cursor
  bool changed_ = true;
};

}  // namespace lapwing::viewer
