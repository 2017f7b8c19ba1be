#include <algorithm>
#include <array>

#include "report/measurements.h"
#include "report/number_text.h"
#include "report/plots.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kBarHeight = 19;
constexpr double kRowHeight = 25;
constexpr double kLegendHeight = 18;
constexpr double kSwatch = 10;
constexpr double kStagesTitle = 24;

// One preparation.
struct Preparation {
  std::string label;
  std::array<double, kPreparationStages.size()> ms{};  // 0: not measured
  double sum = 0;
};

// The stage's row on `device`, else on the processor.
const Measurement* row_of(const Report& report, const Measurement& subject, std::string_view stage,
                          const std::string& device) {
  const Measurement* found = nullptr;
  for (const Measurement& m : report.measurements) {
    if (!is_ours(m) || m.stage != stage || !same_subject(m, subject)) continue;
    if (m.device == device) return &m;
    if (m.device == kHostDevice) found = &m;
  }
  return found;
}

bool has_part_of_preparation(const Report& report, const Measurement& subject,
                             const std::string& device) {
  return std::any_of(kPreparationStages.begin(), kPreparationStages.end(), [&](auto stage) {
    const Measurement* const row = row_of(report, subject, stage, device);
    return row != nullptr && row->device == device;
  });
}

std::vector<Preparation> preparations_of(const Report& report, const std::string& device) {
  std::vector<Preparation> preparations;
  for (const Measurement* subject : subjects_of(report)) {
    if (!has_part_of_preparation(report, *subject, device)) continue;
    Preparation preparation;
    preparation.label = subject->mesh + " " + brief_count(static_cast<double>(subject->vertices));
    for (std::size_t k = 0; k < kPreparationStages.size(); ++k) {
      const Measurement* const row = row_of(report, *subject, kPreparationStages[k], device);
      if (row == nullptr) continue;
      preparation.ms[k] = median_ms(*row);
      preparation.sum += preparation.ms[k];
    }
    if (preparation.sum > 0.0) preparations.push_back(std::move(preparation));
  }
  return preparations;
}

// Returns where the legend ends.
double draw_legend(const std::vector<Preparation>& preparations, Svg& svg) {
  Point at{0, kStagesTitle};
  for (std::size_t k = 0; k < kPreparationStages.size(); ++k) {
    const bool is_used = std::any_of(preparations.begin(), preparations.end(),
                                     [&](const Preparation& p) { return p.ms[k] > 0.0; });
    if (!is_used) continue;
    const double width = kSwatch + 5 + text_width(kPreparationStages[k]) + 12;
    if (at.x + width > svg.width()) at = {0, at.y + kLegendHeight};
    svg.rectangle(at, kSwatch, kSwatch, bar_class(k));
    svg.text({at.x + kSwatch + 5, at.y + 9}, kPreparationStages[k], "ink", Anchor::start);
    at.x += width;
  }
  return at.y + kLegendHeight + 4;
}

// The longest text about a stage that fits into its part of a bar.
std::string text_within(std::string_view stage, double ms, double width) {
  const std::string number = short_number(ms);
  for (const std::string& text : {std::string(stage) + " " + number, number}) {
    if (text_width(text) + 4 <= width) return text;
  }
  return "";
}

void draw_bar(const Preparation& preparation, double left, double right, double top, Svg& svg) {
  double x = left;
  for (std::size_t k = 0; k < kPreparationStages.size(); ++k) {
    const double share = preparation.ms[k] / preparation.sum;
    const double width = share * (right - left);
    if (width <= 0.0) continue;
    const auto stage = kPreparationStages[k];
    svg.rectangle(
        {x, top}, width, kBarHeight, bar_class(k),
        std::string(stage) + ": " + short_number(preparation.ms[k]) + " ms, " + percent(share));
    svg.text({x + width / 2, top + kBarHeight - 5.5}, text_within(stage, preparation.ms[k], width),
             on_bar_class(k), Anchor::middle);
    x += width;
  }
}

}  // namespace

std::optional<Svg> stages_plot(const Report& report, const std::string& device, double width) {
  const std::vector<Preparation> preparations = preparations_of(report, device);
  if (preparations.empty()) return std::nullopt;
  double left = 0.0;
  double right = 0.0;
  for (const Preparation& p : preparations) {
    left = std::max(left, text_width(p.label) + 8);
    right = std::max(right, text_width(short_number(p.sum) + " ms") + 8);
  }
  const auto count = static_cast<double>(preparations.size());
  Svg sized(width, 0);
  const double top = draw_legend(preparations, sized);
  Svg svg(width, top + count * kRowHeight);
  svg.text({0, 13}, "What a preparation consists of (ms, and as a share)", "heading",
           Anchor::start);
  draw_legend(preparations, svg);
  double y = top;
  for (const Preparation& p : preparations) {
    svg.text({left - 8, y + kBarHeight - 5}, p.label, "ink", Anchor::end);
    draw_bar(p, left, width - right, y, svg);
    svg.text({width, y + kBarHeight - 5}, short_number(p.sum) + " ms", "ink", Anchor::end);
    y += kRowHeight;
  }
  return svg;
}

}  // namespace lapwing::bench
