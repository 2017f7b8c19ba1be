#pragma once

#include <filesystem>
#include <memory>

#include "lapwing/render/render_image.h"
#include "ui/file_controller.h"
#include "ui/turntable_recording.h"
#include "ui/viewport.h"

namespace lapwing::viewer {

/// Saves images and turntables of the 3D view. Asks for their sizes and shows the progress.
class Recorder {
 public:
  Recorder(const std::unique_ptr<Document>& document, const std::shared_ptr<gpu::Context>& context,
           const Viewport& viewport, const DisplayChoices& display, FileDialogs& dialogs,
           FileController& files, Say say);

  /// Open the dialogs for the sizes, which start with the size of the window.
  void plan_picture() { picture_plan_ = window_picture(); }
  void plan_turntable() { turntable_plan_.picture = window_picture(); }
  void close_plans() { picture_plan_.open = turntable_plan_.picture.open = false; }
  bool asks() const { return picture_plan_.open || turntable_plan_.picture.open; }
  void draw_plans();
  /// Uses a path that was chosen for an image or a turntable. Returns false for other purposes.
  bool use(const ChosenPath& chosen);
  /// Throws the errors of `render_image` and `write_png`.
  void save_picture(const std::filesystem::path& path, VkExtent2D size) const;

  bool is_recording() const { return recording_ != nullptr; }
  /// Renders the next image of a turntable. Call this once per frame.
  void update();
  void draw_progress();
  /// Stops the recording and reports how many frames were saved.
  void give_up(const std::string& why);

 private:
  PicturePlan window_picture() const;
  /// Returns the options for rendering the current view into an image of `size` pixels.
  RenderOptions render_options(VkExtent2D size) const;
  void save_planned(const std::filesystem::path& path);
  void begin_turntable(const std::filesystem::path& path);

  const std::unique_ptr<Document>& document_;
  const std::shared_ptr<gpu::Context>& context_;
  const Viewport& viewport_;
  const DisplayChoices& display_;
  FileDialogs& dialogs_;
  FileController& files_;
  Say say_;
  PicturePlan picture_plan_;
  TurntablePlan turntable_plan_;
  std::unique_ptr<TurntableRecording> recording_;
};

}  // namespace lapwing::viewer
