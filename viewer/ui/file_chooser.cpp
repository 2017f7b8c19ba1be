#include "ui/file_chooser.h"

#include <imgui.h>
#include <utility>

#include "files/path_text.h"
#include "lapwing/base/errors.h"
#include "ui/widgets.h"

namespace lapwing::viewer {

namespace fs = std::filesystem;

FileChooser::FileChooser(std::function<void()> wake) : wake_(wake), browser_(std::move(wake)) {}

void FileChooser::ask(PathRequest request) {
  close();
  begin(std::move(request));
  const auto program = uses_system_dialog ? find_dialog_program() : std::nullopt;
  if (!program) return browser_.open(request_);
  try {
    dialog_ = std::make_unique<SystemDialog>(
        dialog_command(*program, {request_.purpose, request_.folder, request_.name}), wake_);
  } catch (const IoError& error) {
    browser_.open(request_, std::string(error.what()) + ". Choose a file here instead.");
  }
}

void FileChooser::ask_again(std::string trouble) {
  close();
  browser_.open(request_, std::move(trouble));
}

void FileChooser::ask_again(PathRequest request, std::string trouble) {
  close();
  begin(std::move(request));
  browser_.open(request_, std::move(trouble));
}

void FileChooser::begin(PathRequest request) {
  request_ = std::move(request);
  suggested_ = request_.name;
  chosen_.clear();
}

void FileChooser::close() {
  dialog_.reset();
  answered_.reset();
  browser_.close();
}

void FileChooser::take(const InputEvent& event) {
  if (browser_.is_open()) browser_.take(event);
}

std::optional<ChosenPath> FileChooser::draw() {
  take_answer();
  if (dialog_) draw_waiting();
  if (answered_) return accept(*std::exchange(answered_, std::nullopt));
  if (auto path = browser_.draw()) return accept(*std::move(path));
  return {};
}

void FileChooser::take_answer() {
  using What = DialogAnswer::What;
  std::optional<DialogAnswer> answer = dialog_ ? dialog_->take() : std::nullopt;
  if (!answer) return;
  dialog_.reset();
  if (answer->what == What::chosen) answered_ = std::move(answer->path);
  if (answer->what == What::failed) {
    browser_.open(request_, "The system file dialog failed (" + answer->reason +
                                "). Choose a file here instead.");
  }
}

// Draws a window that says why keys do nothing here.
void FileChooser::draw_waiting() {
  center_next_window();
  const std::string title = std::string(words_of(request_.purpose).title) + "###waiting";
  bool browses = false;
  bool cancels = false;
  if (ImGui::Begin(title.c_str(), nullptr, kDialog)) {
    ImGui::TextUnformatted("Choose a file in the system file dialog.");
    browses = ImGui::Button("Use built-in file browser");
    ImGui::SameLine();
    cancels = ImGui::Button("Cancel");
  }
  ImGui::End();
  if (browses || cancels) dialog_.reset();
  if (browses) browser_.open(request_);
}

std::optional<ChosenPath> FileChooser::accept(fs::path path) {
  path = with_extension(std::move(path), request_.purpose, suggested_);
  std::string trouble = trouble_with(path, request_.purpose);
  request_.folder = browser_.is_open() ? browser_.folder() : path.parent_path();
  request_.name = browser_.is_open() ? browser_.typed() : path.filename().string();
  chosen_ = path;
  if (trouble.empty()) {
    close();
    return ChosenPath{request_.purpose, std::move(path)};
  }
  if (browser_.is_open()) {
    // What was typed stays as it is.
    browser_.say(std::move(trouble));
  } else {
    ask_again(std::move(trouble));
  }
  return {};
}

}  // namespace lapwing::viewer
