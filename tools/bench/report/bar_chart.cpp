#include "report/bar_chart.h"

#include <algorithm>

#include "report/number_text.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kBarTitle = 26;
constexpr double kHeading = 22;
constexpr double kRow = 19;
constexpr double kBar = 12;
constexpr double kAxis = 38;          // ticks and what the ends mean
constexpr double kWidestLabel = 0.4;  // of the picture
constexpr double kGap = 8;

double height_of(const std::vector<BarGroup>& groups) {
  double height = kBarTitle + kAxis;
  for (const BarGroup& group : groups) {
    height += kHeading + kRow * static_cast<double>(group.bars.size());
  }
  return height;
}

std::string fitted(const std::string& text, double width) {
  const bool fits = text_width(text) <= width;
  return fits ? text : clipped(text, static_cast<std::size_t>(width / text_width("x")));
}

void draw_bar(const Bar& bar, const Scale& x, const BarAxis& axis, double top, Svg& svg) {
  const double a = x(axis.origin);
  const double b = x(std::clamp(bar.value, axis.from, axis.to));
  svg.rectangle({std::min(a, b), top + 3}, std::abs(b - a), kBar, bar_class(bar.color),
                bar.label + ": " + bar.text);
  for (const double mark : bar.marks) {
    if (mark < axis.from || mark > axis.to) continue;
    svg.line({x(mark), top + 2}, {x(mark), top + kBar + 4}, "mark");
  }
}

}  // namespace

Svg bar_chart(const std::string& title, const std::vector<BarGroup>& groups, const BarAxis& axis,
              double width) {
  double left = 0.0;
  double right = 0.0;
  for (const BarGroup& group : groups) {
    for (const Bar& bar : group.bars) {
      left = std::max(left, text_width(bar.label) + kGap);
      right = std::max(right, text_width(bar.text) + kGap);
    }
  }
  left = std::min(left, kWidestLabel * width);
  const double end = width - right;
  const Scale x = axis.is_log ? Scale::logarithmic(axis.from, axis.to, left, end)
                              : Scale::linear(axis.from, axis.to, left, end);
  Svg svg(width, height_of(groups));
  const double bottom = svg.height() - kAxis;
  svg.text({0, 13}, title, "heading", Anchor::start);
  for (const double tick : x.ticks(56)) {
    svg.line({x(tick), kBarTitle}, {x(tick), bottom}, "grid");
    svg.text({x(tick), bottom + 15}, axis.tick(tick), "quiet", Anchor::middle);
  }
  svg.text({left, bottom + 31}, axis.low, "quiet", Anchor::start);
  svg.text({end, bottom + 31}, axis.high, "quiet", Anchor::end);
  double y = kBarTitle;
  for (const BarGroup& group : groups) {
    svg.text({0, y + 15}, group.heading, "quiet", Anchor::start);
    y += kHeading;
    for (const Bar& bar : group.bars) {
      svg.text({left - kGap, y + 13}, fitted(bar.label, left - kGap + 0.5), "ink", Anchor::end);
      draw_bar(bar, x, axis, y, svg);
      svg.text({end + kGap, y + 13}, bar.text, "ink", Anchor::start);
      y += kRow;
    }
  }
  svg.line({x(axis.reference), kBarTitle}, {x(axis.reference), bottom}, "mark");
  return svg;
}

}  // namespace lapwing::bench
