#pragma once

#include <filesystem>

#include "lapwing/base/stopwatch.h"
#include "lapwing/batch/batch.h"

namespace lapwing::cli {

/// Shows the progress of a batch on standard error, with its rate and the time left: a progress bar
/// on a terminal, otherwise a line every ten seconds. Shows nothing if `quiet`.
class BatchDisplay {
 public:
  explicit BatchDisplay(bool quiet);

  void show(const BatchCount& count);
  /// Prints the last line, and names the file with the failures.
  void finish(const BatchCount& count, const std::filesystem::path& folder);

 private:
  std::string words_of(const BatchCount& count) const;

  bool quiet_;
  bool terminal_;
  Stopwatch since_begin_;
  double shown_ms_ = 0.0;  ///< time of the last display, from the beginning
};

}  // namespace lapwing::cli
