#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "ui/recorder.h"
#include "ui/sidebar.h"
#include "window/app.h"

namespace lapwing::viewer {

/// Requests an image that is saved after the first frame with the mesh. The program then exits. Its
/// exit code reports whether the image was saved.
struct PictureOrder {
  std::filesystem::path path;
  std::optional<VkExtent2D> size;  ///< the window's by default
};

/// The paths of the files that the viewer keeps between runs. An empty path disables a file.
struct KeptFiles {
  std::filesystem::path journals;  ///< a folder
  std::filesystem::path preferences;
  std::filesystem::path recent;
};

/// Runs the viewer. Owns the open document and the parts of the window. Decides which part receives
/// a key or an action, and in which order the parts draw a frame. viewer_menus draws the menu bar,
/// and viewer_frame draws the rest of a frame.
class ViewerApp final : public App {
 public:
  ViewerApp(std::shared_ptr<gpu::Context> context, KeptFiles kept);

  void order(PictureOrder picture);
  /// Returns the open document; null if there is none.
  const Document* document() const { return document_.get(); }
  /// Returns whether the desktop's dialog or the browser is open.
  bool asks_for_path() const { return dialogs_.asks_for_path(); }
  /// Offers to restore edits that a crash interrupted.
  void offer_interrupted() { files_.offer_interrupted(); }

  bool handle(const InputEvent& event) override;
  void open(const std::filesystem::path& file) override { files_.open(file); }
  /// The files in `carry` follow the surface from the first edit in the viewer on.
  void open(const std::filesystem::path& file, const std::vector<std::filesystem::path>& carry) {
    files_.open(file, carry);
  }
  void resize(const Eigen::Vector2d& size, double pixels_per_point) override;
  void draw_ui(const FrameTimings& last) override;
  Scene scene() override { return viewport_.scene(); }
  std::string_view title() const override;
  Theme theme() const override { return preferences_.theme; }
  void ask_to_close() override;
  bool wants_to_quit() const override { return quit_; }
  void use_device(std::shared_ptr<gpu::Context> context) override;

 private:
  void begin(bool is_restored);
  void take_preferred_tools(bool is_restored);
  void say_of_colors();
  /// Shows a message in a toast and adds it to the log.
  void say(Message message);
  Say toasts() {
    return [this](Message message) { say(std::move(message)); };
  }
  double now() const { return 1e-3 * started_.elapsed_ms(); }

  void perform(Action action);
  void escape();
  bool cancel_layers();
  bool asks() const;
  bool is_covered() const;

  void draw_menu();
  void draw_file_menu();
  void draw_recent_menu();
  void draw_edit_menu();
  void draw_view_menu();

  void update_document();
  void carry_out_order();
  void draw_sidebar();
  void draw_over_picture();
  /// Draws the banner at the top of the picture, which goes from `corner` to `end`. Returns its
  /// height.
  double draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end);
  void draw_dialogs();
  void draw_status();
  const std::string& status_text();
  void keep_preferences();

  std::shared_ptr<gpu::Context> context_;
  std::filesystem::path preferences_file_;
  Preferences preferences_;
  Preferences kept_preferences_;  ///< as in the file
  DisplayChoices display_;
  Stopwatch started_;
  Messages messages_;
  std::unique_ptr<Document> document_;
  FileDialogs dialogs_;
  FileController files_;
  Viewport viewport_;
  Recorder recorder_;
  Sidebar sidebar_;
  bool show_controls_ = false;
  bool show_machine_ = false;
  bool show_messages_ = false;
  /// In this order: whether a coat or mix, a transplant, and a wrap were open in the last frame.
  std::array<bool, 3> was_open_{};
  std::string status_line_;   ///< reused from frame to frame
  std::string state_line_;
  std::optional<PictureOrder> order_;
  int frames_shown_ = 0;  ///< of the document
  bool quit_ = false;
};

}  // namespace lapwing::viewer
