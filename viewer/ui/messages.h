#pragma once

#include <span>
#include <vector>

#include "state/message.h"

namespace lapwing::viewer {

/// What has been said to the person: the log, and the toasts, which are what is still to be read.
/// There is one note at most, the last; warnings and errors stay until they are closed. Times are
/// in seconds of any clock that does not go back.
class Messages {
 public:
  struct Toast {
    Message message;
    double since;
    int times;  ///< that it was said in a row
  };

  /// Adds to log and toasts; an empty message takes the note away.
  void say(Message message, double now);
  /// Adds to the log alone: it is shown elsewhere.
  void record(Message message);
  /// The person did something: a note that there was time to read goes.
  void acted(double now);
  void close(std::size_t toast);
  void close_all() { toasts_.clear(); }

  /// The newest last.
  std::span<const Toast> toasts() const { return toasts_; }
  std::span<const Message> log() const { return log_; }

 private:
  void remove_note();

  std::vector<Toast> toasts_;
  std::vector<Message> log_;
};

}  // namespace lapwing::viewer
