#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

enum class Verdict { same, better, worse };

/// What makes a measurement of one report that of another, compared in this order.
struct RowKey {
  std::string device;
  std::string mesh;
  std::size_t vertices = 0;
  std::string stage;
  std::string by;
  auto operator<=>(const RowKey&) const = default;
};

/// One number that is better or worse than it was.
struct Change {
  RowKey row;
  std::string what;  ///< "wall ms" or "device ms" (medians), or a count's name
  double before = 0;
  double after = 0;
  Verdict verdict = Verdict::same;
};

/// A row, or a count of one, that is in one of the reports only.
struct Missing {
  RowKey row;
  std::string count;       ///< "" for the whole row
  bool was_there = false;  ///< before, and is not any more; the other way round otherwise
  bool fails = false;      ///< counts were there before and are not any more
};

struct CompareOptions {
  bool times = true;  ///< judge times too, not counts alone
  /// By name, by what share of the old number a count may rise or fall and still be the same.
  std::map<std::string, double> count_tolerances;
};

/// What changed between two reports.
struct Comparison {
  std::vector<Change> changes;  ///< worse ones first
  std::vector<Missing> missing;
  std::vector<std::string> notes;  ///< on what could not be judged and why, a sentence each
  std::size_t same_counts = 0;
  std::size_t same_times = 0;
  Verdict verdict = Verdict::same;  ///< worse if anything is, else better if anything is
};

/// Compares measurement by measurement.
///
/// Counts have to be equal: one that rose, or that is not counted any more, is worse; one that fell
/// is better; one that was not counted before is not judged.
///
/// A time, wall and device apart, changed only if all of these hold:
/// - by a two-sided Mann-Whitney test of the runs p < 0.01, and p is small enough beside those of
/// all
///   times that are compared, by Benjamini and Hochberg, that of the times called changed at most
///   one in twenty is by chance;
/// - the medians differ by more than 5%;
/// - and by more than the distance between the quartiles of either report: two processes differ by
///   more (where memory lies, how warm the processor is) than runs in one do.
/// Where the device's limits differ by more than 10% (another machine of the same kind, or a busy
/// one), it also has to hold of time x copy rate and of time x each rate of products: work that
/// slowed down as much as one of its limits did is the same work. Between two processors, or
/// different numbers of threads, no times are judged. The notes say which of these happened.
///
/// Throws InputError when a report measures a row twice.
Comparison compare(const Report& before, const Report& after, const CompareOptions& options = {});

/// A table of what changed, how much did not, what could not be judged, and the verdict as the last
/// line; at most 100 columns.
std::string text_of(const Comparison& comparison);

}  // namespace lapwing::bench
