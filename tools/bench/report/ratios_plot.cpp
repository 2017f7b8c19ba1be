#include <algorithm>

#include "report/bar_chart.h"
#include "report/measurements.h"
#include "report/number_text.h"
#include "report/plots.h"

namespace lapwing::bench {
namespace {

constexpr std::size_t kFaster = 1;  // blue
constexpr std::size_t kSlower = 6;  // red

// A stage beside one peer, as far as it has come.
struct Pairing {
  std::string stage;
  std::string peer;
  std::vector<std::pair<const Measurement*, double>> ratios;
};

std::vector<Pairing> pairings_on(const Report& report, const std::string& device) {
  std::vector<Pairing> pairings;
  for (const Measurement& m : report.measurements) {
    if (m.device != device) continue;
    for (const Measurement* peer : peers_of(report, m)) {
      const double ratio = ratio_to(m, *peer);
      if (ratio == 0.0) continue;
      auto found = std::find_if(pairings.begin(), pairings.end(), [&](const Pairing& pairing) {
        return pairing.stage == m.stage && pairing.peer == peer->by;
      });
      if (found == pairings.end()) {
        found = pairings.insert(found, Pairing{m.stage, peer->by, {}});
      }
      found->ratios.emplace_back(&m, ratio);
    }
  }
  return pairings;
}

Bar bar_of(const Pairing& pairing) {
  const auto largest = std::max_element(
      pairing.ratios.begin(), pairing.ratios.end(),
      [](const auto& a, const auto& b) { return a.first->vertices < b.first->vertices; });
  const auto& [m, ratio] = *largest;
  Bar bar{pairing.stage + " / " + pairing.peer, ratio, {}, "", ratio <= 1.0 ? kFaster : kSlower};
  bar.text =
      short_number(ratio) + "  " + m->mesh + " " + brief_count(static_cast<double>(m->vertices));
  for (const auto& other : pairing.ratios) {
    if (other.first != m) bar.marks.push_back(other.second);
  }
  return bar;
}

}  // namespace

std::optional<Svg> ratios_plot(const Report& report, double width) {
  constexpr double kRoom = 1.2;  // about the smallest and the largest, as a factor
  std::vector<BarGroup> groups;
  BarAxis axis{true, 0.5, 2.0, 1.0, 1.0, brief_count, "faster than the peer", "slower"};
  for (const std::string& device : devices_of(report)) {
    BarGroup group{"on " + device, {}};
    for (const Pairing& pairing : pairings_on(report, device)) {
      group.bars.push_back(bar_of(pairing));
      for (const auto& [m, ratio] : pairing.ratios) {
        axis.from = std::min(axis.from, ratio / kRoom);
        axis.to = std::max(axis.to, ratio * kRoom);
      }
    }
    if (!group.bars.empty()) groups.push_back(std::move(group));
  }
  if (groups.empty()) return std::nullopt;
  return bar_chart("Our time over others' (bar: largest mesh; marks: the others)", groups, axis,
                   width);
}

}  // namespace lapwing::bench
