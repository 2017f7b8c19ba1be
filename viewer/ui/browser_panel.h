#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/folder_listing.h"
#include "tools/input.h"

struct ImGuiInputTextCallbackData;

namespace lapwing::viewer {

/// A short way to somewhere: a folder that is shown, or a file that is used at once.
struct BrowserPlace {
  std::string label;
  std::filesystem::path path;
  bool is_file = false;
};

/// What a person is asked for.
struct PathRequest {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path folder;  ///< where the person begins, absolute
  std::string name;              ///< suggested, or typed before
  std::vector<BrowserPlace> places;
};

/// The built-in file browser, in a window of its own: places, the way up, what is in the folder,
/// and a field for a name or path that has the keyboard as soon as the browser is there. Tab
/// completes, Enter accepts, Escape closes.
class BrowserPanel {
 public:
  /// `wake` is called, on another thread, when a folder has been read.
  explicit BrowserPanel(std::function<void()> wake);

  /// Begins anew. `trouble` says why what was chosen before cannot be used.
  void open(PathRequest request, std::string trouble = {});
  bool is_open() const { return request_.has_value(); }
  void close() { request_.reset(); }
  void say(std::string trouble);

  /// What was typed while the field did not have the keyboard yet, or not any more, is its own.
  void take(const InputEvent& event);

  /// Lays one frame out. The absolute path that the person accepts, which may not be there: a
  /// folder only where one is asked for.
  std::optional<std::filesystem::path> draw();

  const std::filesystem::path& folder() const { return folder_; }  ///< the one that is shown
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
  FolderReader reader_;
  std::string typed_;
  std::string trouble_;
  std::size_t kind_ = 0;  // of the purpose's kinds
  bool shows_hidden_ = false;

  // The field gets the keyboard a frame or two after it was asked to.
  bool asks_for_focus_ = false;
  bool has_focus_ = false;       // as of the last frame
  bool is_suggestion_ = false;   // the next letter takes its place
  bool cursor_to_end_ = false;   // once it has the keyboard
  bool enter_pressed_ = false;   // while it had not
  bool scrolls_to_top_ = false;  // the list
};

}  // namespace lapwing::viewer
