#include "studies/real/real_table.h"

#include <array>
#include <cstdio>
#include <map>

#include "lapwing/base/grouped.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

// Widths in characters.
constexpr std::size_t kMesh = 38;
constexpr std::size_t kMotion = 6;
constexpr std::size_t kCount = 7;
constexpr std::size_t kIterations = 6;
constexpr std::size_t kFlips = 6;
constexpr std::size_t kRatioCell = 8;
constexpr std::size_t kTime = 9;
constexpr std::size_t kSettledGroup = kIterations + kFlips + 3 * kRatioCell + kTime;
constexpr std::size_t kLinearGroup = kFlips + 3 * kRatioCell;

std::string iterations_of(const RealOutcome& outcome) {
  return std::to_string(outcome.iterations) + (outcome.settled ? "" : "*");
}

// Prints values below 1 with four decimals, others with three digits.
std::string ratio_text(double value) {
  constexpr double kMostPrinted = 99'999.0;
  if (value > kMostPrinted) return ">99,999";
  if (value >= 1.0) return short_number(value);
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "%.4f", value);
  return text.data();
}

// Without runs, a target is neither met nor missed.
std::string verdict_of(const RealFigure& figure) {
  return figure.of == 0 ? "-" : figure.met() ? "met" : "NOT met";
}

std::string shape_cells(const RealOutcome& outcome) {
  return padded_left(std::to_string(outcome.flipped_triangles), kFlips) +
         padded_left(ratio_text(outcome.largest_edge), kRatioCell) +
         padded_left(ratio_text(outcome.detail_error), kRatioCell) +
         padded_left(ratio_text(outcome.edge_stretch), kRatioCell);
}

std::string settled_cells(const RealOutcome& outcome) {
  if (!outcome.measured) return padded_left("-", kSettledGroup);
  return padded_left(iterations_of(outcome), kIterations) + shape_cells(outcome) +
         padded_left(short_number(outcome.solve_ms), kTime);
}

std::string linear_cells(const RealOutcome& outcome) {
  return outcome.measured ? shape_cells(outcome) : padded_left("-", kLinearGroup);
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

// Shortens a path in front, because its end says more.
std::string clipped_in_front(const std::string& path) {
  if (character_count(path) < kMesh) return path;
  return "..." + path.substr(path.size() - (kMesh - 4));
}

std::string titles(std::size_t first, const char* first_title) {
  return padded_left(first_title, first) + padded_left("largest", kRatioCell) +
         padded_left("detail", kRatioCell) + padded_left("stretch", kRatioCell);
}

std::string count_of(const RealFigure& figure) {
  if (figure.of == 0) return "no runs";
  return std::to_string(figure.count) + " of " + std::to_string(figure.of) + " (" +
         percent(figure.share()) + ")";
}

std::string noted_lines(const std::vector<NotedRun>& noted) {
  std::string text;
  for (const NotedRun& one : noted) text += "      " + one.run + ": " + one.values + "\n";
  return text;
}

std::string noted_block(const char* title, const std::vector<NotedRun>& noted) {
  if (noted.empty()) return "";
  return "\n  " + std::string(title) + " (" + std::to_string(noted.size()) + ")\n" +
         noted_lines(noted);
}

std::string counted_runs(const RealSummary& summary) {
  return std::to_string(summary.runs) + " runs of " + std::to_string(summary.meshes) +
         " meshes; ours did " + std::to_string(summary.ours) + ", ARAP " +
         std::to_string(summary.arap) + ", both " + std::to_string(summary.compared);
}

// Names files whose reason is unique, and counts files that share one.
std::string passed_over_lines(const std::vector<PassedOver>& files) {
  if (files.empty()) return "";
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const PassedOver& file : files) by_reason[file.reason].push_back(file.mesh);
  std::string text = "\n  files that are no subjects (" + std::to_string(files.size()) + ")\n";
  for (const auto& [reason, meshes] : by_reason) {
    const std::size_t count = meshes.size();
    text += "      " + (count > 1 ? std::to_string(count) + " files" : meshes.front()) + ": " +
            reason + "\n";
  }
  return text;
}

std::string markdown_shape(const RealOutcome& outcome) {
  if (!outcome.measured) return "|  |  |  ";
  return "| " + std::to_string(outcome.flipped_triangles) + " | " +
         ratio_text(outcome.largest_edge) + " | " + ratio_text(outcome.detail_error) + " ";
}

std::string markdown_row(const RealRun& run) {
  std::string text = "| " + run.mesh + " | " + run.motion + " | " + grouped(run.vertices) + " | " +
                     (run.left_out > 0 ? grouped(run.left_out) : "") + " ";
  text += "| " + (run.ours.measured ? iterations_of(run.ours) : "") + " " +
          markdown_shape(run.ours) + markdown_shape(run.linear) + markdown_shape(run.arap) +
          markdown_shape(run.smooth_arap);
  return text + "| " + reasons_of(run) + " |\n";
}

}  // namespace

std::string real_heading() {
  const std::size_t names = kMesh + kMotion + 2 * kCount;
  std::string text = padded_right("", names) + "  " + padded_right("   ours", kSettledGroup) +
                     "  " + padded_right("   linear alone", kLinearGroup) + "  " +
                     padded_right("   ARAP", kSettledGroup) + "  " + "   Smooth ARAP\n";
  text += padded_right("mesh", kMesh) + padded_right("motion", kMotion) + padded_left("n", kCount) +
          padded_left("out", kCount);
  const std::string settled = titles(kFlips, "flips");
  const std::string whole =
      "  " + padded_left("iter", kIterations) + settled + padded_left("ms", kTime);
  return text + whole + "  " + settled + whole + whole + "\n";
}

std::string line_of(const RealRun& run) {
  std::string text = padded_right(clipped_in_front(run.mesh), kMesh) +
                     padded_right(run.motion, kMotion) +
                     padded_left(std::to_string(run.vertices), kCount) +
                     padded_left(std::to_string(run.left_out), kCount);
  text += "  " + settled_cells(run.ours) + "  " + linear_cells(run.linear) + "  " +
          settled_cells(run.arap) + "  " + settled_cells(run.smooth_arap);
  const std::string reasons = reasons_of(run);
  return text + (reasons.empty() ? "" : "  " + reasons) + "\n";
}

std::string text_of(const RealReport& report) {
  const RealSummary summary = summary_of(report.runs);
  std::string text = counted_runs(summary) + "\n";
  for (const RealFigure& figure : summary.figures) {
    text += "\n  " + padded_right(verdict_of(figure), 9) + figure.name + ": " + count_of(figure) +
            ", " + figure.target + "\n" + noted_lines(figure.exceptions);
  }
  text += noted_block("nothing to deform", summary.not_run);
  text += noted_block("ours failed", summary.ours_failed);
  text += noted_block("CGAL failed", summary.arap_failed);
  text += noted_block("Smooth ARAP failed", summary.smooth_arap_failed);
  text += noted_block("Smooth ARAP is better than ours", summary.smooth_arap_better);
  return text + passed_over_lines(report.passed_over);
}

std::string markdown_of(const RealReport& report) {
  const RealSummary summary = summary_of(report.runs);
  std::string text = counted_runs(summary) + ".\n\n| | runs | target | |\n|---|---|---|---|\n";
  for (const RealFigure& figure : summary.figures) {
    text += "| " + figure.name + " | " + count_of(figure) + " | " + figure.target + " | " +
            verdict_of(figure) + " |\n";
  }
  text +=
      "\n| mesh | motion | vertices | left out | iterations | flips | largest | detail "
      "| linear: flips | largest | detail | ARAP: flips | largest | detail "
      "| Smooth ARAP: flips | largest | detail | not there |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n";
  for (const RealRun& run : report.runs) text += markdown_row(run);
  return text;
}

}  // namespace lapwing::bench
