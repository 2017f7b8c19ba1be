#include "report/compare.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/errors.h"
#include "report/compare_times.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

using Rows = std::map<RowKey, const Measurement*>;

Rows rows_of(const Report& report) {
  Rows rows;
  for (const Measurement& m : report.measurements) {
    if (rows.emplace(RowKey{m.device, m.mesh, m.vertices, m.stage, m.by}, &m).second) continue;
    throw InputError("the report of " + report.date + " measures \"" + m.stage + "\" by " + m.by +
                     " on " + m.device + ", " + m.mesh + " of " + grouped(m.vertices) +
                     " vertices, twice; remove one of the two");
  }
  return rows;
}

void compare_counts(const RowPair& row, const CompareOptions& options, Comparison& comparison) {
  const Counts& after = row.after->counts;
  for (const auto& [name, count] : row.before->counts) {
    const auto found = after.find(name);
    if (found == after.end()) {
      comparison.missing.push_back({row.key, name, true, true});
      continue;
    }
    const auto tolerance = options.count_tolerances.find(name);
    const double share = tolerance == options.count_tolerances.end() ? 0.0 : tolerance->second;
    const auto old_count = static_cast<double>(count);
    const auto new_count = static_cast<double>(found->second);
    if (std::abs(new_count - old_count) <= share * old_count) {
      ++comparison.same_counts;
    } else {
      const Verdict verdict = new_count > old_count ? Verdict::worse : Verdict::better;
      comparison.changes.push_back({row.key, name, old_count, new_count, verdict});
    }
  }
}

// The rows of both reports; those of one alone are noted.
std::vector<RowPair> pair_rows(const Rows& before, const Rows& after, Comparison& comparison) {
  std::vector<RowPair> pairs;
  for (const auto& [key, old_row] : before) {
    const auto found = after.find(key);
    if (found != after.end()) {
      pairs.push_back({key, old_row, found->second});
    } else {
      comparison.missing.push_back({key, "", true, !old_row->counts.empty()});
    }
  }
  for (const auto& [key, new_row] : after) {
    if (!before.contains(key)) comparison.missing.push_back({key, "", false, false});
  }
  return pairs;
}

Verdict verdict_of(const Comparison& comparison) {
  const bool fails = std::any_of(comparison.missing.begin(), comparison.missing.end(),
                                 [](const Missing& missing) { return missing.fails; });
  const auto changed = [&](Verdict verdict) {
    return std::any_of(comparison.changes.begin(), comparison.changes.end(),
                       [&](const Change& change) { return change.verdict == verdict; });
  };
  if (fails || changed(Verdict::worse)) return Verdict::worse;
  return changed(Verdict::better) ? Verdict::better : Verdict::same;
}

}  // namespace

Comparison compare(const Report& before, const Report& after, const CompareOptions& options) {
  Comparison comparison;
  const std::vector<RowPair> rows = pair_rows(rows_of(before), rows_of(after), comparison);
  for (const RowPair& row : rows) compare_counts(row, options, comparison);
  if (options.times) compare_times(before, after, rows, comparison);
  std::stable_sort(comparison.changes.begin(), comparison.changes.end(),
                   [](const Change& a, const Change& b) { return a.verdict > b.verdict; });
  comparison.verdict = verdict_of(comparison);
  return comparison;
}

}  // namespace lapwing::bench
