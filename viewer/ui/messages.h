#pragma once

#include <span>
#include <vector>

#include "state/message.h"

namespace lapwing::viewer {

/// The messages to the user: the log, and the toasts, which are still to be read. Only the last
/// note is a toast; warnings and errors stay until they are closed. Times are in seconds of any
/// clock that does not go back.
class Messages {
 public:
  struct Toast {
    Message message;
    double since;
    int times;  ///< said in a row
  };

  /// Adds to log and toasts, in the words of the window. An empty message removes the toasts of its
  /// tone.
  void say(Message message, double now);
  /// Adds only to the log, because the message is shown elsewhere.
  void record(Message message);
  /// The user did something. Removes a note that was shown long enough to be read.
  void acted(double now);
  void close(std::size_t toast);
  void close_all() { toasts_.clear(); }

  /// Newest last.
  std::span<const Toast> toasts() const { return toasts_; }
  std::span<const Message> log() const { return log_; }

 private:
  void remove(Tone tone);
  void log(Message message);

  std::vector<Toast> toasts_;
  std::vector<Message> log_;
};

}  // namespace lapwing::viewer
