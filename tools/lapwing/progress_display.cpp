#include "progress_display.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <unistd.h>

#include "messages.h"

namespace lapwing::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";

void print_bar(double fraction, const std::string& text) {
  constexpr std::size_t kWidth = 30;
  std::string bar(static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kWidth), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "%s  [%s] %s", kClearLine, bar.c_str(), text.c_str());
  std::fflush(stderr);
}

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) {
  interrupted = 1;
  // A second interrupt ends the program immediately.
  std::signal(SIGINT, SIG_DFL);
}

constexpr double kBarEvery_ms = 100.0;
constexpr double kLineEvery_ms = 10'000.0;

std::string words_of_time(double seconds) {
  char text[32];
  const auto whole = static_cast<long>(std::ceil(seconds));
  std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) != 0) {
  std::signal(SIGINT, on_interrupt);
}

ProgressDisplay::~ProgressDisplay() {
  clear();
  std::signal(SIGINT, SIG_DFL);
}

Progress ProgressDisplay::callback() {
  return [this](std::string_view stage, double fraction) {
    if (shown_) show(stage, fraction);
    return interrupted == 0;
  };
}

void ProgressDisplay::show(std::string_view stage, double fraction) {
  print_bar(fraction, std::string(stage));
  bar_shown_ = true;
}

void ProgressDisplay::clear() {
  if (bar_shown_) std::fputs(kClearLine, stderr);
  bar_shown_ = false;
}

BatchDisplay::BatchDisplay(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

// Returns text such as "312 of 1000 done, 2 failed, 31.4 edits/s, 0:00:22 left". The rate does not
// include edits of earlier runs.
std::string BatchDisplay::words_of(const BatchCount& count) const {
  const double seconds = since_begin_.elapsed_ms() / 1e3;
  const auto done = static_cast<double>(count.done - count.before);
  const double ended = done + static_cast<double>(count.failed);
  const auto left = static_cast<double>(count.jobs - count.done - count.failed);
  std::string text = std::to_string(count.done) + " of " + std::to_string(count.jobs) + " done";
  if (count.failed > 0) text += ", " + std::to_string(count.failed) + " failed";
  if (done == 0.0 || seconds <= 0.0) return text;
  char rate[32];
  std::snprintf(rate, sizeof rate, ", %.3g edits/s", done / seconds);
  text += rate;
  if (left > 0.0) text += ", " + words_of_time(left * seconds / ended) + " left";
  return text;
}

void BatchDisplay::show(const BatchCount& count) {
  const double now_ms = since_begin_.elapsed_ms();
  if (quiet_ || now_ms - shown_ms_ < (terminal_ ? kBarEvery_ms : kLineEvery_ms)) return;
  shown_ms_ = now_ms;
  if (!terminal_) {
    std::fprintf(stderr, "%s\n", words_of(count).c_str());
    return;
  }
  // Avoid a division by 0, because a shard may have no jobs.
  const auto jobs = static_cast<double>(std::max<std::size_t>(count.jobs, 1));
  print_bar(static_cast<double>(count.done + count.failed) / jobs, words_of(count));
}

void BatchDisplay::finish(const BatchCount& count) {
  if (quiet_) return;
  std::fprintf(stderr, "%s%s\n", terminal_ ? kClearLine : "", words_of(count).c_str());
}

}  // namespace lapwing::cli
