#include "ui/messages.h"

#include <algorithm>
#include <utility>

namespace lapwing::viewer {
namespace {

constexpr std::size_t kLongestLog = 200;
// More would cover the picture; the log has all of them.
constexpr std::size_t kMostToasts = 4;
constexpr double kReadingSeconds = 4.0;

}  // namespace

void Messages::remove_note() {
  std::erase_if(toasts_, [](const Toast& toast) { return toast.message.tone == Tone::note; });
}

void Messages::say(Message message, double now) {
  if (message.text.empty()) return remove_note();
  if (!toasts_.empty() && toasts_.back().message == message) {
    toasts_.back().since = now;
    ++toasts_.back().times;
  } else {
    if (message.tone == Tone::note) remove_note();
    if (toasts_.size() == kMostToasts) toasts_.erase(toasts_.begin());
    toasts_.push_back({message, now, 1});
  }
  record(std::move(message));
}

void Messages::record(Message message) {
  if (log_.size() == kLongestLog) log_.erase(log_.begin());
  log_.push_back(std::move(message));
}

void Messages::acted(double now) {
  std::erase_if(toasts_, [now](const Toast& toast) {
    return toast.message.tone == Tone::note && now - toast.since >= kReadingSeconds;
  });
}

void Messages::close(std::size_t toast) {
  if (toast < toasts_.size()) toasts_.erase(toasts_.begin() + static_cast<std::ptrdiff_t>(toast));
}

}  // namespace lapwing::viewer
