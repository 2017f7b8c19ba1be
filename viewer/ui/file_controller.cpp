#include "ui/file_controller.h"

#include <cstdio>
#include <utility>

#include "editing/kernels_like.h"
#include "files/path_text.h"
#include "lapwing/base/errors.h"
#include "ui/panels.h"
#include "window/window.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

std::string and_carried(const AppState& state) {
  const std::size_t count = state.carried.size();
  if (count == 0) return {};
  return " and " + std::to_string(count) + (count == 1 ? " attached object" : " attached objects");
}

}  // namespace

FileController::FileController(std::unique_ptr<Document>& document,
                               const std::shared_ptr<gpu::Context>& context, fs::path journals,
                               FileDialogs& dialogs, Messages& messages, Say say,
                               std::function<void(bool is_restored)> opened)
    : document_(document),
      context_(context),
      journals_(std::move(journals)),
      dialogs_(dialogs),
      messages_(messages),
      say_(std::move(say)),
      opened_(std::move(opened)),
      loader_(kernels_like(context), &Window::wake) {}

void FileController::use_device() {
  loader_.use_kernels(kernels_like(context_));
}

void FileController::offer_interrupted() {
  interrupted_ = find_interrupted(journals_);
  // An empty edit has nothing to restore.
  std::erase_if(interrupted_, [](const InterruptedEdit& edit) {
    if (edit.is_empty()) discard(edit);
    return edit.is_empty();
  });
}

void FileController::open(const fs::path& file, const std::vector<fs::path>& carry,
                          std::optional<PathPurpose> asked_for) {
  // A file dropped on the window answers the dialog.
  if (dialogs_.asks_for_path(PathPurpose::open)) dialogs_.close();
  leave_for([this, file, carry, asked_for] {
    load({file, asked_for}, [file, carry](Kernels& kernels, const Progress& progress) {
      return load_file(file, carry, kernels, progress);
    });
  });
}

void FileController::load(Loading what, Load load) {
  show_start_ = false;
  start_trouble_.clear();
  loading_ = std::move(what);
  load_again_ = load;
  loader_.start(
      [load = std::move(load)](const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
        return load(*kernels, progress);
      });
}

void FileController::take_loaded() {
  if (failure_) std::rethrow_exception(failure_);
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
      if (!is_restored && !rethrows_) dialogs_.recent().add(loading_.file);
    }
  } catch (const Error& error) {
    if (can_load_again && dynamic_cast<const GpuError*>(&error) != nullptr) {
      // Load again, for the device that the main loop opens next.
      load(loading_, load_again_);
      load_again_ = {};
      throw;
    }
    if (rethrows_) {
      failure_ = std::current_exception();
      throw;
    }
    if (loading_.asked_for) {
      dialogs_.ask_again(*loading_.asked_for, loading_.file, error.what());
    } else {
      document_ ? say_(Message(error)) : messages_.record(Message(error));
      start_trouble_ = in_window_words(error.what());
    }
  }
  show_start_ = !document_;
}

void FileController::show(LoadedFile file) {
  const bool is_restored = file.restored.has_value();
  // Two meshes at once may not fit on the device.
  if (document_) document_->editor.session().close();
  document_.reset();
  saving_ = nullptr;
  document_ = std::make_unique<Document>(
      std::move(file), journals_, context_,
      [this](Message message) { dialogs_.hear(std::move(message)); }, &Window::wake);
  show_start_ = false;
  opened_(is_restored);
}

void FileController::go_on_with(LoadedFile replay) {
  if (!document_) return;
  Editor& editor = document_->editor;
  if (editor.session().history().done() != *replay.replayed_from || editor.tool().is_dragging()) {
    return say_({"The mesh was edited during the replay. Replay the recipe again.", Tone::error});
  }
  editor.actions().continue_with(std::move(replay.history));
}

void FileController::leave_for(std::function<void()> action) {
  if (document_ && document_->editor.session().history().unsaved()) {
    leaving_for_ = std::move(action);
  } else {
    action();
  }
}

void FileController::once_settled(std::function<void()> action) {
  EditSession& session = document_->editor.session();
  if (!needs_settling(session.state())) return action();
  // Cancelled settling must start again, because a step is saved only when it is complete.
  if (!session.awaits_result()) session.prepare();
  saving_ = std::move(action);
  say_("The last move is being refined. Saving starts when that is done.");
}

// Warns if running the saved recipe gives a different surface.
void FileController::take_recipe_check() {
  constexpr double kSameSurface = 1e-3;
  if (!document_) return;
  try {
    const std::optional<double> apart = document_->editor.session().take_recipe_check();
    if (!apart || *apart <= kSameSurface) return;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "Running the recipe gives a surface that differs from this one by up to %.1f%% of "
        "the mesh's size. Save the mesh as well to keep this surface.",
        100.0 * *apart);
    say_({text, Tone::warning});
  } catch (const Error& error) {
    say_(
        {std::string("The recipe is saved, but running it fails: ") + error.what(), Tone::warning});
  }
}

void FileController::take_settled() {
  take_recipe_check();
  if (!saving_) return;
  const EditSession* session = document_ ? &document_->editor.session() : nullptr;
  if (session != nullptr && session->awaits_result()) return;
  const auto action = std::exchange(saving_, nullptr);
  if (session == nullptr) return;
  if (!needs_settling(session->state())) return action();
  say_(
      {"Not saved: the last move is not refined. Click \"Refine\" or undo the move, then save "
       "again.",
       Tone::error});
}

void FileController::save() {
  if (!document_) return;
  if (document_->save_path.empty()) return dialogs_.ask_for(PathPurpose::save_mesh);
  save_to(document_->save_path);
}

void FileController::save_to(const fs::path& path, std::function<void()> then) {
  once_settled([this, path, then = std::move(then)] {
    try {
      say(document_->editor.session().save(path));
      document_->save_path = path;
      document_->set_title(path.filename().string());
      dialogs_.recent().add(path);
      say_("Saved " + with_tilde(path) + and_carried(document_->editor.state()));
      if (then) then();
    } catch (const Error& error) {
      // The user who wanted to leave is asked again once the mesh has a path.
      leaving_for_ = then;
      dialogs_.ask_again(PathPurpose::save_mesh, path, error.what());
    }
  });
}

void FileController::save_carried() {
  once_settled([this] {
    const fs::path beside =
        document_->save_path.empty() ? edited_path(document_->opened) : document_->save_path;
    try {
      say(document_->editor.session().save_carried(beside));
      for (const auto& file : carried_of(document_->editor.state())) {
        say_("Saved " + with_tilde(file->target(beside)));
      }
    } catch (const Error& error) {
      say_(Message(error));
    }
  });
}

void FileController::save_recipe(const fs::path& path) {
  once_settled([this, path] {
    try {
      const fs::path copy = document_->editor.session().save_recipe(path);
      dialogs_.recent().add(path);
      say_("Saved " + with_tilde(path));
      if (!copy.empty()) {
        say_(document_->opened.name + " now holds the result, so the recipe starts from " +
             copy.string() + ", a copy of the original.");
      }
    } catch (const Error& error) {
      dialogs_.ask_again(PathPurpose::save_recipe, path, error.what());
    }
  });
}

void FileController::say(const WriteReport& report) const {
  for (const std::string& lost : report.not_carried) say_({"Not saved: " + lost, Tone::warning});
  for (const std::string& note : report.notes) say_(note);
}

void FileController::use(const ChosenPath& chosen) {
  const fs::path& path = chosen.path;
  switch (chosen.purpose) {
    case PathPurpose::open:
      open(path, {}, PathPurpose::open);
      break;
    case PathPurpose::save_mesh:
      dialogs_.write_to(path,
                        [this, path] { save_to(path, std::exchange(leaving_for_, nullptr)); });
      break;
    case PathPurpose::save_recipe:
      dialogs_.write_to(path, [this, path] { save_recipe(path); });
      break;
    case PathPurpose::replay_recipe:
      load({path, PathPurpose::replay_recipe},
           [path, history = document_->editor.session().history()](Kernels& kernels,
                                                                   const Progress& progress) {
             return load_replay(path, history, kernels, progress);
           });
      break;
    case PathPurpose::open_source:
      document_->desk.use_source(document_->desk.current(), path);
      break;
    case PathPurpose::open_scan:
      document_->wrap.open_scan(document_->editor, path);
      break;
    case PathPurpose::load_landmarks:
      template_landmarks_ = path;
      // A file of 3D Slicer contains the points of only one mesh.
      if (path.string().ends_with(".fcsv") || path.string().ends_with(".mrk.json")) {
        return dialogs_.ask_for(PathPurpose::load_scan_landmarks);
      }
      document_->wrap.load_landmarks(path);
      break;
    case PathPurpose::load_scan_landmarks:
      document_->wrap.load_landmarks(template_landmarks_, path);
      break;
    case PathPurpose::save_landmarks:
      dialogs_.write_to(path, [this, path] { document_->wrap.save_landmarks(path); });
      break;
    case PathPurpose::carry_file:
      document_->editor.actions().carry_along({path});
      break;
    case PathPurpose::parts_folder:
      document_->transplant.library().open(path);
      break;
    case PathPurpose::use_part:
      document_->transplant.take_part(path);
      break;
    case PathPurpose::add_part:
      document_->transplant.library().add(path);
      break;
    case PathPurpose::save_repaired:
      dialogs_.write_to(path, [this, path] { save_repaired(path); });
      break;
    case PathPurpose::save_picture:
    case PathPurpose::save_turntable:
      break;  // Recorder::use
  }
}

void FileController::save_repaired(const fs::path& path) {
  const auto mesh = document_ ? document_->banner.repair() : nullptr;
  if (mesh == nullptr)
    return say_({"The repair is no longer available. Repair the mesh again.", Tone::error});
  try {
    say(write_mesh(*mesh, path));
    say_("Saved " + with_tilde(path));
    open(path, {});
  } catch (const Error& error) {
    dialogs_.ask_again(PathPurpose::save_repaired, path, error.what());
  }
}

bool FileController::append_status(std::string& text) const {
  const WorkStatus loading = loader_.status();
  if (!loading.busy) return false;
  text.append("Opening ").append(loading_.file.filename().string());
  if (!loading.stage.empty()) text.append(": ").append(stage_in_words(loading.stage));
  text.append(" (Escape cancels)");
  return true;
}

void FileController::cancel() {
  leaving_for_ = nullptr;
  interrupted_.clear();
  show_start_ = !document_;
  loader_.cancel();
}

void FileController::draw_interrupted() {
  using What = InterruptedChoice::What;
  const auto choice = draw_interrupted_panel(interrupted_);
  if (!choice) return;
  if (choice->what == What::later) return interrupted_.clear();
  const InterruptedEdit edit = interrupted_[choice->edit];
  interrupted_.erase(interrupted_.begin() + static_cast<std::ptrdiff_t>(choice->edit));
  if (choice->what == What::discard) return discard(edit);
  interrupted_.clear();
  leave_for([this, edit] {
    load({edit.opened}, [edit](Kernels& kernels, const Progress& progress) {
      return load_interrupted(edit, kernels, progress);
    });
  });
}

void FileController::draw_unsaved() {
  if (!leaving_for_ || dialogs_.asks()) return;
  const auto choice = draw_unsaved_panel(document_->opened.name);
  if (!choice) return;
  if (*choice == UnsavedChoice::save && document_->save_path.empty()) {
    return dialogs_.ask_for(PathPurpose::save_mesh);
  }
  const auto action = std::exchange(leaving_for_, nullptr);
  if (*choice == UnsavedChoice::save) return save_to(document_->save_path, action);
  if (*choice == UnsavedChoice::discard) action();
}

void FileController::draw_start() {
  if (!interrupted_.empty()) return draw_interrupted();
  if (!show_start_ || dialogs_.asks_for_path() || is_loading()) return;
  const auto choice =
      draw_start_panel({dialogs_.samples(), dialogs_.recent().items(), start_trouble_},
                       document_ ? &show_start_ : nullptr);
  if (!choice) return;
  if (const auto* path = std::get_if<std::filesystem::path>(&*choice)) {
    open(*path);
  } else if (const auto* shape = std::get_if<const NamedShape*>(&*choice)) {
    leave_for([this, shape = *shape] { show(load_shape(*shape)); });
  } else {
    dialogs_.ask_for(PathPurpose::open);
  }
}

}  // namespace lapwing::viewer
