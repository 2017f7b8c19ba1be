#include <algorithm>

#include "report/growth.h"
#include "report/line_plot.h"
#include "report/measurements.h"
#include "report/plots.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kHeight = 360;
constexpr double kPeerHeight = 240;

Lines group_of(std::string_view stage) {
  const auto is_in = [&](const auto& stages) {
    return std::find(stages.begin(), stages.end(), stage) != stages.end();
  };
  if (is_in(kMeshStages) || is_in(kPreparationStages)) return Lines::preparation;
  return is_kernel(stage) ? Lines::kernels : Lines::waits;
}

const char* title_of(Lines lines) {
  switch (lines) {
    case Lines::preparation:
      return "Reading and preparing, by stages";
    case Lines::waits:
      return "What a user waits for";
    case Lines::kernels:
      return "Kernels";
  }
  return "";
}

// A stage has one color and shape in all plots of a report: those of a preparation come first, as
// in its bars; kernels, which stand alone, are counted anew.
std::size_t place_of(const Report& report, const std::string& stage) {
  std::vector<std::string> stages;
  if (!is_kernel(stage)) stages.assign(kPreparationStages.begin(), kPreparationStages.end());
  for (const Measurement& m : report.measurements) {
    const bool is_known = std::find(stages.begin(), stages.end(), m.stage) != stages.end();
    if (!is_known && is_kernel(m.stage) == is_kernel(stage)) stages.push_back(m.stage);
  }
  return static_cast<std::size_t>(std::find(stages.begin(), stages.end(), stage) - stages.begin());
}

// `name`, and how its time grows where that is known.
std::string with_growth(const Report& report, const std::string& name, const Measurement& m) {
  for (const Growth& growth : growths_of(report)) {
    if (growth.stage != m.stage || growth.by != m.by || growth.device != m.device) continue;
    const std::string words = in_words(growth);
    return name + " ~ " + words.substr(0, words.find(' '));
  }
  return name;
}

// Everything like `first`; no points where no time is known.
PlotLine line_of(const Report& report, const Measurement& first, const std::string& label) {
  PlotLine line{label, {}};
  for (const Measurement& m : report.measurements) {
    const bool belongs = m.stage == first.stage && m.by == first.by && m.device == first.device;
    if (belongs && median_ms(m) > 0.0) line.points.push_back(&m);
  }
  std::stable_sort(
      line.points.begin(), line.points.end(),
      [](const Measurement* a, const Measurement* b) { return a->vertices < b->vertices; });
  return line;
}

// The first row of every stage of ours on `device`, in the order of the report.
std::vector<const Measurement*> our_stages(const Report& report, const std::string& device) {
  std::vector<const Measurement*> first;
  for (const Measurement& m : report.measurements) {
    const bool is_known = std::any_of(first.begin(), first.end(), [&](const Measurement* other) {
      return other->stage == m.stage;
    });
    if (is_ours(m) && m.device == device && !is_known) first.push_back(&m);
  }
  return first;
}

std::optional<Svg> draw(const std::string& title, const std::vector<PlotLine>& lines, double width,
                        double height) {
  if (std::none_of(lines.begin(), lines.end(), has_two_sizes)) return std::nullopt;
  return line_plot(title, lines, width, height);
}

// One line for everyone who did a stage.
std::vector<PlotLine> rivals(const Report& report, const Measurement& ours) {
  std::vector<PlotLine> lines{line_of(report, ours, ours.by)};
  std::vector<std::string> known;
  for (const Measurement& m : report.measurements) {
    if (is_ours(m) || m.stage != ours.stage) continue;
    if (std::find(known.begin(), known.end(), m.by) != known.end()) continue;
    known.push_back(m.by);
    PlotLine line = line_of(report, m, m.by);
    line.color = line.shape = lines.size();
    line.is_dashed = true;
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::optional<Svg> scaling_plot(const Report& report, const std::string& device, Lines which,
                                double width) {
  std::vector<PlotLine> lines;
  for (const Measurement* first : our_stages(report, device)) {
    if (group_of(first->stage) != which) continue;
    const std::string& stage = first->stage;
    const std::string name = is_kernel(stage) ? stage.substr(7) : stage;
    PlotLine line = line_of(report, *first, with_growth(report, name, *first));
    const std::size_t place = place_of(report, stage);
    line.color = place % kColors;
    line.shape = place + place / kColors;  // another one when colors come round
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
  return draw(title_of(which), lines, width, kHeight);
}

std::vector<Svg> peer_plots(const Report& report, const std::string& device, double width) {
  std::vector<Svg> plots;
  for (const Measurement* first : our_stages(report, device)) {
    const std::vector<PlotLine> lines = rivals(report, *first);
    if (lines.size() < 2 || lines.front().points.empty()) continue;
    if (auto plot = draw(first->stage, lines, width, kPeerHeight))
      plots.push_back(*std::move(plot));
  }
  return plots;
}

}  // namespace lapwing::bench
