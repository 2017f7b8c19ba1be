// Draws the dialogs for saving images and turntables. Renders the images and the frames of a
// recording.

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/render/render_image.h"
#include "navigation/camera_motion.h"
#include "ui/viewer_app.h"
#include "window/window.h"

namespace lapwing::viewer {

// Returns a plan for an image of the window's size.
PicturePlan ViewerApp::window_picture() const {
  return {document_ != nullptr, static_cast<int>(size_.x()), static_cast<int>(size_.y())};
}

RenderOptions ViewerApp::picture_options(VkExtent2D size) const {
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.background = display_.background;
  options.style = shown_style();
  // Scale the line widths with the image size, so that they look as in the window.
  options.style.pixels_per_point =
      static_cast<float>(pixels_per_point_ * static_cast<double>(size.height) / size_.y());
  if (options.style.color == SurfaceColor::scalar) {
    options.legend_title = legend_title(*measure_of(display_.coloring));
  }
  return options;
}

void ViewerApp::save_picture(const std::filesystem::path& path, VkExtent2D size) const {
  const Editor& editor = document_->editor;
  Camera camera = view_frame().camera;
  // No panel covers a part of this image.
  camera.target_across = 0.0;
  RenderOptions options = picture_options(size);
  options.grid = shown_grid();
  write_png(path, render_image(editor.view().device().shown(), editor.view().device().paint(),
                               camera, options, editor.view().carried().drawn()));
}

void ViewerApp::carry_out_order() {
  // The first frame has been shown when the second one is laid out.
  if (!order_ || !document_ || frames_shown_ < 1) return;
  const VkExtent2D window{static_cast<std::uint32_t>(size_.x()),
                          static_cast<std::uint32_t>(size_.y())};
  save_picture(order_->path, order_->size.value_or(window));
  document_->editor.session().close();
  quit_ = true;
}

void ViewerApp::save_chosen_picture(const std::filesystem::path& path) {
  const VkExtent2D size{static_cast<std::uint32_t>(picture_plan_.width),
                        static_cast<std::uint32_t>(picture_plan_.height)};
  try {
    save_picture(path, size);
    say("Saved " + path.string());
  } catch (const Error& error) {
    ask_again(PathPurpose::save_picture, path, error.what());
  }
}

void ViewerApp::save_turntable(const std::filesystem::path& path) {
  if (document_ == nullptr) return;
  const int count = turntable_plan_.count;
  const Editor& editor = document_->editor;
  const RenderOptions options =
      picture_options({static_cast<std::uint32_t>(turntable_plan_.picture.width),
                       static_cast<std::uint32_t>(turntable_plan_.picture.height)});
  Framing framing{.field_of_view = camera_.field_of_view, .orthographic = camera_.orthographic};
  if (options.style.color == SurfaceColor::scalar) {
    framing.legend = legend_share(options.width, options.height);
  }
  Positions points = editor.view().positions();
  editor.view().carried().append_positions(points);
  try {
    const Turntable way(points, axes_of(camera_), up_axis_, options.aspect(), framing);
    recording_ = std::make_unique<TurntableRecording>(
        TurntableRecording::Order{path, count, turntable_plan_.per_second}, way, *context_, options,
        &Window::wake);
  } catch (const Error& error) {
    ask_again(PathPurpose::save_turntable, path, error.what());
  }
}

void ViewerApp::record_turntable() {
  if (!recording_) return;
  const Editor& editor = document_->editor;
  try {
    recording_->go_on(editor.view().device().shown(), editor.view().device().paint(),
                      editor.view().carried().drawn());
    if (!recording_->is_done()) return;
    const auto done = std::exchange(recording_, nullptr);
    const TurntableRecording::Order& order = done->order();
    say("Saved " + (is_video(order.output) ? order.output.string()
                                           : frame_file(order.output, 1, order.count).string() +
                                                 " and the images after it"));
  } catch (const Error& error) {
    const auto failed = std::exchange(recording_, nullptr);
    ask_again(PathPurpose::save_turntable, failed->order().output, error.what());
  }
}

// Stops the recording and says how far it came.
void ViewerApp::give_up_turntable(const std::string& why) {
  if (!recording_) return;
  const auto given_up = std::exchange(recording_, nullptr);
  const TurntableRecording::Order& order = given_up->order();
  const int written = is_video(order.output) ? 0 : given_up->written();
  say({why + (written == 0 ? ": turntable not saved."
                           : ": only the first " + std::to_string(written) +
                                 " frames of the turntable were saved."),
       Tone::warning});
}

}  // namespace lapwing::viewer
