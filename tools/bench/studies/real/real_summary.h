#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/real/real_run.h"

namespace lapwing::bench {

/// A run that the summary names.
struct NotedRun {
  std::string run;  ///< "cgal/meshes/cow.off lift"
  std::string values;
};

/// A target of the engine: the number of runs in which a condition holds, and its bound.
struct RealFigure {
  std::string name;
  std::size_t count = 0;
  std::size_t of = 0;    ///< number of runs that were checked
  bool is_floor = true;  ///< whether `bound` is a lower or an upper bound
  double bound = 0.0;    ///< in runs
  std::string target;    ///< `bound` in words
  std::vector<NotedRun> exceptions = {};

  double share() const;  ///< 0 if there are no runs
  bool met() const;      ///< false if there are no runs
};

struct RealSummary {
  std::size_t meshes = 0;
  std::size_t runs = 0;
  std::size_t ours = 0;      ///< number of runs that ours measured
  std::size_t arap = 0;      ///< number of runs that ARAP measured
  std::size_t compared = 0;  ///< number of runs that both measured
  std::vector<RealFigure> figures;
  std::vector<NotedRun> not_run;      ///< nothing to deform
  std::vector<NotedRun> ours_failed;  ///< the default result or the linear response
  std::vector<NotedRun> arap_failed;
  /// Runs in which Smooth ARAP has fewer flips than ours, or a largest edge or detail error that is
  /// less by a tenth.
  std::vector<NotedRun> smooth_arap_better;
  std::vector<NotedRun> smooth_arap_failed;
};

/// Compares our results with ARAP's if both exist. Detail errors within 1e-6 are equal. If ours
/// failed, the run does not count as settled.
RealSummary summary_of(const std::vector<RealRun>& runs);

}  // namespace lapwing::bench
