#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/recent_files.h"
#include "preferences/preferences.h"
#include "ui/document.h"
#include "ui/file_chooser.h"
#include "ui/messages.h"

namespace lapwing::viewer {

/// Returns a path beside the opened mesh that does not overwrite it.
std::filesystem::path edited_path(const OpenedMesh& opened);

/// Asks the user for paths, and whether to overwrite a file. Suggests names and folders that suit
/// the open document.
class FileDialogs {
 public:
  /// `recent` is the file with the list of recent files.
  FileDialogs(const std::unique_ptr<Document>& document, const Preferences& preferences,
              const std::filesystem::path& recent, Messages& messages, Say say);

  /// Asks for a path. Does nothing if the purpose needs a document and none is open.
  void ask_for(PathPurpose purpose);
  /// Tells the user why `path` cannot be used, and asks for another path for `purpose`.
  void ask_again(PathPurpose purpose, const std::filesystem::path& path, std::string trouble);
  /// Takes a message of the editor or its desks. If it is about the file that was just chosen, asks
  /// again.
  void hear(Message message);
  /// Runs `write`. If `file` exists, first asks the user whether to overwrite it. If the user
  /// declines, asks for another path.
  void write_to(const std::filesystem::path& file, std::function<void()> write);

  bool asks_for_path() const { return chooser_.is_open(); }
  bool asks_for_path(PathPurpose purpose) const {
    return chooser_.is_open() && chooser_.purpose() == purpose;
  }
  bool asks_to_overwrite() const { return overwriting_.has_value(); }
  bool asks() const { return asks_for_path() || asks_to_overwrite(); }
  /// Closes the dialog in front. Returns false if none is open.
  bool close();
  /// Takes a key or letter that no text field has received.
  void take(const InputEvent& event);
  /// Lays out one frame. Returns the user's choice once.
  std::optional<ChosenPath> draw();

  RecentFiles& recent() { return recent_; }
  std::span<const std::filesystem::path> samples() const { return samples_; }

 private:
  std::string suggested_name(PathPurpose purpose) const;
  std::filesystem::path folder_to_ask_in(PathPurpose purpose) const;
  std::vector<BrowserPlace> places(PathPurpose purpose) const;
  void answer_overwriting(bool writes);

  // A file that exists, and what to do if the user overwrites it.
  struct Overwriting {
    std::filesystem::path file;
    std::function<void()> write;
  };

  const std::unique_ptr<Document>& document_;
  const Preferences& preferences_;
  Messages& messages_;
  Say say_;
  FileChooser chooser_;
  RecentFiles recent_;
  std::vector<std::filesystem::path> samples_;
  std::filesystem::path last_folder_;  // where a file was last chosen
  std::optional<ChosenPath> chosen_;   // being read by the editor or a desk
  std::optional<Overwriting> overwriting_;
};

}  // namespace lapwing::viewer
