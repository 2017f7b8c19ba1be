#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/real/real_run.h"

namespace lapwing::bench {

/// A run that is told of by name.
struct NotedRun {
  std::string run;  ///< "cgal/meshes/cow.off lift"
  std::string values;
};

/// One number that the engine is held to: in how many of some runs something is so.
struct RealFigure {
  std::string name;
  std::size_t count = 0;
  std::size_t of = 0;    ///< runs that it was asked of
  bool is_floor = true;  ///< whether `bound` is the least or the most
  double bound = 0.0;    ///< in runs
  std::string target;    ///< `bound` in words
  std::vector<NotedRun> exceptions = {};

  double share() const;  ///< 0 of no runs
  bool met() const;      ///< false of no runs
};

struct RealSummary {
  std::size_t meshes = 0;
  std::size_t runs = 0;
  std::size_t ours = 0;      ///< runs that ours measured
  std::size_t arap = 0;      ///< runs that ARAP measured
  std::size_t compared = 0;  ///< runs that both did
  std::vector<RealFigure> figures;
  std::vector<NotedRun> not_run;      ///< nothing to deform
  std::vector<NotedRun> ours_failed;  ///< the default result or the linear response
  std::vector<NotedRun> arap_failed;
  /// Where Smooth ARAP has fewer flips than ours, or a largest edge or detail error less by a
  /// tenth.
  std::vector<NotedRun> smooth_arap_better;
  std::vector<NotedRun> smooth_arap_failed;
};

/// Results of ours against ARAP's are compared where both are there; detail errors are equal within
/// 1e-6. What ours failed to do does not count as settled.
RealSummary summary_of(const std::vector<RealRun>& runs);

}  // namespace lapwing::bench
