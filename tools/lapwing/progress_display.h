#pragma once

#include <filesystem>
#include <string>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/batch/batch.h"

namespace lapwing::cli {

/// Shows the progress of a long operation as a bar, if standard error is a terminal and `quiet` is
/// false. An interrupt (Ctrl+C) cancels the operation at the next stage.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Returns the callback for the engine, which refers to this object.
  Progress callback();

  /// Removes the bar from the terminal, so that other lines can be printed.
  void clear();

 private:
  void show(std::string_view stage, double fraction);

  bool shown_;
  bool bar_shown_ = false;
};

/// Shows the progress of a batch on standard error, with its rate and the remaining time: a bar on
/// a terminal, otherwise a line every ten seconds. Shows nothing if `quiet` is true.
class BatchDisplay {
 public:
  explicit BatchDisplay(bool quiet);

  void show(const BatchCount& count);
  /// Removes the bar and prints the final counts.
  void finish(const BatchCount& count);

 private:
  std::string words_of(const BatchCount& count) const;

  bool quiet_;
  bool terminal_;
  Stopwatch since_begin_;
  double shown_ms_ = 0.0;  ///< time of the last output, since construction
};

}  // namespace lapwing::cli
