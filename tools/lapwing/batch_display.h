#pragma once

#include <filesystem>

#include "lapwing/base/stopwatch.h"
#include "lapwing/batch/batch.h"

namespace lapwing::cli {

/// Shows on standard error how far a batch is, with its rate and the time left: a bar that renews
/// itself on a terminal, a line every ten seconds elsewhere, nothing when quiet.
class BatchDisplay {
 public:
  explicit BatchDisplay(bool quiet);

  void show(const BatchCount& count);
  /// The last line, and where to look for what failed.
  void finish(const BatchCount& count, const std::filesystem::path& folder);

 private:
  std::string words_of(const BatchCount& count) const;

  bool quiet_;
  bool terminal_;
  Stopwatch since_begin_;
  double shown_ms_ = 0.0;  ///< when, after the beginning
};

}  // namespace lapwing::cli
