// Saving a turntable: its dialog, and the pictures that are drawn meanwhile.

#include <imgui.h>
#include <utility>

#include "lapwing/base/errors.h"
#include "ui/viewer_app.h"

namespace lapwing::viewer {

void ViewerApp::draw_turntable() {
  if (chooser_.is_open()) return;
  if (draw_turntable_panel(turntable_plan_)) ask_for_path(PathPurpose::save_turntable);
}

void ViewerApp::save_turntable(const std::filesystem::path& path) {
  if (document_ == nullptr) return;
  const int count = turntable_plan_.count;
  const Editor& editor = document_->editor;
  const RenderOptions options =
      picture_options({static_cast<std::uint32_t>(turntable_plan_.picture.width),
                       static_cast<std::uint32_t>(turntable_plan_.picture.height)});
  Framing framing;
  framing.field_of_view = camera_.field_of_view;
  framing.orthographic = camera_.orthographic;
  if (options.style.color == SurfaceColor::scalar) {
    framing.legend = legend_share(options.width, options.height);
  }
  Positions points = editor.positions();
  editor.carried().append_positions(points);
  const Eigen::Matrix4d view = camera_.view();
  const ViewAxes axes{view.block<1, 3>(2, 0).transpose(), view.block<1, 3>(1, 0).transpose()};
  try {
    const Turntable way(points, axes, up_axis_, options.aspect(), framing);
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
    recording_->go_on(editor.surface().shown(), editor.surface().paint(), editor.carried().drawn());
    if (!recording_->is_done()) return;
    const auto done = std::exchange(recording_, nullptr);
    const TurntableRecording::Order& order = done->order();
    say("saved " + (is_video(order.output)
                        ? order.output.string()
                        : frame_file(order.output, 1, order.count).string() + " and on"));
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
  say({why + (written == 0 ? ": no turntable was saved"
                           : ": of the turntable the first " + std::to_string(written) +
                                 " pictures were saved"),
       Tone::warning});
}

}  // namespace lapwing::viewer
