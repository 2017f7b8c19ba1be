#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "files/system_dialog.h"
#include "ui/browser_panel.h"

namespace lapwing::viewer {

/// A path that the user has chosen and `trouble_with` accepts.
struct ChosenPath {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path path;  ///< absolute
};

/// Asks for a path, by the desktop's dialog if there is one, else by the built-in browser. The
/// browser also says what is wrong with a choice.
class FileChooser {
 public:
  /// `wake` is called, on another thread, when there is news.
  explicit FileChooser(std::function<void()> wake);

  /// Whether the desktop's dialog is used if there is one.
  bool uses_system_dialog = true;

  /// Asks for a path, in place of any earlier request.
  void ask(PathRequest request);
  /// Repeats the last request in the built-in browser, with the last choice, and says why.
  void ask_again(std::string trouble);
  /// Likewise for another request.
  void ask_again(PathRequest request, std::string trouble);
  bool is_open() const { return dialog_ != nullptr || browser_.is_open(); }
  /// The purpose of the current or last request.
  PathPurpose purpose() const { return request_.purpose; }
  /// The last choice for the last request; empty before.
  const std::filesystem::path& chosen() const { return chosen_; }
  void close();

  /// Takes a key or letter that no field had the keyboard for.
  void take(const InputEvent& event);

  /// Lays out one frame. Returns the choice once, after which the chooser is closed.
  std::optional<ChosenPath> draw();

 private:
  void begin(PathRequest request);
  void take_answer();
  void draw_waiting();
  std::optional<ChosenPath> accept(std::filesystem::path path);

  std::function<void()> wake_;
  PathRequest request_;  // as it would be repeated
  std::string suggested_;
  std::filesystem::path chosen_;
  std::unique_ptr<SystemDialog> dialog_;
  std::optional<std::filesystem::path> answered_;  // by the dialog
  BrowserPanel browser_;
};

}  // namespace lapwing::viewer
