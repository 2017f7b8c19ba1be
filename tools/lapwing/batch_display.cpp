#include "batch_display.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <unistd.h>

#include "messages.h"

namespace lapwing::cli {
namespace {

constexpr double kBarEvery_ms = 100.0;
constexpr double kLineEvery_ms = 10'000.0;

std::string words_of_time(double seconds) {
  char text[32];
  const auto whole = static_cast<long>(std::ceil(seconds));
  std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

BatchDisplay::BatchDisplay(bool quiet) : quiet_(quiet), terminal_(isatty(2) != 0) {}

// Returns text such as "312 of 1000 done, 2 failed, 31.4 edits/s, 0:00:22 left". The rate is that
// of this run.
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
  constexpr std::size_t kWidth = 30;
  // A shard may have no jobs.
  const std::size_t jobs = std::max<std::size_t>(count.jobs, 1);
  std::string bar(kWidth * (count.done + count.failed) / jobs, '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K  [%s] %s", bar.c_str(), words_of(count).c_str());
  std::fflush(stderr);
}

void BatchDisplay::finish(const BatchCount& count, const std::filesystem::path& folder) {
  if (quiet_) return;
  std::fprintf(stderr, "%s%s\n", terminal_ ? "\r\033[K" : "", words_of(count).c_str());
  if (count.failed > 0) {
    std::fprintf(stderr, "failed jobs and their errors: %s\n",
                 shown(folder / "failed*.jsonl").c_str());
  }
  if (!count.is_complete()) std::fprintf(stderr, "continue with --resume\n");
}

}  // namespace lapwing::cli
