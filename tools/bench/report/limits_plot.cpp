#include <algorithm>
#include <cmath>

#include "report/bar_chart.h"
#include "report/measurements.h"
#include "report/number_text.h"
#include "report/plots.h"

namespace lapwing::bench {
namespace {

// One bar for a stage of ours and for everyone else who did it, of those that have a share.
std::vector<Bar> bars_on(const Report& report, const std::string& device) {
  std::vector<Bar> bars;
  std::vector<std::size_t> sizes;  // of the mesh that a bar is about
  for (const Measurement& m : report.measurements) {
    const double share = m.device == device ? share_of_limit(report, m) : 0.0;
    if (share <= 0.0) continue;
    const std::string label = is_ours(m) ? m.stage : m.stage + ", " + m.by;
    const auto found =
        std::find_if(bars.begin(), bars.end(), [&](const Bar& bar) { return bar.label == label; });
    const auto at = static_cast<std::size_t>(found - bars.begin());
    if (found == bars.end()) {
      bars.push_back({label, 0.0, {}, "", is_ours(m) ? 2U : 9U});
      sizes.push_back(0);
    } else if (m.vertices <= sizes[at]) {
      bars[at].marks.push_back(share);
      continue;
    } else {
      bars[at].marks.push_back(bars[at].value);
    }
    sizes[at] = m.vertices;
    bars[at].value = share;
    bars[at].text =
        percent(share) + "  " + m.mesh + " " + brief_count(static_cast<double>(m.vertices));
  }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return bars;
}

std::string tick_text(double share) {
  return std::to_string(std::lround(100.0 * share)) + "%";
}

}  // namespace

std::optional<Svg> limits_plot(const Report& report, double width) {
  std::vector<BarGroup> groups;
  constexpr double kShown = 1.5;  // small meshes live in caches, and would squeeze the others
  BarAxis axis{false, 0.0, 1.05, 0.0, 1.0, tick_text, "of the device's rate of copies or products",
               ""};
  for (const std::string& device : devices_of(report)) {
    BarGroup group{"on " + device, bars_on(report, device)};
    for (const Bar& bar : group.bars) {
      axis.to = std::max(axis.to, 1.05 * bar.value);
      for (const double mark : bar.marks) axis.to = std::max(axis.to, 1.05 * mark);
    }
    if (!group.bars.empty()) groups.push_back(std::move(group));
  }
  if (groups.empty()) return std::nullopt;
  axis.to = std::min(axis.to, kShown);
  return bar_chart("Share of what the device can do (bar: largest mesh; marks: the others)", groups,
                   axis, width);
}

}  // namespace lapwing::bench
