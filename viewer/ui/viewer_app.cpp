#include "ui/viewer_app.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <utility>

#include "editing/editor_actions.h"
#include "window/window.h"

namespace lapwing::viewer {
namespace {

constexpr auto kAskedPaths = std::to_array<std::pair<Action, PathPurpose>>(
    {{Action::open, PathPurpose::open},
     {Action::save_as, PathPurpose::save_mesh},
     {Action::save_recipe, PathPurpose::save_recipe},
     {Action::replay_recipe, PathPurpose::replay_recipe},
     {Action::begin_wrap, PathPurpose::open_scan},
     {Action::carry_file, PathPurpose::carry_file}});

}  // namespace

ViewerApp::ViewerApp(std::shared_ptr<gpu::Context> context, KeptFiles kept)
    : context_(std::move(context)),
      preferences_file_(std::move(kept.preferences)),
      dialogs_(document_, preferences_, kept.recent, messages_, toasts()),
      files_(document_, context_, std::move(kept.journals), dialogs_, messages_, toasts(),
             [this](bool is_restored) { begin(is_restored); }),
      viewport_(document_, preferences_, display_),
      recorder_(document_, context_, viewport_, display_, dialogs_, files_, toasts()),
      sidebar_(document_, viewport_, preferences_, display_) {
  if (preferences_file_.empty()) return;
  ReadPreferences read = read_preferences(preferences_file_);
  preferences_ = kept_preferences_ = std::move(read.preferences);
  for (std::string& trouble : read.troubles) say({std::move(trouble), Tone::warning});
}

void ViewerApp::order(PictureOrder picture) {
  order_ = std::move(picture);
  files_.rethrow_errors();
}

void ViewerApp::use_device(std::shared_ptr<gpu::Context> context) {
  recorder_.give_up("The graphics device stopped responding");
  sidebar_.release_device();
  if (document_) {
    document_->mesh_steps.release_device();
    document_->wrap.release_device();
    document_->transplant.release_device();
    document_->desk.release_device();
    document_->editor.release_device();
  }
  context_ = std::move(context);
  files_.use_device();
  if (document_) {
    document_->editor.use_device(context_);
    document_->desk.use_device(context_);
    document_->wrap.use_device(context_);
    document_->mesh_steps.use_device(context_);
    document_->transplant.use_device(context_);
  }
  say("The graphics device failed. The viewer now uses " + context_->description().name + ".");
}

// Shows a document that was just opened.
void ViewerApp::begin(bool is_restored) {
  recorder_.give_up("Another mesh was opened");
  take_preferred_tools(is_restored);
  frames_shown_ = 0;
  messages_.close_all();
  sidebar_.begin();
  viewport_.begin();
  say_of_colors();
}

// Only one note shows at a time. The log has all.
void ViewerApp::say_of_colors() {
  if (!document_->opened.colors) return;
  const std::vector<std::string>& notes = document_->opened.colors->colors.notes;
  for (std::size_t n = 1; n < notes.size(); ++n) messages_.record(notes[n]);
  if (notes.empty()) return;
  say(notes.size() == 1
          ? notes[0]
          : notes[0] + " (" + std::to_string(notes.size() - 1) + " more in Help > Messages)");
}

void ViewerApp::take_preferred_tools(bool is_restored) {
  Editor& editor = document_->editor;
  editor.view().set_feature_angle(display_.feature_angle);
  editor.drag().set_wants_to_settle(preferences_.settles_while_dragging);
  editor.tool().tools().grab.set_radius_pt(preferences_.grab_radius_pt);
  editor.tool().tools().paint.options().radius_pt = preferences_.brush_radius_pt;
  // Continue an open edit with its gizmo, unless a crash interrupted the Grab tool.
  const bool goes_on_with_grab = is_restored && preferences_.tool == "Grab";
  if (editor.tool().row() == nullptr) return;
  if (editor.tool().row()->action == Action::take_move && !goes_on_with_grab) return;
  for (const ToolRow& row : tool_rows()) {
    if (row.name == preferences_.tool && chooses(row)) editor.tool().take(row);
  }
}

void ViewerApp::ask_to_close() {
  files_.leave_for([this] {
    if (document_) document_->editor.session().close();
    quit_ = true;
  });
}

void ViewerApp::say(Message message) {
  messages_.say(std::move(message), now());
}

std::string_view ViewerApp::title() const {
  if (!document_) return "Lapwing";
  return document_->editor.session().history().unsaved() ? document_->unsaved_title
                                                         : document_->title;
}

void ViewerApp::resize(const Eigen::Vector2d& size, double pixels_per_point) {
  viewport_.resize(size, pixels_per_point);
  preferences_.window_width = static_cast<int>(std::lround(size.x() / pixels_per_point));
  preferences_.window_height = static_cast<int>(std::lround(size.y() / pixels_per_point));
}

// Whether a dialog waits for an answer. Then it gets the keys.
bool ViewerApp::asks() const {
  return files_.asks() || dialogs_.asks() || recorder_.asks() || recorder_.is_recording();
}

// Whether a list or menu is open, which Escape closes before it reaches the tool.
bool ViewerApp::is_covered() const {
  return show_controls_ || files_.is_start_over_document() ||
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool ViewerApp::handle(const InputEvent& event) {
  if (event.kind != InputKind::move) messages_.acted(now());
  const bool escapes = event.kind == InputKind::key && event.key == kEscape;
  if (recorder_.is_recording()) {
    // The scene must not change while it is being saved.
    if (escapes) escape();
    return true;
  }
  if (asks() && !is_of_pointer(event)) {
    escapes ? escape() : dialogs_.take(event);
    return true;
  }
  if (escapes && is_covered()) {
    escape();
    return true;
  }
  const auto changed = viewport_.handle(event);
  if (document_) document_->wrap.take_points(document_->editor);
  if (changed) return *changed;
  if (escapes) {
    if (cancel_layers()) return true;
    escape();
  }
  if (const auto action = action_of(event)) perform(*action);
  return true;
}

// Ends the first of these that is in progress: picking or painting for a coat, mix or wrap, its
// computation, or the coat, mix or wrap. Returns false if none is, or if Escape must first close
// something in front of it.
bool ViewerApp::cancel_layers() {
  const bool is_behind =
      viewport_.shows_vertices() || show_machine_ || show_messages_ || files_.is_loading();
  if (!document_ || is_behind) return false;
  if (document_->wrap.is_open()) {
    document_->wrap.cancel(document_->editor);
  } else if (document_->desk.is_open()) {
    document_->desk.cancel(document_->editor);
  } else {
    return false;
  }
  return true;
}

void ViewerApp::escape() {
  if (recorder_.is_recording()) return recorder_.give_up("Cancelled");
  if (dialogs_.asks_to_overwrite()) {
    dialogs_.close();
    return;
  }
  if (viewport_.shows_vertices()) viewport_.look_back();
  show_controls_ = false;
  show_machine_ = false;
  show_messages_ = false;
  recorder_.close_plans();
  // Close one thing at a time, so that the panel from which the chooser was opened shows again.
  if (dialogs_.close()) return;
  if (document_ && document_->mesh_steps.is_open()) {
    return document_->mesh_steps.close(document_->editor);
  }
  files_.cancel();
}

void ViewerApp::perform(Action action) {
  if (document_ && perform_on(document_->wrap, document_->editor, action)) return;
  if (document_ && perform_on(document_->editor, action)) return;
  if (document_ && perform_on(document_->desk, document_->editor, action)) return;
  if (viewport_.perform(action)) return;
  for (const auto& [own, purpose] : kAskedPaths) {
    if (own == action) return dialogs_.ask_for(purpose);
  }
  switch (action) {
    case Action::toggle_wireframe:
      display_.style.wireframe = !display_.style.wireframe;
      display_.style.xray = false;
      return;
    case Action::toggle_xray:
      display_.style.xray = !display_.style.xray;
      return;
    case Action::toggle_flat:
      display_.style.flat = !display_.style.flat;
      return;
    case Action::toggle_controls:
      show_controls_ = !show_controls_;
      return;
    case Action::take_part:
      if (document_) document_->transplant.take_next_part();
      return;
    case Action::take_up_part:
      if (document_) document_->transplant.take_up_last(document_->editor);
      return;
    case Action::save:
      return files_.save();
    case Action::open_source:
      if (document_ && document_->desk.is_open()) dialogs_.ask_for(PathPurpose::open_source);
      return;
    case Action::save_carried:
      if (document_) files_.save_carried();
      return;
    case Action::save_picture:
      return recorder_.plan_picture();
    case Action::save_turntable:
      return recorder_.plan_turntable();
    case Action::quit:
      return ask_to_close();
    default:
      return;  // an action of the editor, but no mesh is open
  }
}

}  // namespace lapwing::viewer
