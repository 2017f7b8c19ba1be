// The command lines of zenity and kdialog.

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>

#include "files/system_dialog.h"
#include "lapwing/io/child_process.h"

namespace lapwing::viewer {
namespace {

using Wants = PathWords::Wants;

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

// Returns patterns as in "*.obj *.OBJ", because the dialogs distinguish upper and lower case.
std::string patterns(const FileKind& kind) {
  if (kind.extensions.empty()) return "*";
  std::string text;
  for (const std::string_view extension : kind.extensions) {
    std::string upper(extension);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    text.append(text.empty() ? "*" : " *").append(extension).append(" *").append(upper);
  }
  return text;
}

std::vector<std::string> ask_zenity(const std::string& program, const DialogRequest& request) {
  const PathWords& words = words_of(request.purpose);
  std::vector<std::string> command{program, "--file-selection",
                                   "--title=" + std::string(words.title)};
  if (words.wants == Wants::new_file) command.emplace_back("--save");
  if (words.wants == Wants::folder) command.emplace_back("--directory");
  // If this ends in a slash, it is the start folder.
  command.push_back("--filename=" + (request.folder / request.name).string());
  for (const FileKind& kind : words.kinds) {
    command.push_back("--file-filter=" + std::string(kind.name) + " | " + patterns(kind));
  }
  return command;
}

std::vector<std::string> ask_kdialog(const std::string& program, const DialogRequest& request) {
  const PathWords& words = words_of(request.purpose);
  std::vector<std::string> command{program, "--title", std::string(words.title)};
  const char* asks = words.wants == Wants::folder     ? "--getexistingdirectory"
                     : words.wants == Wants::new_file ? "--getsavefilename"
                                                      : "--getopenfilename";
  command.emplace_back(asks);
  command.push_back((request.folder / request.name).string());
  std::string filter;
  for (const FileKind& kind : words.kinds) {
    filter.append(filter.empty() ? "" : "\n").append(patterns(kind)).append("|").append(kind.name);
  }
  if (!filter.empty()) command.push_back(filter);
  return command;
}

}  // namespace

std::optional<DialogProgram> find_dialog_program() {
  using Kind = DialogProgram::Kind;
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return {};
  std::array<std::pair<Kind, std::string_view>, 2> programs{
      {{Kind::zenity, "zenity"}, {Kind::kdialog, "kdialog"}}};
  const char* desktop = std::getenv("XDG_CURRENT_DESKTOP");
  if (desktop != nullptr && std::string_view(desktop).find("KDE") != std::string_view::npos) {
    std::swap(programs[0], programs[1]);
  }
  for (const auto& [kind, name] : programs) {
    if (auto path = find_program(name)) return DialogProgram{kind, *std::move(path)};
  }
  return {};
}

std::vector<std::string> dialog_command(const DialogProgram& program,
                                        const DialogRequest& request) {
  return program.kind == DialogProgram::Kind::zenity ? ask_zenity(program.path, request)
                                                     : ask_kdialog(program.path, request);
}

}  // namespace lapwing::viewer
