#include "files/system_dialog.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string_view>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/child_process.h"

namespace lapwing::viewer {
namespace {

using Wants = PathWords::Wants;

// The number of bytes of error messages that are kept. The program may write any number of
// messages, but only the last one explains a failure.
constexpr std::size_t kMaxErrorBytes = 4096;
// The interval at which the end of the program is polled after it has closed its output.
constexpr int kLookAgainMs = 10;

struct Pipe {
  int read = -1;
  int write = -1;
};

Pipe open_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw IoError("Cannot start the system file dialog: " + std::generic_category().message(errno) +
                  "; close other programs");
  }
  return {ends[0], ends[1]};
}

// Appends the available bytes to `text`. Returns false at the end of the file.
bool read_some(int descriptor, std::string& text) {
  std::array<char, 1024> part;
  const ssize_t count = read(descriptor, part.data(), part.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  text.append(part.data(), static_cast<std::size_t>(count));
  return count > 0;
}

std::string last_line(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const auto newline = text.rfind('\n');
  return std::string(newline == std::string_view::npos ? text : text.substr(newline + 1));
}

// Converts the exit status and the output of the program to an answer. Both programs print the path
// and exit with 0, or exit with 1 if the user cancels. zenity also exits with 1 without a display.
DialogAnswer answer_of(const std::string& name, int status, std::string output,
                       const std::string& errors) {
  using What = DialogAnswer::What;
  const std::string words = last_line(errors);
  if (WIFSIGNALED(status)) {
    return {What::failed, {}, name + " was stopped by signal " + std::to_string(WTERMSIG(status))};
  }
  const int code = WEXITSTATUS(status);
  const bool is_blind = errors.find("cannot open display") != std::string::npos ||
                        errors.find("could not connect to display") != std::string::npos;
  if (code == 1 && !is_blind) return {What::cancelled, {}, {}};
  if (output.ends_with('\n')) output.pop_back();
  if (code == 0 && output.starts_with('/')) return {What::chosen, output, {}};
  const std::string why = !words.empty() ? words
                          : code == 0    ? "it returned no file"
                                         : "it exited with code " + std::to_string(code);
  return {What::failed, {}, name + ": " + why};
}

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

// Returns patterns such as "*.obj *.OBJ", because the dialogs distinguish upper and lower case.
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
  // If the name is empty, this path ends in a slash and zenity uses it as the start folder.
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

SystemDialog::SystemDialog(const std::vector<std::string>& command, std::function<void()> wake)
    : name_(std::filesystem::path(command.at(0)).filename()), wake_(std::move(wake)) {
  const Pipe output = open_pipe();
  output_.emplace(output.read);
  FileDescriptor output_end(output.write);
  const Pipe errors = open_pipe();
  errors_.emplace(errors.read);
  FileDescriptor errors_end(errors.write);
  stop_.emplace(eventfd(0, EFD_CLOEXEC));
  process_ = start_child(command, {.output = output.write, .errors = errors.write});
  thread_ = std::thread([this] { wait_for_answer(); });
}

SystemDialog::~SystemDialog() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(stop_->get(), &one, sizeof one);
  thread_.join();
}

std::optional<DialogAnswer> SystemDialog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void SystemDialog::wait_for_answer() {
  std::string output;
  std::string errors;
  std::array<pollfd, 3> watched{
      {{output_->get(), POLLIN, 0}, {errors_->get(), POLLIN, 0}, {stop_->get(), POLLIN, 0}}};
  bool stopped = false;
  // Wait only for the end of the output, because a child process of the dialog may keep the pipe of
  // error messages open.
  while (watched[0].fd >= 0 && !stopped) {
    if (poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) break;
    if (watched[1].revents != 0 && !read_some(errors_->get(), errors)) watched[1].fd = -1;
    if (errors.size() > kMaxErrorBytes) errors.erase(0, errors.size() - kMaxErrorBytes);
    if (watched[0].revents != 0 && !read_some(output_->get(), output)) watched[0].fd = -1;
    stopped = watched[2].revents != 0;
  }
  int status = 0;
  while (!stopped && waitpid(process_, &status, WNOHANG) == 0) {
    pollfd stop{stop_->get(), POLLIN, 0};
    stopped = poll(&stop, 1, kLookAgainMs) > 0;
  }
  if (stopped) {
    // The dialog can be killed, because it has no data to save.
    kill(-process_, SIGKILL);
    waitpid(process_, &status, 0);
    return;
  }
  fcntl(errors_->get(), F_SETFL, O_NONBLOCK);
  while (watched[1].fd >= 0 && errors.size() <= kMaxErrorBytes) {
    const std::size_t before = errors.size();
    if (!read_some(errors_->get(), errors) || errors.size() == before) break;
  }
  {
    const std::lock_guard lock(mutex_);
    answer_ = answer_of(name_, status, std::move(output), errors);
  }
  if (wake_) wake_();
}

}  // namespace lapwing::viewer
