#include "report/table.h"

#include <algorithm>

#include "lapwing/base/grouped.h"
#include "report/growth.h"
#include "report/measurements.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

// Widths in characters.
constexpr std::size_t kStage = 30;
constexpr std::size_t kNumber = 8;
constexpr std::size_t kSpread = 8;
constexpr std::size_t kLimit = 6;
constexpr std::size_t kRatio = kTerminalLine - 2 - kStage - 4 * kNumber - kSpread - kLimit;

std::string median_cell(const std::vector<double>& ms) {
  return padded_left(ms.empty() ? "-" : short_number(spread_of(ms).median), kNumber);
}

// Half the distance between the quartiles, as a share of the median.
std::string spread_cell(const std::vector<double>& ms) {
  const Spread spread = spread_of(ms);
  const bool is_known = ms.size() > 1 && spread.median > 0.0;
  const double share = is_known ? (spread.high - spread.low) / 2.0 / spread.median : 0.0;
  return padded_left(is_known ? "+-" + percent(share) : "", kSpread);
}

std::string row_name(const Measurement& m) {
  return is_ours(m) ? m.stage : m.stage + ", " + m.by;
}

// One ratio per line: the first ends the row, the others follow below it.
std::string ratio_cells(const Report& report, const Measurement& m, std::size_t indent) {
  std::string text;
  for (const Measurement* peer : peers_of(report, m)) {
    const double ratio = ratio_to(m, *peer);
    if (ratio == 0.0) continue;
    if (!text.empty()) text += "\n" + std::string(indent, ' ');
    text += "  " + clipped(short_number(ratio) + " of " + peer->by, kRatio - 2);
  }
  return text;
}

std::string row(const Report& report, const Measurement& m) {
  const double share = share_of_limit(report, m);
  std::string text = "  " + padded_right(clipped(row_name(m), kStage), kStage);
  text += median_cell(m.wall_ms) + spread_cell(clock_of(m));
  text += median_cell(m.cpu_ms) + median_cell(m.device_ms);
  const auto megabytes = (m.peak_bytes + 500'000) / 1'000'000;
  text += padded_left(m.peak_bytes > 0 ? grouped(megabytes) : "-", kNumber);
  text += padded_left(share > 0.0 ? percent(share) : "-", kLimit);
  return text + ratio_cells(report, m, character_count(text)) + "\n";
}

std::string block(const Report& report, const Measurement& subject, const std::string& device) {
  std::string rows;
  for (const Measurement& m : report.measurements) {
    if (same_subject(m, subject) && m.device == device) rows += row(report, m);
  }
  if (rows.empty()) return "";
  const std::string heading =
      subject.mesh + ", " + grouped(subject.vertices) + " vertices, on " + device;
  return clipped(heading, kTerminalLine) + "\n  " + padded_right("ms", kStage) +
         padded_left("median", kNumber) + padded_left("spread", kSpread) +
         padded_left("cpu", kNumber) + padded_left("device", kNumber) +
         padded_left("peak MB", kNumber) + padded_left("limit", kLimit) + "  ratio\n" + rows + "\n";
}

std::string blocks(const Report& report) {
  std::string text;
  for (const Measurement* subject : subjects_of(report)) {
    for (const std::string& device : devices_of(report)) text += block(report, *subject, device);
  }
  return text;
}

// Prints each item by `line` under its heading. Headings keep the order of their first items.
template <class Item>
std::string grouped_lines(const std::vector<Item>& items, std::string Item::*heading,
                          std::string (*line)(const Item&)) {
  std::string text;
  std::vector<std::string> done;
  for (const Item& first : items) {
    if (std::find(done.begin(), done.end(), first.*heading) != done.end()) continue;
    done.push_back(first.*heading);
    text += "  " + clipped(first.*heading, kTerminalLine - 2) + "\n";
    for (const Item& item : items) {
      if (item.*heading == first.*heading) text += line(item);
    }
  }
  return text;
}

std::string line_of(const Growth& growth) {
  const std::string name = growth.by == kOurselves ? growth.stage : growth.stage + ", " + growth.by;
  return "    " + padded_right(clipped(name, 44), 46) + padded_right(in_words(growth), 20) +
         std::to_string(growth.sizes) + " sizes\n";
}

std::string line_of(const Target& target) {
  return "    " + padded_right(target.met() ? "met" : "NOT met", 9) +
         padded_right(clipped(target.name, 54), 56) +
         padded_left(short_number(target.measured), 9) +
         (target.is_floor ? ", at least " : ", at most ") + short_number(target.at_most) + "\n";
}

std::string growth_lines(const Report& report) {
  const std::vector<Growth> growths = growths_of(report);
  if (growths.empty()) return "";
  return "Growth with the number of vertices n\n" +
         grouped_lines(growths, &Growth::device, line_of) + "\n";
}

std::string target_lines(const Report& report) {
  if (report.targets.empty()) return "";
  return "Targets\n" + grouped_lines(report.targets, &Target::on, line_of) + "\n";
}

std::string limit_lines(const Report& report) {
  std::string text;
  for (const Limits& limits : report.limits) {
    text += clipped(limits.device, 32) + " (" + limits.type + "): copies " +
            short_number(limits.copy_gb_per_s) + " GB/s, multiplies matrices at " +
            short_number(limits.matmul_gflops_float64) + " GFLOP/s\n";
  }
  return text.empty() ? "" : text + "\n";
}

}  // namespace

std::string table_of(const Report& report) {
  return limit_lines(report) + blocks(report) + growth_lines(report) + target_lines(report);
}

}  // namespace lapwing::bench
