#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <set>

#include "report/number_text.h"
#include "studies/real_report.h"

namespace lapwing::bench {
namespace {

// Detail errors closer than this are the same.
constexpr double kSameDetail = 1e-6;
// A measure is better if it is less than this factor times the other.
constexpr double kClearlyLess = 0.9;

std::string full_name(const RealRun& run) {
  return run.mesh + " " + run.motion;
}

bool both_measured(const RealRun& run) {
  return run.ours.measured && run.arap.measured;
}

bool linear_measured(const RealRun& run) {
  return run.linear.measured;
}

// Counts the runs to which a figure applies and the runs in which it holds. `figure.bound` is the
// required fraction of the former. The runs that count against the target become exceptions, with
// their `values`.
RealFigure counted(RealFigure figure, const std::vector<RealRun>& runs,
                   const std::function<bool(const RealRun&)>& applies,
                   const std::function<bool(const RealRun&)>& holds,
                   const std::function<std::string(const RealRun&)>& values) {
  for (const RealRun& run : runs) {
    if (!applies(run)) continue;
    ++figure.of;
    if (holds(run)) ++figure.count;
    if (holds(run) != figure.is_floor) figure.exceptions.push_back({full_name(run), values(run)});
  }
  figure.bound *= static_cast<double>(figure.of);
  return figure;
}

RealFigure settled_figure(const std::vector<RealRun>& runs) {
  return counted(
      {"settled", "at least 98%", true, 0.98}, runs,
      [](const RealRun& run) { return run.failure.empty(); },
      [](const RealRun& run) { return run.ours.measured && run.ours.settled; },
      [](const RealRun& run) {
        return run.ours.measured ? std::to_string(run.ours.iterations) + " iterations"
                                 : run.ours.failure;
      });
}

RealFigure flips_figure(const std::vector<RealRun>& runs) {
  RealFigure figure = counted(
      {"with flipped triangles", "", false}, runs, both_measured,
      [](const RealRun& run) { return run.ours.flipped_triangles > 0; },
      [](const RealRun& run) {
        return std::to_string(run.ours.flipped_triangles) + ", ARAP " +
               std::to_string(run.arap.flipped_triangles);
      });
  std::size_t theirs = 0;
  for (const RealRun& run : runs) {
    if (both_measured(run) && run.arap.flipped_triangles > 0) ++theirs;
  }
  figure.bound = static_cast<double>(theirs);
  figure.target = "at most ARAP's " + std::to_string(theirs);
  return figure;
}

// Counts runs in which our measure is at most `factor` times ARAP's plus `more`.
RealFigure comparable_figure(const std::vector<RealRun>& runs, const char* name,
                             double RealOutcome::*measure, double factor, double more) {
  return counted(
      {name, "at least 95%", true, 0.95}, runs, both_measured,
      [=](const RealRun& run) { return run.ours.*measure <= factor * (run.arap.*measure) + more; },
      [=](const RealRun& run) {
        return short_number(run.ours.*measure) + ", ARAP " + short_number(run.arap.*measure);
      });
}

RealFigure dragged_edges_figure(const std::vector<RealRun>& runs) {
  constexpr double kLargest = 2.5;
  return counted(
      {"linear response alone: largest edge at most 2.5", "all", true, 1.0}, runs, linear_measured,
      [](const RealRun& run) { return run.linear.largest_edge <= kLargest; },
      [](const RealRun& run) { return short_number(run.linear.largest_edge); });
}

RealFigure dragged_flips_figure(const std::vector<RealRun>& runs) {
  return counted(
      {"linear response alone: with flipped triangles", "at most 2%", false, 0.02}, runs,
      linear_measured, [](const RealRun& run) { return run.linear.flipped_triangles > 0; },
      [](const RealRun& run) { return std::to_string(run.linear.flipped_triangles); });
}

// Returns the totals of a method, and in how many runs it is better or worse than Lapwing.
std::string totals_of(const std::vector<RealRun>& runs, const std::string& name,
                      RealOutcome RealRun::*method) {
  const auto count = [&](const auto& holds) {
    return std::to_string(std::count_if(runs.begin(), runs.end(), [&](const RealRun& run) {
      return (run.*method).measured && run.ours.measured && holds(run.*method, run.ours);
    }));
  };
  // Returns "better / worse" for a measure.
  const auto beside = [&](auto measure) {
    const auto less = [=](const RealOutcome& a, const RealOutcome& b) {
      return static_cast<double>(a.*measure) <
             kClearlyLess * static_cast<double>(b.*measure) - kSameDetail;
    };
    return count(less) + " / " + count([=](const auto& a, const auto& b) { return less(b, a); });
  };
  double error = 0.0;
  for (const RealRun& run : runs) error = std::max(error, (run.*method).constraint_error);
  std::string text =
      "  " + name + ": " + count([](const auto&, const auto&) { return true; }) + " edits, " +
      count([](const auto& a, const auto&) { return a.settled; }) + " settled, " +
      count([](const auto& a, const auto&) { return a.flipped_triangles > 0; }) +
      " with flipped triangles, constraints within " + short_number(100.0 * error) + "%\n";
  if (method == &RealRun::ours) return text;
  return text + "      better / worse than Lapwing by a tenth: flips " +
         beside(&RealOutcome::flipped_triangles) + ", largest edge " +
         beside(&RealOutcome::largest_edge) + ", detail error " +
         beside(&RealOutcome::detail_error) + "\n";
}

// Returns the reasons for missing results.
std::string reasons_of(const RealRun& run) {
  if (!run.failure.empty()) return run.failure;
  std::string text;
  const auto add = [&](const char* who, const std::string& failure) {
    if (!failure.empty()) text += (text.empty() ? "" : "; ") + std::string(who) + ": " + failure;
  };
  add("ours", run.ours.failure);
  add("linear", run.linear.failure);
  add("CGAL", run.arap.failure);
  add("Smooth ARAP", run.smooth_arap.failure);
  return text;
}

// Widths in characters.
constexpr std::size_t kMesh = 20;
constexpr std::size_t kMotion = 5;
constexpr std::size_t kFlips = 6;
constexpr std::size_t kEdge = 5;
constexpr std::size_t kMeasure = 7;
constexpr std::size_t kMethod = kFlips + kEdge + 2 * kMeasure;

// Prints values below 1 with four decimals, others with three digits. Large values do not exceed
// the `width` of a column.
std::string ratio_text(double value, std::size_t width) {
  if (value >= 1'000.0) return padded_left(">999", width);
  if (value >= 1.0) return padded_left(short_number(value), width);
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "%.4f", value);
  return padded_left(text.data(), width);
}

// Returns the table cells of one method.
std::string cells(const RealOutcome& outcome) {
  if (!outcome.measured) return padded_left("-", kMethod);
  const std::string star = outcome.settled ? "" : "*";
  return padded_left(star + std::to_string(outcome.flipped_triangles), kFlips) +
         ratio_text(outcome.largest_edge, kEdge) + ratio_text(outcome.detail_error, kMeasure) +
         padded_left(short_number(outcome.solve_ms), kMeasure);
}

// Shortens a path in front, because its end says more.
std::string clipped_in_front(const std::string& path) {
  if (path.size() < kMesh) return path;
  return "..." + path.substr(path.size() - (kMesh - 4));
}

std::string noted_lines(const std::vector<Noted>& noted) {
  std::string text;
  for (const Noted& one : noted) text += "      " + one.name + ": " + one.why + "\n";
  return text;
}

// Names files whose reason is unique, and counts files that share one.
std::vector<Noted> by_reason(const std::vector<Noted>& files) {
  std::map<std::string, std::vector<std::string>> names;
  for (const Noted& file : files) names[file.why].push_back(file.name);
  std::vector<Noted> noted;
  for (const auto& [why, of] : names) {
    noted.push_back({of.size() > 1 ? std::to_string(of.size()) + " files" : of.front(), why});
  }
  return noted;
}

}  // namespace

bool RealFigure::met() const {
  // A fraction of the runs, such as 0.95 * 20, is subject to rounding.
  constexpr double kRounding = 1e-9;
  const auto runs = static_cast<double>(count);
  return of > 0 && (is_floor ? runs >= bound - kRounding : runs <= bound + kRounding);
}

RealSummary summary_of(const std::vector<RealRun>& runs) {
  RealSummary summary;
  summary.runs = runs.size();
  std::set<std::string> meshes;
  for (const RealRun& run : runs) {
    meshes.insert(run.mesh);
    if (both_measured(run)) ++summary.compared;
    const std::string reasons = reasons_of(run);
    if (!reasons.empty()) summary.failures.push_back({full_name(run), reasons});
  }
  summary.meshes = meshes.size();
  summary.figures = {settled_figure(runs),
                     flips_figure(runs),
                     comparable_figure(runs, "largest edge within 1.3 times ARAP's",
                                       &RealOutcome::largest_edge, 1.3, 0.0),
                     comparable_figure(runs, "detail error no worse than ARAP's",
                                       &RealOutcome::detail_error, 1.0, kSameDetail),
                     dragged_edges_figure(runs),
                     dragged_flips_figure(runs)};
  return summary;
}

std::string real_heading() {
  std::string groups = padded_right("*: did not settle", kMesh + kMotion);
  std::string titles = padded_right("mesh", kMesh + kMotion);
  for (const char* method : {"Lapwing", "ARAP", "Smooth ARAP"}) {
    groups += padded_left(method, kMethod);
    titles += padded_left("flips", kFlips) + padded_left("edge", kEdge) +
              padded_left("detail", kMeasure) + padded_left("ms", kMeasure);
  }
  return groups + "\n" + titles + "\n";
}

std::string line_of(const RealRun& run) {
  const std::string reasons = reasons_of(run);
  return padded_right(clipped_in_front(run.mesh), kMesh) + padded_right(run.motion, kMotion) +
         cells(run.ours) + cells(run.arap) + cells(run.smooth_arap) +
         (reasons.empty() ? "" : "\n      " + reasons) + "\n";
}

std::string text_of(const RealReport& report) {
  const RealSummary summary = summary_of(report.runs);
  std::string text = std::to_string(summary.runs) + " runs of " + std::to_string(summary.meshes) +
                     " meshes, " + std::to_string(summary.compared) + " compared with ARAP\n";
  for (const RealFigure& figure : summary.figures) {
    const double share = static_cast<double>(figure.count) / static_cast<double>(figure.of);
    // Without runs, a target is neither met nor missed.
    const char* const verdict = figure.of == 0 ? "-" : figure.met() ? "met" : "NOT met";
    text += "\n  " + padded_right(verdict, 9) + figure.name + ": " +
            (figure.of == 0 ? "no runs"
                            : std::to_string(figure.count) + " of " + std::to_string(figure.of) +
                                  " (" + percent(share) + ")") +
            ", " + figure.target + "\n" + noted_lines(figure.exceptions);
  }
  text += "\n" + totals_of(report.runs, "Lapwing", &RealRun::ours) +
          totals_of(report.runs, "ARAP", &RealRun::arap) +
          totals_of(report.runs, "Smooth ARAP", &RealRun::smooth_arap);
  if (!summary.failures.empty()) text += "\n  failures\n" + noted_lines(summary.failures);
  if (!report.passed_over.empty()) {
    text += "\n  files that are no subjects\n" + noted_lines(by_reason(report.passed_over));
  }
  return text;
}

}  // namespace lapwing::bench
