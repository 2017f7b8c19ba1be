#pragma once

#include <cstddef>
#include <string>

#include "lapwing/base/progress.h"

namespace lapwing::cli {

/// Shows the stages of a long operation on standard error: a progress bar on a terminal, otherwise
/// one line per stage. Shows nothing if `quiet`. An interrupt (Ctrl+C) cancels at the next stage.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Returns the callback for the engine, which refers to this object.
  Progress callback();

  /// Prints a line above the bar, such as "step 2 of 3: deform". Prints nothing if `quiet`.
  void note(const std::string& text);

 private:
  void show(std::string_view stage, double fraction);
  void clear_bar();

  bool quiet_;
  bool terminal_;
  bool bar_shown_ = false;
  std::string last_stage_;
};

}  // namespace lapwing::cli
