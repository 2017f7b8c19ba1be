#include "progress_display.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <unistd.h>

#include "lapwing/base/printable_text.h"

namespace lapwing::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) {
  interrupted = 1;
  // A second interrupt ends the program at once.
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool quiet) : quiet_(quiet), terminal_(isatty(2) != 0) {
  std::signal(SIGINT, on_interrupt);
}

ProgressDisplay::~ProgressDisplay() {
  clear_bar();
  std::signal(SIGINT, SIG_DFL);
}

Progress ProgressDisplay::callback() {
  return [this](std::string_view stage, double fraction) {
    if (!quiet_) show(stage, fraction);
    return interrupted == 0;
  };
}

void ProgressDisplay::note(const std::string& text) {
  if (quiet_) return;
  clear_bar();
  std::fprintf(stderr, "%s\n", printable(text).c_str());
}

void ProgressDisplay::show(std::string_view stage, double fraction) {
  if (!terminal_) {
    if (stage != last_stage_) std::fprintf(stderr, "  %s\n", std::string(stage).c_str());
    last_stage_ = stage;
    return;
  }
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K  [%s] %s", bar.c_str(), std::string(stage).c_str());
  std::fflush(stderr);
  bar_shown_ = true;
}

void ProgressDisplay::clear_bar() {
  if (bar_shown_) std::fprintf(stderr, "\r\033[K");
  bar_shown_ = false;
}

}  // namespace lapwing::cli
