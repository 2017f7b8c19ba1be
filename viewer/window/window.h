#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

#include "tools/input.h"

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

  /// What happened since the last call, oldest first; input that the panels want is left out.
  /// Until the next call.
  std::span<const InputEvent> take_events();
  std::vector<std::filesystem::path> take_dropped_files();
  /// The panels have been laid out: keys that were let go since they were pressed are up for the
  /// next one.
  void panels_have_seen_keys();
  /// Whether anything happened since the last call that may change the panels.
  bool take_changed();

  /// Whether the person wanted the window closed since the last call.
  bool take_close_request();
  /// In pixels; 0 while minimized.
  VkExtent2D pixels() const;
  /// Pixels per unit of a desktop at 96 dots an inch: what texts are to be enlarged by.
  double content_scale() const;
  void set_title(const std::string& title);

 private:
  friend struct WindowCallbacks;

  /// As GLFW says it.
  struct KeyRelease {
    int key;
    int scancode;
    int modifiers;
  };

  GLFWwindow* handle_ = nullptr;
  std::vector<InputEvent> events_;
  std::vector<InputEvent> taken_;
  std::vector<std::filesystem::path> dropped_;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();  ///< in screen units
  MouseButton dragging_ = MouseButton::none;          ///< pressed over the picture
  std::vector<int> pressed_since_frame_;              ///< GLFW's keys
  std::vector<KeyRelease> late_releases_;
  bool changed_ = true;
};

}  // namespace lapwing::viewer
