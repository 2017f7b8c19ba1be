#include "ui/recorder.h"

#include <utility>

#include "files/path_text.h"
#include "lapwing/base/errors.h"
#include "navigation/camera_motion.h"
#include "window/window.h"

namespace lapwing::viewer {

Recorder::Recorder(const std::unique_ptr<Document>& document,
                   const std::shared_ptr<gpu::Context>& context, const Viewport& viewport,
                   const DisplayChoices& display, FileDialogs& dialogs, FileController& files,
                   Say say)
    : document_(document),
      context_(context),
      viewport_(viewport),
      display_(display),
      dialogs_(dialogs),
      files_(files),
      say_(std::move(say)) {}

// Returns a plan for an image of the window's size.
PicturePlan Recorder::window_picture() const {
  return {document_ != nullptr, static_cast<int>(viewport_.camera().size().x()),
          static_cast<int>(viewport_.camera().size().y())};
}

RenderOptions Recorder::render_options(VkExtent2D size) const {
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.background = display_.background;
  options.style = viewport_.style();
  // Scale the line widths with the image size, so that they look the same as in the window.
  options.style.pixels_per_point =
      static_cast<float>(viewport_.camera().pixels_per_point() * static_cast<double>(size.height) /
                         viewport_.camera().size().y());
  if (options.style.color == SurfaceColor::scalar) {
    options.legend_title = document_->editor.view().shown().has_numbers()
                               ? kScanDistance
                               : legend_title(*measure_of(display_.coloring));
  }
  return options;
}

void Recorder::save_picture(const std::filesystem::path& path, VkExtent2D size) const {
  const SurfaceView& view = document_->editor.view();
  Camera camera = viewport_.frame().camera;
  // No panel covers a part of this image.
  camera.target_across = 0.0;
  RenderOptions options = render_options(size);
  options.grid = viewport_.grid();
  write_png(path, render_image(view.device().shown(), view.device().paint(), camera, options,
                               view.carried().drawn()));
}

void Recorder::draw_plans() {
  const auto is_shown = [this](const PicturePlan& plan) {
    return plan.open && document_ && !dialogs_.asks();
  };
  if (is_shown(picture_plan_) && draw_picture_panel(picture_plan_)) {
    dialogs_.ask_for(PathPurpose::save_picture);
  }
  if (is_shown(turntable_plan_.picture) && draw_turntable_panel(turntable_plan_)) {
    dialogs_.ask_for(PathPurpose::save_turntable);
  }
}

bool Recorder::use(const ChosenPath& chosen) {
  const std::filesystem::path& path = chosen.path;
  if (chosen.purpose == PathPurpose::save_picture) {
    dialogs_.write_to(path, [this, path] { save_planned(path); });
    return true;
  }
  if (chosen.purpose != PathPurpose::save_turntable) return false;
  const auto first = is_video(path) ? path : frame_file(path, 1, turntable_plan_.count);
  dialogs_.write_to(first,
                    [this, path] { files_.once_settled([this, path] { begin_turntable(path); }); });
  return true;
}

void Recorder::save_planned(const std::filesystem::path& path) {
  const VkExtent2D size{static_cast<std::uint32_t>(picture_plan_.width),
                        static_cast<std::uint32_t>(picture_plan_.height)};
  try {
    save_picture(path, size);
    say_("Saved " + with_tilde(path));
  } catch (const Error& error) {
    dialogs_.ask_again(PathPurpose::save_picture, path, error.what());
  }
}

void Recorder::begin_turntable(const std::filesystem::path& path) {
  if (document_ == nullptr) return;
  const int count = turntable_plan_.count;
  const SurfaceView& view = document_->editor.view();
  const RenderOptions options =
      render_options({static_cast<std::uint32_t>(turntable_plan_.picture.width),
                      static_cast<std::uint32_t>(turntable_plan_.picture.height)});
  const Camera& camera = viewport_.camera().camera();
  Framing framing{.field_of_view = camera.field_of_view, .orthographic = camera.orthographic};
  if (options.style.color == SurfaceColor::scalar) {
    framing.legend = legend_share(options.width, options.height);
  }
  Positions points = view.positions();
  view.carried().append_positions(points);
  try {
    const Turntable way(points, axes_of(camera), viewport_.camera().up_axis(), options.aspect(),
                        framing);
    recording_ = std::make_unique<TurntableRecording>(
        TurntableRecording::Order{path, count, turntable_plan_.per_second}, way, *context_, options,
        &Window::wake);
  } catch (const Error& error) {
    dialogs_.ask_again(PathPurpose::save_turntable, path, error.what());
  }
}

void Recorder::update() {
  if (!recording_) return;
  if (!document_) return give_up("Another mesh was opened");
  const SurfaceView& view = document_->editor.view();
  try {
    recording_->go_on(view.device().shown(), view.device().paint(), view.carried().drawn());
    if (!recording_->is_done()) return;
    const auto done = std::exchange(recording_, nullptr);
    const TurntableRecording::Order& order = done->order();
    say_("Saved " + (is_video(order.output) ? with_tilde(order.output)
                                            : with_tilde(frame_file(order.output, 1, order.count)) +
                                                  " and the images after it"));
  } catch (const Error& error) {
    const auto failed = std::exchange(recording_, nullptr);
    dialogs_.ask_again(PathPurpose::save_turntable, failed->order().output, error.what());
  }
}

// Stops the recording and reports how many frames were saved.
void Recorder::give_up(const std::string& why) {
  if (!recording_) return;
  const auto given_up = std::exchange(recording_, nullptr);
  const TurntableRecording::Order& order = given_up->order();
  const int written = is_video(order.output) ? 0 : given_up->written();
  say_({why + (written == 0   ? ": the turntable was not saved."
               : written == 1 ? ": only the first frame of the turntable was saved."
                              : ": only the first " + std::to_string(written) +
                                    " frames of the turntable were saved."),
        Tone::warning});
}

void Recorder::draw_progress() {
  if (draw_turntable_progress(recording_.get())) give_up("Cancelled");
}

}  // namespace lapwing::viewer
