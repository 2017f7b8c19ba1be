#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/temporary_folder.h"
#include "ui/viewer_app.h"
#include "viewer_panels/screen_reader.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"

namespace lapwing::viewer::test {

/// What the desktop and the person say of how the viewer looks.
struct Look {
  Theme theme = Theme::dark;
  VkExtent2D size{1280, 800};  ///< in pixels
  double scale = 1.0;          ///< the desktop's
};

/// The whole viewer without a window: frames are laid out and drawn as the main loop does it, and
/// whoever looks reads their texts. Files are in a folder of its own.
class ShownViewer {
 public:
  explicit ShownViewer(std::shared_ptr<gpu::Context> context, const Look& look = {});
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

  /// Presses a key over the picture.
  void key(int key, const Modifiers& modifiers = {});
  /// Types a character over the picture.
  void type(char32_t character);
  /// Clicks on the text of a panel, which must be there.
  void click(const std::string& words);
  void point_at(const std::string& words);
  /// Drags over the picture, in pixels.
  void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  ViewerApp& app() { return app_; }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  void lay_out();
  std::string all_texts() const;  ///< a line for each
  void place_mouse(const ImVec2& at);

  TemporaryFolder folder_;
  Look look_;
  std::shared_ptr<gpu::Context> context_;
  OffscreenScreen screen_;
  FramePainter painter_;
  ViewerApp app_;
  FrameTimings timings_;
  std::vector<ShownText> texts_;
};

}  // namespace lapwing::viewer::test
