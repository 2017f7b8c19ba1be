#include "studies/real/real_summary.h"

#include <set>

#include "report/number_text.h"

namespace lapwing::bench {
namespace {

constexpr double kLeastSettled = 0.98;
constexpr double kLeastComparable = 0.95;
// Our longest edge may be so many times as long as ARAP's.
constexpr double kEdgeAllowance = 1.3;
// Bounds for the linear response alone, which a drag shows.
constexpr double kLargestDraggedEdge = 2.5;
constexpr double kMostDraggedFlips = 0.02;
// Detail errors closer than this are the same.
constexpr double kSameDetail = 1e-6;
// A measure below this share of ours counts as better.
constexpr double kClearlyLess = 0.9;

std::string full_name(const RealRun& run) {
  return run.mesh + " " + run.motion;
}

std::string ours_and_arap(double ours, double arap) {
  return short_number(ours) + ", ARAP " + short_number(arap);
}

RealFigure at_least(double share, std::string name, std::string target) {
  return {std::move(name), 0, 0, true, share, std::move(target)};
}

RealFigure at_most(double share, std::string name, std::string target) {
  return {std::move(name), 0, 0, false, share, std::move(target)};
}

// Counts one run. It is an exception if it counts against the target.
void count(RealFigure& figure, const RealRun& run, bool holds, const std::string& values) {
  ++figure.of;
  if (holds) ++figure.count;
  if (holds != figure.is_floor) figure.exceptions.push_back({full_name(run), values});
}

RealFigure settled_figure(const std::vector<RealRun>& runs) {
  RealFigure figure = at_least(kLeastSettled, "settled", "at least 98%");
  for (const RealRun& run : runs) {
    if (!run.failure.empty()) continue;
    const RealOutcome& ours = run.ours;
    count(figure, run, ours.measured && ours.settled,
          ours.measured ? std::to_string(ours.iterations) + " iterations" : ours.failure);
  }
  figure.bound *= static_cast<double>(figure.of);
  return figure;
}

bool both_measured(const RealRun& run) {
  return run.ours.measured && run.arap.measured;
}

RealFigure flips_figure(const std::vector<RealRun>& runs) {
  RealFigure figure = at_most(0.0, "with flipped triangles", "");
  std::size_t theirs = 0;
  for (const RealRun& run : runs) {
    if (!both_measured(run)) continue;
    if (run.arap.flipped_triangles > 0) ++theirs;
    count(figure, run, run.ours.flipped_triangles > 0,
          std::to_string(run.ours.flipped_triangles) + ", ARAP " +
              std::to_string(run.arap.flipped_triangles));
  }
  figure.bound = static_cast<double>(theirs);
  figure.target = "at most ARAP's " + std::to_string(theirs);
  return figure;
}

// Counts runs in which our measure is at most `factor` times ARAP's plus `more`.
RealFigure comparable_figure(const std::vector<RealRun>& runs, std::string name,
                             double RealOutcome::*measure, double factor, double more) {
  RealFigure figure = at_least(kLeastComparable, std::move(name), "at least 95%");
  for (const RealRun& run : runs) {
    if (!both_measured(run)) continue;
    const double ours = run.ours.*measure;
    const double arap = run.arap.*measure;
    count(figure, run, ours <= factor * arap + more, ours_and_arap(ours, arap));
  }
  figure.bound *= static_cast<double>(figure.of);
  return figure;
}

RealFigure edges_figure(const std::vector<RealRun>& runs) {
  return comparable_figure(runs, "largest edge within 1.3 times ARAP's", &RealOutcome::largest_edge,
                           kEdgeAllowance, 0.0);
}

RealFigure details_figure(const std::vector<RealRun>& runs) {
  return comparable_figure(runs, "detail error no worse than ARAP's", &RealOutcome::detail_error,
                           1.0, kSameDetail);
}

RealFigure dragged_edges_figure(const std::vector<RealRun>& runs) {
  RealFigure figure = at_least(1.0, "linear response alone: largest edge at most 2.5", "all");
  for (const RealRun& run : runs) {
    if (!run.linear.measured) continue;
    const double edge = run.linear.largest_edge;
    count(figure, run, edge <= kLargestDraggedEdge, short_number(edge));
  }
  figure.bound *= static_cast<double>(figure.of);
  return figure;
}

RealFigure dragged_flips_figure(const std::vector<RealRun>& runs) {
  RealFigure figure =
      at_most(kMostDraggedFlips, "linear response alone: with flipped triangles", "at most 2%");
  for (const RealRun& run : runs) {
    if (!run.linear.measured) continue;
    const std::size_t flipped = run.linear.flipped_triangles;
    count(figure, run, flipped > 0, std::to_string(flipped));
  }
  figure.bound *= static_cast<double>(figure.of);
  return figure;
}

void note_failures(const RealRun& run, RealSummary& summary) {
  const std::string name = full_name(run);
  if (!run.failure.empty()) {
    summary.not_run.push_back({name, run.failure});
    return;
  }
  if (!run.ours.failure.empty()) summary.ours_failed.push_back({name, run.ours.failure});
  if (!run.linear.failure.empty()) {
    summary.ours_failed.push_back({name, "linear response: " + run.linear.failure});
  }
  if (!run.arap.failure.empty()) summary.arap_failed.push_back({name, run.arap.failure});
  if (!run.smooth_arap.failure.empty()) {
    summary.smooth_arap_failed.push_back({name, run.smooth_arap.failure});
  }
}

void note_smooth_arap(const RealRun& run, RealSummary& summary) {
  const RealOutcome& ours = run.ours;
  const RealOutcome& theirs = run.smooth_arap;
  if (!ours.measured || !theirs.measured) return;
  std::string values;
  const auto add = [&](const char* name, const std::string& of_ours, const std::string& of_theirs) {
    values += std::string(values.empty() ? "" : "; ") + name + " " + of_ours + ", Smooth ARAP " +
              of_theirs;
  };
  if (theirs.flipped_triangles < ours.flipped_triangles) {
    add("flips", std::to_string(ours.flipped_triangles), std::to_string(theirs.flipped_triangles));
  }
  if (theirs.largest_edge < kClearlyLess * ours.largest_edge) {
    add("largest edge", short_number(ours.largest_edge), short_number(theirs.largest_edge));
  }
  if (theirs.detail_error < kClearlyLess * ours.detail_error - kSameDetail) {
    add("detail error", short_number(ours.detail_error), short_number(theirs.detail_error));
  }
  if (!values.empty()) summary.smooth_arap_better.push_back({full_name(run), values});
}

}  // namespace

double RealFigure::share() const {
  return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0.0;
}

bool RealFigure::met() const {
  // A share of runs, such as 0.95 of 20, need not be exact.
  constexpr double kRounding = 1e-9;
  const auto runs = static_cast<double>(count);
  return of > 0 && (is_floor ? runs >= bound - kRounding : runs <= bound + kRounding);
}

RealSummary summary_of(const std::vector<RealRun>& runs) {
  RealSummary summary;
  std::set<std::string> meshes;
  for (const RealRun& run : runs) {
    meshes.insert(run.mesh);
    if (run.ours.measured) ++summary.ours;
    if (run.arap.measured) ++summary.arap;
    if (both_measured(run)) ++summary.compared;
    note_failures(run, summary);
    note_smooth_arap(run, summary);
  }
  summary.meshes = meshes.size();
  summary.runs = runs.size();
  summary.figures = {settled_figure(runs), flips_figure(runs),         edges_figure(runs),
                     details_figure(runs), dragged_edges_figure(runs), dragged_flips_figure(runs)};
  return summary;
}

}  // namespace lapwing::bench
