#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/folder_listing.h"
#include "tools/input.h"
#include "work/job.h"

struct ImGuiInputTextCallbackData;

namespace lapwing::viewer {

/// A shortcut: a folder to show, or a file to use at once.
struct BrowserPlace {
  std::string label;
  std::filesystem::path path;
  bool is_file = false;
};

/// A request for a path.
struct PathRequest {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path folder;  ///< start folder, absolute
  std::string name;              ///< suggested, or typed before
  std::vector<BrowserPlace> places;
};

/// The built-in file browser, in its own window: places, the path, the contents of the folder, and
/// a field for a name or path that has the keyboard from the start. Tab completes, Enter accepts,
/// Escape closes.
class BrowserPanel {
 public:
  /// `wake` is called, on another thread, when a folder has been read.
  explicit BrowserPanel(std::function<void()> wake);

  /// Opens the browser. `trouble` says why the last choice cannot be used.
  void open(PathRequest request, std::string trouble = {});
  bool is_open() const { return request_.has_value(); }
  void close() { request_.reset(); }
  void say(std::string trouble);

  /// Takes keys that are typed while the field does not have the keyboard.
  void take(const InputEvent& event);

  /// Lays out one frame. Returns the absolute path that the user accepts, which need not exist. It
  /// is a folder only if a folder is asked for.
  std::optional<std::filesystem::path> draw();

  const std::filesystem::path& folder() const { return folder_; }  ///< the folder that is shown
  const std::string& typed() const { return typed_; }

 private:
  void show(std::filesystem::path folder);
  void list();
  void focus(bool at_end);
  void complete();
  std::optional<std::filesystem::path> accept();
  std::optional<std::filesystem::path> draw_inside();
  void draw_way();
  std::optional<std::filesystem::path> draw_places();
  bool draw_list();
  bool draw_entry(const FolderEntry& entry);
  bool draw_field();
  void draw_filter();
  static int on_field(ImGuiInputTextCallbackData* data);

  std::optional<PathRequest> request_;
  std::filesystem::path folder_;
  FolderListing listing_;
  Job<FolderListing> reader_;
  std::string typed_;
  std::string trouble_;
  std::size_t kind_ = 0;  // index into the purpose's kinds
  bool shows_hidden_ = false;

  // The field gets the keyboard a frame or two after the request.
  bool asks_for_focus_ = false;
  bool has_focus_ = false;       // as of the last frame
  bool is_suggestion_ = false;   // the next letter replaces it
  bool cursor_to_end_ = false;   // once it has the keyboard
  bool enter_pressed_ = false;   // while it did not have the keyboard
  bool scrolls_to_top_ = false;  // the list
};

}  // namespace lapwing::viewer
