#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "files/system_dialog.h"
#include "ui/browser_panel.h"

namespace lapwing::viewer {

/// A path that a person has chosen, which `trouble_with` finds nothing wrong with.
struct ChosenPath {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path path;  ///< absolute
};

/// Asks for a path, whatever for: by the desktop's dialog where there is one, else by the built-in
/// browser, where also everything is said that is wrong with what was chosen.
class FileChooser {
 public:
  /// `wake` is called, on another thread, when there is news.
  explicit FileChooser(std::function<void()> wake);

  /// Whether the desktop's dialog is asked first, where there is one.
  bool uses_system_dialog = true;

  /// In place of what is asked for now.
  void ask(PathRequest request);
  /// Asks again for what was asked for last, with what was chosen then, and says why, in the
  /// built-in browser.
  void ask_again(std::string trouble);
  /// Likewise for something else.
  void ask_again(PathRequest request, std::string trouble);
  bool is_open() const { return dialog_ != nullptr || browser_.is_open(); }
  /// What for, now or last.
  PathPurpose purpose() const { return request_.purpose; }
  /// What was chosen last, of what was asked for last; empty before.
  const std::filesystem::path& chosen() const { return chosen_; }
  void close();

  /// A key or letter that no field had the keyboard for.
  void take(const InputEvent& event);

  /// Lays one frame out; what was chosen, once, after which this is closed.
  std::optional<ChosenPath> draw();

 private:
  void begin(PathRequest request);
  void take_answer();
  void draw_waiting();
  std::optional<ChosenPath> accept(std::filesystem::path path);

  std::function<void()> wake_;
  PathRequest request_;  // as it would be asked again
  std::string suggested_;
  std::filesystem::path chosen_;
  std::unique_ptr<SystemDialog> dialog_;
  std::optional<std::filesystem::path> answered_;  // by the dialog
  BrowserPanel browser_;
};

}  // namespace lapwing::viewer
