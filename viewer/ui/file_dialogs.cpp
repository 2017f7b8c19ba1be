#include "ui/file_dialogs.h"

#include <algorithm>
#include <utility>

#include "files/path_text.h"
#include "ui/panels.h"
#include "window/window.h"
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

}  // namespace

fs::path edited_path(const OpenedMesh& opened) {
  return path_beside(opened, "-edited");
}

FileDialogs::FileDialogs(const std::unique_ptr<Document>& document, const Preferences& preferences,
                         const fs::path& recent, Messages& messages, Say say)
    : document_(document),
      preferences_(preferences),
      messages_(messages),
      say_(std::move(say)),
      chooser_(&Window::wake),
      recent_(recent),
      samples_(find_samples()) {}

std::string FileDialogs::suggested_name(PathPurpose purpose) const {
  switch (purpose) {
    case PathPurpose::save_mesh:
      return (document_->save_path.empty() ? edited_path(document_->opened) : document_->save_path)
          .filename();
    case PathPurpose::save_recipe:
      return edited_path(document_->opened).replace_extension(".json").filename();
    case PathPurpose::save_repaired:
      return path_beside(document_->opened, "-repaired").filename();
    case PathPurpose::save_landmarks:
      return path_beside(document_->opened, "-landmarks").stem().string() + ".csv";
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
fs::path FileDialogs::folder_to_ask_in(PathPurpose purpose) const {
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

std::vector<BrowserPlace> FileDialogs::places(PathPurpose purpose) const {
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
    add("Mesh folder", document_->opened.file->path.parent_path());
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

void FileDialogs::ask_for(PathPurpose purpose) {
  if (!document_ && purpose != PathPurpose::open) return;
  recent_.reload();
  chooser_.uses_system_dialog = preferences_.uses_system_dialogs;
  chooser_.ask({purpose, folder_to_ask_in(purpose), suggested_name(purpose), places(purpose)});
}

void FileDialogs::ask_again(PathPurpose purpose, const fs::path& path, std::string trouble) {
  trouble = in_window_words(std::move(trouble));
  // Another request is open by now.
  if (chooser_.is_open()) return say_({std::move(trouble), Tone::error});
  // The dialog shows the message while it matters, so it needs no toast.
  messages_.record({trouble, Tone::error});
  if (chooser_.purpose() == purpose && chooser_.chosen() == path) {
    return chooser_.ask_again(std::move(trouble));
  }
  const fs::path whole = fs::absolute(path).lexically_normal();
  chooser_.ask_again({purpose, whole.parent_path(), whole.filename(), places(purpose)},
                     std::move(trouble));
}

void FileDialogs::write_to(const fs::path& file, std::function<void()> write) {
  std::error_code none;
  if (!fs::exists(file, none)) return write();
  overwriting_ = {file, std::move(write)};
}

void FileDialogs::answer_overwriting(bool writes) {
  const Overwriting asked = *std::exchange(overwriting_, std::nullopt);
  writes ? asked.write() : chooser_.ask_again({});
}

bool FileDialogs::close() {
  const bool is_open = asks();
  if (asks_to_overwrite()) {
    answer_overwriting(false);
  } else {
    chooser_.close();
  }
  return is_open;
}

void FileDialogs::take(const InputEvent& event) {
  if (!asks_to_overwrite()) chooser_.take(event);
}

std::optional<ChosenPath> FileDialogs::draw() {
  if (asks_to_overwrite()) {
    // Draw this panel before the dialogs that open it, so that a key pressed in them does not
    // answer it.
    if (const auto writes = draw_overwrite_panel(overwriting_->file)) answer_overwriting(*writes);
    return {};
  }
  auto chosen = chooser_.draw();
  if (!chosen) return {};
  last_folder_ = chosen->path.parent_path();
  chosen_ = chosen;
  return chosen;
}

void FileDialogs::hear(Message message) {
  // A message about a file that cannot be read begins with its path.
  const bool is_of_chosen = chosen_ && message.text.starts_with(chosen_->path.string());
  if (!is_of_chosen) return say_(std::move(message));
  const ChosenPath chosen = *std::exchange(chosen_, std::nullopt);
  ask_again(chosen.purpose, chosen.path, std::move(message.text));
}

}  // namespace lapwing::viewer
