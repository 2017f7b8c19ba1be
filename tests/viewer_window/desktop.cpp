#include "viewer_window/desktop.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <signal.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace lapwing::test {
namespace {

constexpr int kStillRunning = -1000;

void change_environment(const std::vector<std::string>& changes) {
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    const std::string name = change.substr(0, equals);
    if (equals + 1 == change.size()) {
      unsetenv(name.c_str());
    } else {
      setenv(name.c_str(), change.c_str() + equals + 1, 1);
    }
  }
}

[[noreturn]] void become(std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment,
                         const std::filesystem::path& errors) {
  // A test that crashes takes its programs along: they hold the pipe that its output is read from.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  change_environment(environment);
  const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDERR_FILENO);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

// Xvfb keeps its screen in a file of X's window dumps: a header of big-endian words, a colour map,
// rows of blue, green, red and nothing.
Image read_dump(const std::string& bytes) {
  const auto word = [&](std::size_t number) {
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      value = value << 8U | static_cast<std::uint8_t>(bytes.at(4 * number + b));
    }
    return value;
  };
  constexpr std::size_t kColorBytes = 12;
  const std::size_t start = word(0) + kColorBytes * word(19);
  const std::size_t row_bytes = word(12);
  Image image{word(4), word(5), {}};
  if (bytes.size() < start + row_bytes * image.height) {
    throw std::runtime_error("the screen's dump is cut short");
  }
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  std::uint8_t* to = image.rgba.data();
  for (std::size_t y = 0; y < image.height; ++y) {
    const char* from = bytes.data() + start + y * row_bytes;
    for (std::size_t x = 0; x < image.width; ++x, from += 4, to += 4) {
      to[0] = static_cast<std::uint8_t>(from[2]);
      to[1] = static_cast<std::uint8_t>(from[1]);
      to[2] = static_cast<std::uint8_t>(from[0]);
      to[3] = 255;
    }
  }
  return image;
}

}  // namespace

bool has_desktop() {
  const bool found = access(LAPWING_XVFB, X_OK) == 0 && access(LAPWING_XDOTOOL, X_OK) == 0;
#ifdef LAPWING_REQUIRE_WINDOW_TESTS
  EXPECT_TRUE(found) << "configured with LAPWING_REQUIRE_GPU_TESTS, but without Xvfb or xdotool";
#endif
  return found;
}

Process::Process(std::vector<std::string> arguments, const std::vector<std::string>& environment,
                 std::filesystem::path errors)
    : errors_(std::move(errors)) {
  pid_ = fork();
  if (pid_ == 0) become(arguments, environment, errors_);
}

Process::~Process() {
  if (!running()) return;
  // Gently first: a display removes its lock and its socket.
  kill(pid_, SIGTERM);
  constexpr double kPatience = 5.0;
  if (wait(kPatience) != kStillRunning) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

bool Process::running() {
  if (status_ != kStillRunning) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return false;
}

void Process::send(int signal) {
  ::kill(pid_, signal);
}

int Process::wait(double seconds) {
  eventually(seconds, [&] { return !running(); });
  return status_;
}

void Process::kill_now() {
  kill(pid_, SIGKILL);
}

std::string Process::errors() const {
  return content_of(errors_);
}

Desktop::Desktop(const std::filesystem::path& folder) : folder_(folder) {
  const std::filesystem::path number = folder / "display";
  std::string command = "exec " LAPWING_XVFB " -screen 0 1280x800x24 -noreset -nolisten tcp";
  command += " -fbdir " + folder.string() + " -displayfd 3 3>" + number.string();
  server_ = std::make_unique<Process>(std::vector<std::string>{"/bin/sh", "-c", command},
                                      std::vector<std::string>{}, folder / "xvfb.log");
  constexpr double kPatience = 20.0;
  if (!eventually(kPatience, [&] { return content_of(number).ends_with('\n'); })) {
    throw std::runtime_error("Xvfb does not start: " + server_->errors());
  }
  const std::string digits = content_of(number);
  display_ = std::string(":").append(digits, 0, digits.size() - 1);
}

std::string Desktop::xdotool(const std::string& arguments) const {
  const std::string command = display() + " " + LAPWING_XDOTOOL + " " + arguments + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string printed;
  std::array<char, 256> part;
  while (std::fgets(part.data(), part.size(), pipe.get()) != nullptr) printed += part.data();
  return printed;
}

Image Desktop::picture() const {
  return read_dump(content_of(folder_ / "Xvfb_screen0"));
}

void Desktop::vanish() {
  server_->kill_now();
}

Image Desktop::settled_picture() const {
  constexpr double kPatience = 15.0;
  constexpr double kBetween = 0.5;
  Image last = picture();
  eventually(kPatience, [&] {
    sleep_seconds(kBetween);
    Image now = picture();
    const bool same = now.rgba == last.rgba;
    last = std::move(now);
    return same;
  });
  return last;
}

std::vector<std::string> viewer_environment(const Desktop& desktop,
                                            const std::filesystem::path& folder) {
  const std::string base = folder.string();
  return {desktop.display(),
          "HOME=" + base,
          "PATH=" + base + "/bin",
          "XDG_CACHE_HOME=" + base + "/cache",
          "XDG_DATA_HOME=" + base + "/data",
          "XDG_STATE_HOME=" + base + "/state",
          "WAYLAND_DISPLAY=",
          "XDG_CURRENT_DESKTOP="};
}

void sleep_seconds(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

Image part_of(const Image& picture, std::uint32_t left, std::uint32_t top, std::uint32_t width,
              std::uint32_t height) {
  Image part{width, height, {}};
  for (std::uint32_t y = top; y < top + height; ++y) {
    const auto row = picture.rgba.begin() + 4 * (std::ptrdiff_t{picture.width} * y + left);
    part.rgba.insert(part.rgba.end(), row, row + std::ptrdiff_t{4} * width);
  }
  return part;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(a.rgba[i] - b.rgba[i]);
  return sum / static_cast<double>(a.rgba.size());
}

}  // namespace lapwing::test
