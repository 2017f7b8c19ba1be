#pragma once

#include <cstddef>
#include <string>

#include "lapwing/base/progress.h"

namespace lapwing::cli {

/// Shows the stages of a long operation on standard error: a bar that renews itself on a terminal,
/// one line a stage elsewhere, nothing when quiet. An interrupt (Ctrl+C) cancels at the next stage.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// To hand to the engine; refers to this object.
  Progress callback();

  /// A line of its own, above any bar: "step 2 of 3: deform". Nothing when quiet.
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
