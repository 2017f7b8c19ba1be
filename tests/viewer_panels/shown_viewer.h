#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/temporary_folder.h"
#include "ui/viewer_app.h"
#include "viewer_panels/screen_reader.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"
#include "window/panel_input.h"

namespace lapwing::viewer::test {

inline constexpr Modifiers kControl{.control = true};
inline constexpr Modifiers kControlShift{.shift = true, .control = true};

/// Adds a finger to the parts of the viewer whose data folder is `folder`/data.
void add_finger(const std::filesystem::path& folder, int sides = 24, int rings = 12);

/// What the desktop and the person say of how the viewer looks.
struct Look {
  Theme theme = Theme::dark;
  VkExtent2D size{1280, 800};  ///< in pixels
  double scale = 1.0;          ///< the desktop's
};

/// The whole viewer without a window: frames are laid out and drawn as the main loop does it, and
/// whoever looks reads their texts. Files are in `folder`, or else in one of its own.
class ShownViewer {
 public:
  explicit ShownViewer(std::shared_ptr<gpu::Context> context, const Look& look = {},
                       std::filesystem::path folder = {});
  ~ShownViewer();
  ShownViewer(const ShownViewer&) = delete;
  ShownViewer& operator=(const ShownViewer&) = delete;

  /// Lays out frames until one is like the one before.
  const std::vector<ShownText>& look_at();
  /// Lays out frames until `happened`; fails the test after a minute.
  void wait_for(const std::function<bool()>& happened, const std::string& what);
  /// Opens a mesh and waits until it is on the screen.
  void open(const std::filesystem::path& mesh);

  /// Of the frame laid out last.
  const std::vector<ShownText>& texts() const { return texts_; }
  bool shows(const std::string& words) const { return find_text(texts_, words).has_value(); }
  /// Whether some text holds `words`.
  bool says(const std::string& words) const;
  Image picture();

  /// Hands on what a person did as a window does it: to the panels, and to the picture unless they
  /// take it. A key is let go at once. Then draws a frame.
  void send(const InputEvent& event);

  /// Presses a key while the cursor is over the viewport.
  void key(int key, const Modifiers& modifiers = {});
  /// Types a character while the cursor is over the viewport.
  void type(char32_t character);
  /// Clicks on the text of a panel, which must be there.
  void click(const std::string& words);
  void point_at(const std::string& words);
  /// Scrolls the task panel until it shows the words. In a small window, the panel is low.
  void scroll_to(const std::string& words);
  /// Drags the mouse in the viewport. Positions are in pixels.
  void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  ViewerApp& app() { return app_; }
  const std::filesystem::path& folder() const { return folder_; }
  const Look& look() const { return look_; }

 private:
  void lay_out();
  /// Finely once nothing moves any more.
  void draw(bool at_rest);
  void press_and_release(const InputEvent& event);
  std::string all_texts() const;  ///< a line for each
  void place_mouse(const ImVec2& at);

  std::optional<TemporaryFolder> own_folder_;
  std::filesystem::path folder_;
  Look look_;
  std::shared_ptr<gpu::Context> context_;
  OffscreenScreen screen_;
  FramePainter painter_;
  ViewerApp app_;
  FrameTimings timings_;
  std::vector<ShownText> texts_;
  PictureInput picture_;
};

}  // namespace lapwing::viewer::test
