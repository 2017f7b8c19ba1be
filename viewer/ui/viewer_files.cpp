// Reading and writing files, and asking the user for paths.

#include <algorithm>
#include <cstdio>
#include <utility>

#include "files/path_text.h"
#include "lapwing/base/errors.h"
#include "ui/viewer_app.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// Returns a path beside the opened mesh that does not overwrite it.
fs::path path_beside(const OpenedMesh& opened, const char* ending) {
  if (!opened.file) return opened.name + ".ply";
  const fs::path& path = opened.file->path;
  return path.parent_path() / (path.stem().string() + ending + path.extension().string());
}

fs::path edited_path(const OpenedMesh& opened) {
  return path_beside(opened, "-edited");
}

std::string and_carried(const AppState& state) {
  const std::size_t count = state.carried.size();
  if (count == 0) return {};
  return " and " + std::to_string(count) + (count == 1 ? " attached object" : " attached objects");
}

}  // namespace

std::string ViewerApp::suggested_name(PathPurpose purpose) const {
  switch (purpose) {
    case PathPurpose::save_mesh:
      return (document_->save_path.empty() ? edited_path(document_->opened) : document_->save_path)
          .filename();
    case PathPurpose::save_recipe:
      return edited_path(document_->opened).replace_extension(".json").filename();
    case PathPurpose::save_repaired:
      return path_beside(document_->opened, "-repaired").filename();
    case PathPurpose::save_picture:
      return edited_path(document_->opened).stem().string() + ".png";
    case PathPurpose::save_turntable:
      return path_beside(document_->opened, "-turntable").stem().string() +
             (can_write_videos() ? ".mp4" : ".png");
    default:
      return {};
  }
}

// Returns the first folder that exists: that of the open mesh, or where a file was last chosen, or
// the working folder.
fs::path ViewerApp::folder_to_ask_in(PathPurpose purpose) const {
  std::error_code error;
  std::vector<fs::path> folders;
  if (document_) {
    if (purpose == PathPurpose::parts_folder)
      folders.push_back(document_->transplant.library().folder());
    if (purpose == PathPurpose::save_mesh) folders.push_back(document_->save_path.parent_path());
    if (document_->opened.file) folders.push_back(document_->opened.file->path.parent_path());
  }
  folders.push_back(last_folder_);
  folders.push_back(fs::current_path(error));
  for (const fs::path& folder : folders) {
    if (fs::is_directory(folder, error)) return fs::absolute(folder).lexically_normal();
  }
  return "/";
}

std::vector<BrowserPlace> ViewerApp::places(PathPurpose purpose) const {
  std::vector<BrowserPlace> places;
  const auto add = [&](const char* label, const fs::path& wanted) {
    std::error_code error;
    if (wanted.empty() || !fs::is_directory(wanted, error)) return;
    const fs::path folder = fs::absolute(wanted).lexically_normal();
    const auto is_same = [&](const BrowserPlace& place) { return place.path == folder; };
    if (std::none_of(places.begin(), places.end(), is_same)) places.push_back({label, folder});
  };
  add("Home", home_folder());
  if (document_ && document_->opened.file) {
    add("Open mesh", document_->opened.file->path.parent_path());
  }
  if (!samples_.empty()) add("Samples", samples_.front().parent_path());
  if (document_) add("Parts", document_->transplant.library().folder());
  add("Computer", "/");
  if (purpose != PathPurpose::open) return places;
  for (const RecentFiles::Item& item : recent_.items()) {
    if (item.is_there) places.push_back({item.path.filename(), item.path, true});
  }
  return places;
}

void ViewerApp::ask_for_path(PathPurpose purpose) {
  if (!document_ && purpose != PathPurpose::open) return;
  recent_.reload();
  chooser_.uses_system_dialog = preferences_.uses_system_dialogs;
  chooser_.ask({purpose, folder_to_ask_in(purpose), suggested_name(purpose), places(purpose)});
}

void ViewerApp::once_settled(std::function<void()> action) {
  EditSession& session = document_->editor.session();
  if (!needs_settling(session.state())) return action();
  // Settling that was cancelled begins again, because half of a step is never saved.
  if (!session.awaits_result()) session.prepare();
  saving_ = std::move(action);
  say("The last move is being refined. The mesh will be saved when that is done.");
}

// Warns if running the saved recipe makes another surface.
void ViewerApp::take_recipe_check() {
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
    say({text, Tone::warning});
  } catch (const Error& error) {
    say({std::string("The recipe is saved, but running it fails: ") + error.what(), Tone::warning});
  }
}

void ViewerApp::take_settled() {
  if (!saving_) return;
  const EditSession* session = document_ ? &document_->editor.session() : nullptr;
  if (session != nullptr && session->awaits_result()) return;
  const auto action = std::exchange(saving_, nullptr);
  if (session == nullptr) return;
  if (!needs_settling(session->state())) return action();
  say({"Not saved: the last move is not refined. Click \"Refine\" or undo it, then save again.",
       Tone::error});
}

void ViewerApp::save_to(const fs::path& path, std::function<void()> then) {
  once_settled([this, path, then = std::move(then)] {
    try {
      say(document_->editor.session().save(path));
      document_->save_path = path;
      document_->set_title(path.filename().string());
      recent_.add(path);
      say("Saved " + path.string() + and_carried(document_->editor.state()));
      if (then) then();
    } catch (const Error& error) {
      // The user who wanted to leave is asked again once the mesh has a path.
      leaving_for_ = then;
      ask_again(PathPurpose::save_mesh, path, error.what());
    }
  });
}

void ViewerApp::save_carried() {
  once_settled([this] {
    const fs::path beside =
        document_->save_path.empty() ? edited_path(document_->opened) : document_->save_path;
    try {
      say(document_->editor.session().save_carried(beside));
      for (const auto& file : carried_of(document_->editor.state())) {
        say("Saved " + file->target(beside).string());
      }
    } catch (const Error& error) {
      say(Message(error));
    }
  });
}

void ViewerApp::save_recipe(const fs::path& path) {
  once_settled([this, path] {
    try {
      const fs::path copy = document_->editor.session().save_recipe(path);
      recent_.add(path);
      say("Saved " + path.string());
      if (!copy.empty()) {
        say(document_->opened.name + " now holds the result, so the recipe starts from " +
            copy.string() + ", a copy of the original.");
      }
    } catch (const Error& error) {
      ask_again(PathPurpose::save_recipe, path, error.what());
    }
  });
}

void ViewerApp::ask_again(PathPurpose purpose, const fs::path& path, std::string trouble) {
  trouble = in_window_words(std::move(trouble));
  // Another request is open by now.
  if (chooser_.is_open()) return say({std::move(trouble), Tone::error});
  // The dialog shows the message while it matters, so it needs no toast.
  messages_.record({trouble, Tone::error});
  if (chooser_.purpose() == purpose && chooser_.chosen() == path) {
    return chooser_.ask_again(std::move(trouble));
  }
  const fs::path whole = fs::absolute(path).lexically_normal();
  chooser_.ask_again({purpose, whole.parent_path(), whole.filename(), places(purpose)},
                     std::move(trouble));
}

void ViewerApp::say(const WriteReport& report) {
  for (const std::string& lost : report.not_carried) say({"Not saved: " + lost, Tone::warning});
  for (const std::string& note : report.notes) say(note);
}

void ViewerApp::write_to(const fs::path& file, std::function<void()> write,
                         std::function<void()> otherwise) {
  std::error_code none;
  if (!fs::exists(file, none)) return write();
  overwriting_ = {file, std::move(write), std::move(otherwise)};
}

void ViewerApp::answer_overwriting(bool writes) {
  const Overwriting asked = *std::exchange(overwriting_, std::nullopt);
  const auto& action = writes ? asked.write : asked.otherwise;
  if (action) action();
}

void ViewerApp::use_path(const ChosenPath& chosen) {
  const fs::path& path = chosen.path;
  last_folder_ = path.parent_path();
  chosen_ = chosen;
  const auto ask = [this] { chooser_.ask_again({}); };
  const auto write_by = [&](void (ViewerApp::*save)(const fs::path&)) {
    const auto write = [this, path, save] { (this->*save)(path); };
    write_to(path, write, ask);
  };
  switch (chosen.purpose) {
    case PathPurpose::open:
      open(path, {}, PathPurpose::open);
      break;
    case PathPurpose::save_mesh:
      write_to(
          path, [this, path] { save_to(path, std::exchange(leaving_for_, nullptr)); }, ask);
      break;
    case PathPurpose::save_recipe:
      write_by(&ViewerApp::save_recipe);
      break;
    case PathPurpose::save_picture:
      write_by(&ViewerApp::save_chosen_picture);
      break;
    case PathPurpose::save_turntable: {
      const fs::path first = is_video(path) ? path : frame_file(path, 1, turntable_plan_.count);
      const auto save = [this, path] { once_settled([this, path] { save_turntable(path); }); };
      write_to(first, save, ask);
      break;
    }
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
      write_by(&ViewerApp::save_repaired);
      break;
  }
}

void ViewerApp::hear(Message message) {
  // A message about a file that cannot be read begins with its path.
  const bool is_of_chosen = chosen_ && message.text.starts_with(chosen_->path.string());
  if (!is_of_chosen) return say(std::move(message));
  const ChosenPath chosen = *std::exchange(chosen_, std::nullopt);
  ask_again(chosen.purpose, chosen.path, std::move(message.text));
}

void ViewerApp::save_repaired(const fs::path& path) {
  const auto mesh = document_ ? document_->banner.repair() : nullptr;
  if (mesh == nullptr)
    return say({"The repair is not shown any more. Repair the mesh again.", Tone::error});
  try {
    say(write_mesh(*mesh, path));
    say("Saved " + path.string());
    open(path, {});
  } catch (const Error& error) {
    ask_again(PathPurpose::save_repaired, path, error.what());
  }
}

}  // namespace lapwing::viewer
