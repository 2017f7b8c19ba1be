#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "lapwing/io/image.h"

namespace lapwing::test {

/// Whether windows can be opened and driven here. Without Xvfb or xdotool a test may only skip, and
/// where the build requires GPU tests it fails instead.
bool has_desktop();

/// A program that runs, its standard error in a file. Killed with this if it still runs.
class Process {
 public:
  /// `arguments` begin with the program; "NAME=value" in `environment` are added, "NAME=" alone
  /// removes.
  Process(std::vector<std::string> arguments, const std::vector<std::string>& environment,
          std::filesystem::path errors);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running();
  void send(int signal);
  /// Its exit code, or minus the signal that ended it, waiting up to `seconds`; -1000 if it still
  /// runs then.
  int wait(double seconds);
  std::string errors() const;
  /// SIGKILL.
  void kill_now();

 private:
  pid_t pid_;
  std::filesystem::path errors_;
  int status_ = -1000;
};

/// A separate virtual display of 1280 x 800 pixels.
class Desktop {
 public:
  explicit Desktop(const std::filesystem::path& folder);

  const std::string& name() const { return display_; }  ///< ":N"
  const std::filesystem::path& folder() const { return folder_; }
  /// For the environment of programs.
  std::string display() const { return "DISPLAY=" + display_; }
  /// Runs xdotool and returns what it prints.
  std::string xdotool(const std::string& arguments) const;
  /// What the display shows.
  Image picture() const;
  /// Ends at once, without a word to the windows on it.
  void vanish();
  /// What it shows once that is the same twice in a row.
  Image settled_picture() const;

 private:
  std::filesystem::path folder_;
  std::string display_;
  std::unique_ptr<Process> server_;
};

/// The environment of a viewer on `desktop` that keeps in `folder` whatever it keeps anywhere, and
/// finds there the programs that it starts: in bin/, which is empty unless a test fills it.
std::vector<std::string> viewer_environment(const Desktop& desktop,
                                            const std::filesystem::path& folder);

void sleep_seconds(double seconds);

/// Waits until `happened` returns true, but at most `seconds`. Returns the last result of
/// `happened`.
template <typename Happened>
bool eventually(double seconds, Happened happened) {
  constexpr double kStep = 0.05;
  for (double waited = 0.0; waited < seconds; waited += kStep) {
    if (happened()) return true;
    sleep_seconds(kStep);
  }
  return happened();
}

/// Returns a rectangle of an image, given its upper left corner and its size.
Image part_of(const Image& picture, std::uint32_t left, std::uint32_t top, std::uint32_t width,
              std::uint32_t height);

/// Returns the mean difference of the channels, from 0 to 255, of two images of equal size.
double mean_difference(const Image& a, const Image& b);

}  // namespace lapwing::test

/// First line of a test that opens windows.
#define LAPWING_NEEDS_DESKTOP()                                                     \
  LAPWING_NEEDS_GPU();                                                              \
  if (!::lapwing::test::has_desktop()) {                                            \
    GTEST_SKIP() << "no Xvfb or no xdotool; tools/setup/install-packages has them"; \
  }
