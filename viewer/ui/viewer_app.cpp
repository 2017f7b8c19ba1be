#include "ui/viewer_app.h"

#include <utility>

#include "editing/kernels_like.h"
#include "lapwing/base/errors.h"
#include "lapwing/render/render_image.h"
#include "window/window.h"
#include "work/window_words.h"

namespace lapwing::viewer {

ViewerApp::ViewerApp(std::shared_ptr<gpu::Context> context, KeptFiles kept)
    : context_(context),
      kept_(std::move(kept)),
      loader_(kernels_like(context), &Window::wake),
      chooser_(&Window::wake),
      recent_(kept_.recent),
      samples_(find_samples()) {
  if (kept_.preferences.empty()) return;
  ReadPreferences read = read_preferences(kept_.preferences);
  preferences_ = kept_preferences_ = std::move(read.preferences);
  for (std::string& trouble : read.troubles) say({std::move(trouble), Tone::warning});
}

void ViewerApp::offer_interrupted() {
  interrupted_ = find_interrupted(kept_.journals);
  // An empty edit has nothing to restore.
  std::erase_if(interrupted_, [](const InterruptedEdit& edit) {
    if (edit.is_empty()) discard(edit);
    return edit.is_empty();
  });
}

void ViewerApp::use_device(std::shared_ptr<gpu::Context> context) {
  give_up_turntable("The graphics device stopped responding");
  part_pictures_.release();
  if (document_) {
    document_->mesh_steps.release_device();
    document_->transplant.release_device();
    document_->desk.release_device();
    document_->editor.release_device();
  }
  loader_.use_kernels(kernels_like(context));
  context_ = std::move(context);
  if (document_) {
    document_->editor.use_device(context_);
    document_->desk.use_device(context_);
    document_->mesh_steps.use_device(context_);
    document_->transplant.use_device(context_);
  }
  say("The graphics device failed and was restarted: " + context_->description().name);
}

void ViewerApp::open(const std::filesystem::path& file,
                     const std::vector<std::filesystem::path>& carry,
                     std::optional<PathPurpose> asked_for) {
  // A file dropped on the window answers the dialog.
  if (chooser_.is_open() && chooser_.purpose() == PathPurpose::open) chooser_.close();
  leave_for([this, file, carry, asked_for] {
    load({file, asked_for}, [file, carry](Kernels& kernels, const Progress& progress) {
      return load_file(file, carry, kernels, progress);
    });
  });
}

void ViewerApp::load(Loading what, Load load) {
  show_start_ = false;
  start_trouble_.clear();
  loading_ = std::move(what);
  load_again_ = load;
  loader_.start(
      [load = std::move(load)](const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
        return load(*kernels, progress);
      });
}

void ViewerApp::take_loaded() {
  if (order_failure_) std::rethrow_exception(order_failure_);
  bool can_load_again = false;
  try {
    std::optional<LoadedFile> file = loader_.take();
    if (!file) return;
    if (file->replayed_from) {
      go_on_with(std::move(*file));
    } else {
      const bool is_restored = file->restored.has_value();
      can_load_again = !is_restored && load_again_ != nullptr;
      show(std::move(*file));
      if (!is_restored && !order_) recent_.add(loading_.file);
    }
  } catch (const Error& error) {
    if (can_load_again && dynamic_cast<const GpuError*>(&error) != nullptr) {
      // Load again, for the device that the main loop opens next.
      load(loading_, load_again_);
      load_again_ = {};
      throw;
    }
    if (order_) {
      order_failure_ = std::current_exception();
      throw;
    }
    if (loading_.asked_for) {
      ask_again(*loading_.asked_for, loading_.file, error.what());
    } else {
      document_ ? say(Message(error)) : messages_.record(Message(error));
      start_trouble_ = in_window_words(error.what());
    }
  }
  show_start_ = !document_;
}

void ViewerApp::show(LoadedFile file) {
  give_up_turntable("Another mesh was opened");
  // Two meshes at a time may not fit on the device.
  if (document_) document_->editor.session().close();
  document_.reset();
  slider_.reset();
  saving_ = nullptr;
  document_ = std::make_unique<Document>(
      std::move(file), kept_.journals, context_,
      [this](Message message) { hear(std::move(message)); }, &Window::wake);
  take_preferred_tools();
  up_axis_ = document_->opened.up_axis;
  frames_shown_ = 0;
  show_start_ = false;
  messages_.close_all();
  view_before_.reset();
  task_to_show_ = begun_task_ = Task::deform;
  look_from(View::three_quarter);
  frame_all();
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

void ViewerApp::take_preferred_tools() {
  Editor& editor = document_->editor;
  editor.input().set_gizmo_keys(gizmo_keys());
  editor.view().set_feature_angle(display_.feature_angle);
  editor.drag().set_wants_to_settle(preferences_.settles_while_dragging);
  editor.tool().tools().grab.set_radius_pt(preferences_.grab_radius_pt);
  editor.tool().tools().paint.options().radius_pt = preferences_.brush_radius_pt;
  // An edit that has begun goes on with its gizmo.
  if (editor.tool().row() == nullptr || editor.tool().row()->action == Action::take_move) return;
  for (const ToolRow& row : tool_rows()) {
    if (row.name == preferences_.tool && chooses(row)) editor.tool().take(row);
  }
}

void ViewerApp::go_on_with(LoadedFile replay) {
  if (!document_) return;
  Editor& editor = document_->editor;
  if (editor.session().history().done() != *replay.replayed_from || editor.tool().is_dragging()) {
    return say({"The mesh was edited while the recipe ran. Replay it again.", Tone::error});
  }
  editor.actions().continue_with(std::move(replay.history));
}

void ViewerApp::leave_for(std::function<void()> action) {
  if (document_ && document_->editor.session().history().unsaved()) {
    leaving_for_ = std::move(action);
  } else {
    action();
  }
}

void ViewerApp::ask_to_close() {
  leave_for([this] {
    if (document_) document_->editor.session().close();
    quit_ = true;
  });
}

double ViewerApp::now() const {
  return 1e-3 * started_.elapsed_ms();
}

void ViewerApp::say(Message message) {
  messages_.say(std::move(message), now());
}

std::string_view ViewerApp::title() const {
  if (!document_) return "Lapwing";
  return document_->editor.session().history().unsaved() ? document_->unsaved_title
                                                         : document_->title;
}

// Whether the eye is inside `bounds`.
bool ViewerApp::is_inside(const Bounds& bounds) const {
  return (bounds.min.array() <= camera_.eye.array()).all() &&
         (camera_.eye.array() <= bounds.max.array()).all();
}

SurfaceStyle ViewerApp::shown_style() const {
  SurfaceStyle style = style_of(display_, document_->editor);
  // The doctor marks its places in the colours of regions.
  if (document_->banner.marks()) style.color = SurfaceColor::regions;
  return style;
}

// The grid is placed under the mesh as it was opened, so that an edit does not move it.
std::optional<GroundGrid> ViewerApp::shown_grid() const {
  if (!display_.grid) return {};
  return ground_grid(document_->editor.view().shown().opened_bounds(), up_axis_);
}

Scene ViewerApp::scene() {
  Scene scene;
  scene.background = display_.background;
  if (!document_) return scene;
  Editor& editor = document_->editor;
  scene.surface = &editor.view().device().shown();
  scene.paint = &editor.view().device().paint();
  scene.carried = editor.view().carried().drawn();
  scene.camera = view_frame().camera;
  scene.grid = shown_grid();
  scene.style = shown_style();
  scene.style.pixels_per_point = static_cast<float>(pixels_per_point_);
  scene.moving = motion_.has_value() || on_slider_ || editor.tool().is_dragging();
  if (const auto line = slider_line()) {
    const EditSurface& opened = editor.view().shown().opened_on_device();
    LeftScene& left = scene.left.emplace();
    left.surface = &opened.shown();
    left.paint = &opened.paint();
    left.style = scene.style;
    // The opened mesh has no measured values.
    if (left.style.color == SurfaceColor::scalar) left.style.color = SurfaceColor::regions;
    left.width = *line;
  }
  const bool closed = document_->closed_outward && editor.view().shown().is_comparable();
  if (scene.moving && closed && !is_inside(editor.bounds())) {
    scene.style.sides = Sides::front;
  }
  if (const auto area = source_area()) {
    const SourceView& view = *document_->desk.view();
    SideScene& beside = scene.beside.emplace();
    beside.surface = &view.shown().device().shown();
    beside.paint = &view.shown().device().paint();
    beside.camera = view.view_frame().camera;
    beside.style = display_.style;
    beside.style.color = SurfaceColor::regions;
    beside.style.pixels_per_point = scene.style.pixels_per_point;
    beside.corner = area->corner;
    beside.size = area->size;
    scene.moving = scene.moving || view.holds_mouse();
  }
  return scene;
}

}  // namespace lapwing::viewer
