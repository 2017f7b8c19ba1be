#include "ui/viewer_app.h"

#include <utility>

#include "editing/kernels_like.h"
#include "lapwing/base/errors.h"
#include "lapwing/render/render_image.h"
#include "window/window.h"

namespace lapwing::viewer {

namespace {

// Beside the mesh that was opened, and not over it.
std::filesystem::path edited_path(const OpenedMesh& opened) {
  if (!opened.file) return opened.name + ".ply";
  const std::filesystem::path& path = opened.file->path;
  return path.parent_path() / (path.stem().string() + "-edited" + path.extension().string());
}

std::string and_carried(const AppState& state) {
  const std::size_t count = state.carried.size();
  if (count == 0) return {};
  return " and " + std::to_string(count) + (count == 1 ? " carried file" : " carried files");
}

}  // namespace

ViewerApp::ViewerApp(std::shared_ptr<gpu::Context> context, std::filesystem::path journals,
                     std::filesystem::path preferences)
    : context_(context),
      journals_(std::move(journals)),
      preferences_file_(std::move(preferences)),
      loader_(kernels_like(context), &Window::wake),
      samples_(find_samples()) {
  if (preferences_file_.empty()) return;
  ReadPreferences read = read_preferences(preferences_file_);
  preferences_ = kept_preferences_ = std::move(read.preferences);
  for (std::string& trouble : read.troubles) say({std::move(trouble), Tone::warning});
}

void ViewerApp::offer_interrupted() {
  interrupted_ = find_interrupted(journals_);
  // Nothing of these would come back.
  std::erase_if(interrupted_, [](const InterruptedEdit& edit) {
    if (edit.is_empty()) discard(edit);
    return edit.is_empty();
  });
}

void ViewerApp::use_device(std::shared_ptr<gpu::Context> context) {
  part_pictures_.release();
  if (document_) {
    document_->transplant.release_device();
    document_->desk.release_device();
    document_->editor.release_device();
  }
  loader_.use_kernels(kernels_like(context));
  context_ = std::move(context);
  if (document_) {
    document_->editor.use_device(context_);
    document_->desk.use_device(context_);
    document_->transplant.use_device(context_);
  }
  say("the device was lost and opened again: " + context_->description().name);
}

void ViewerApp::open(const std::filesystem::path& file,
                     const std::vector<std::filesystem::path>& carry) {
  leave_for([this, file, carry] {
    load(file.filename().string(), [file, carry](Kernels& kernels, const Progress& progress) {
      return load_file(file, carry, kernels, progress);
    });
  });
}

void ViewerApp::load(std::string name, Load load) {
  show_start_ = false;
  loading_ = std::move(name);
  loader_.start(
      [load = std::move(load)](const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
        return load(*kernels, progress);
      });
}

void ViewerApp::take_loaded() {
  try {
    std::optional<LoadedFile> file = loader_.take();
    if (!file) return;
    if (file->replayed_from) {
      go_on_with(std::move(*file));
    } else {
      show(std::move(*file));
    }
  } catch (const Error& error) {
    if (order_) throw;
    say(Message(error));
  }
  show_start_ = !document_;
}

void ViewerApp::show(LoadedFile file) {
  // Two meshes at a time may not fit on the device.
  if (document_) document_->editor.session().close();
  document_.reset();
  saving_ = nullptr;
  document_ = std::make_unique<Document>(
      std::move(file), journals_, context_, [this](Message message) { say(std::move(message)); },
      &Window::wake);
  take_preferred_tools();
  up_axis_ = document_->opened.up_axis;
  frames_shown_ = 0;
  show_start_ = false;
  messages_.close_all();
  view_before_.reset();
  task_to_show_ = begun_task_ = Task::deform;
  look_from(View::three_quarter);
  frame_all();
}

void ViewerApp::take_preferred_tools() {
  Editor& editor = document_->editor;
  editor.set_gizmo_keys(gizmo_keys());
  editor.set_settles_while_dragging(preferences_.settles_while_dragging);
  editor.paint_tool().options().radius = preferences_.brush_radius;
  editor.paint_tool().options().through = preferences_.paints_through;
  // An edit that was begun already goes on with its gizmo.
  if (editor.row() == nullptr || editor.row()->action == Action::take_move) return;
  for (const ToolRow& row : tool_rows()) {
    if (row.name == preferences_.tool && row.action != Action::take_move) editor.take(row);
  }
}

void ViewerApp::go_on_with(LoadedFile replay) {
  if (!document_) return;
  Editor& editor = document_->editor;
  if (editor.session().history().done() != *replay.replayed_from || editor.is_dragging()) {
    return say({"the mesh was edited while the recipe was replayed; replay it again", Tone::error});
  }
  editor.continue_with(std::move(replay.history));
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

void ViewerApp::ask_for_path(PathPurpose purpose) {
  path_plan_.purpose = purpose;
  const auto& path = document_->save_path;
  switch (purpose) {
    case PathPurpose::save_mesh:
      path_plan_.path = path.empty() ? edited_path(document_->opened).string() : path.string();
      break;
    case PathPurpose::save_recipe:
      path_plan_.path = edited_path(document_->opened).replace_extension(".json").string();
      break;
    case PathPurpose::replay_recipe:
    case PathPurpose::open_source:
    case PathPurpose::carry_file:
      path_plan_.path.clear();
      break;
  }
}

void ViewerApp::once_settled(std::function<void()> action) {
  EditSession& session = document_->editor.session();
  if (!needs_settling(session.state())) return action();
  // Settling that was given up begins again: half of a step is never saved.
  if (!session.awaits_result()) session.prepare();
  saving_ = std::move(action);
  say("the drag is settling; saved once it has");
}

void ViewerApp::take_settled() {
  if (!saving_) return;
  const EditSession* session = document_ ? &document_->editor.session() : nullptr;
  if (session != nullptr && session->awaits_result()) return;
  const auto action = std::exchange(saving_, nullptr);
  if (session == nullptr) return;
  if (!needs_settling(session->state())) return action();
  say({"not saved: the drag did not settle; settle or undo it, and save again", Tone::error});
}

void ViewerApp::save_to(const std::filesystem::path& path, std::function<void()> then) {
  once_settled([this, path, then = std::move(then)] {
    try {
      say(document_->editor.session().save(path));
      document_->save_path = path;
      say("saved " + path.string() + and_carried(document_->editor.state()));
      if (then) then();
    } catch (const Error& error) {
      say(Message(error));
    }
  });
}

void ViewerApp::save_carried() {
  once_settled([this] {
    const std::filesystem::path beside =
        document_->save_path.empty() ? edited_path(document_->opened) : document_->save_path;
    try {
      say(document_->editor.session().save_carried(beside));
      for (const auto& file : carried_of(document_->editor.state())) {
        say("saved " + file->target(beside).string());
      }
    } catch (const Error& error) {
      say(Message(error));
    }
  });
}

void ViewerApp::save_recipe(const std::filesystem::path& path) {
  once_settled([this, path] {
    try {
      document_->editor.session().save_recipe(path);
      say("saved " + path.string());
    } catch (const Error& error) {
      say(Message(error));
    }
  });
}

void ViewerApp::say(const WriteReport& report) {
  for (const std::string& lost : report.not_carried) say({"not saved: " + lost, Tone::warning});
  for (const std::string& note : report.notes) say(note);
}

void ViewerApp::write_to(const std::filesystem::path& file, std::function<void()> write,
                         std::function<void()> otherwise) {
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return write();
  overwriting_ = {file, std::move(write), std::move(otherwise)};
}

void ViewerApp::answer_overwriting(bool writes) {
  const Overwriting asked = *std::exchange(overwriting_, std::nullopt);
  const auto& action = writes ? asked.write : asked.otherwise;
  if (action) action();
}

// Of the path that a person has typed in.
void ViewerApp::use_path() {
  const std::filesystem::path path = path_plan_.path;
  EditSession& session = document_->editor.session();
  const PathPurpose purpose = *std::exchange(path_plan_.purpose, std::nullopt);
  const auto ask_again = [this, purpose] { path_plan_.purpose = purpose; };
  switch (purpose) {
    case PathPurpose::save_mesh:
      write_to(
          path, [this, path] { save_to(path, std::exchange(leaving_for_, nullptr)); }, ask_again);
      break;
    case PathPurpose::save_recipe:
      write_to(
          path, [this, path] { save_recipe(path); }, ask_again);
      break;
    case PathPurpose::replay_recipe:
      load(path.filename().string(),
           [path, history = session.history()](Kernels& kernels, const Progress& progress) {
             return load_replay(path, history, kernels, progress);
           });
      break;
    case PathPurpose::open_source:
      document_->desk.use_source(document_->desk.current(),
                                 std::filesystem::absolute(session.folder() / path));
      break;
    case PathPurpose::carry_file:
      document_->editor.carry_along({path});
  }
}

// Whether the eye is, give or take.
bool ViewerApp::is_inside(const Bounds& bounds) const {
  return (bounds.min.array() <= camera_.eye.array()).all() &&
         (camera_.eye.array() <= bounds.max.array()).all();
}

Scene ViewerApp::scene() {
  Scene scene;
  scene.background = display_.background;
  if (!document_) return scene;
  Editor& editor = document_->editor;
  scene.surface = &editor.surface().shown();
  scene.paint = &editor.surface().paint();
  scene.carried = editor.carried().drawn();
  scene.camera = view_frame().camera;
  scene.style = style_of(display_, editor);
  scene.moving = motion_.has_value() || editor.is_dragging();
  const bool closed = document_->closed_outward && editor.shown().is_comparable();
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
    beside.corner = area->corner;
    beside.size = area->size;
    scene.moving = scene.moving || view.is_moving();
  }
  return scene;
}

VkExtent2D ViewerApp::window_size() const {
  return {static_cast<std::uint32_t>(size_.x()), static_cast<std::uint32_t>(size_.y())};
}

void ViewerApp::save_picture(const std::filesystem::path& path, VkExtent2D size) const {
  const Editor& editor = document_->editor;
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.background = display_.background;
  options.style = style_of(display_, editor);
  if (options.style.color == SurfaceColor::scalar) {
    options.legend_title = legend_title(*measure_of(display_.coloring));
  }
  Camera camera = view_frame().camera;
  // Nothing covers a part of this picture.
  camera.target_across = 0.0;
  write_png(path, render_image(editor.surface().shown(), editor.surface().paint(), camera, options,
                               editor.carried().drawn()));
}

void ViewerApp::carry_out_order() {
  // The first frame has been shown when the second one is laid out.
  if (!order_ || !document_ || frames_shown_ < 1) return;
  save_picture(order_->path, order_->size.value_or(window_size()));
  document_->editor.session().close();
  quit_ = true;
}

}  // namespace lapwing::viewer
