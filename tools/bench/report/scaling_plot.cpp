#include <algorithm>
#include <cmath>
#include <set>

#include "report/growth.h"
#include "report/measurements.h"
#include "report/number_text.h"
#include "report/plots.h"
#include "report/scale.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kHeight = 360;
constexpr double kTop = 34;     // the title stands above
constexpr double kBottom = 40;  // ticks and the axis' name below
constexpr double kLeft = 52;    // ticks in front
constexpr double kLabelGap = 14;
constexpr double kLeader = 22;  // between a line's end and its label

struct Line {
  std::string label;
  std::vector<const Measurement*> points;  // by size
  std::size_t color = 0;
  bool is_peer = false;
};

bool belongs(const Report& report, const Measurement& m, Lines lines) {
  const auto& parts = kPreparationStages;
  const bool is_part =
      std::find(parts.begin(), parts.end(), m.stage) != parts.end() ||
      std::find(kMeshStages.begin(), kMeshStages.end(), m.stage) != kMeshStages.end();
  const bool is_kernel = m.stage.starts_with("kernel ");
  switch (lines) {
    case Lines::preparation:
      return is_ours(m) && is_part;
    case Lines::waits:
      return is_ours(m) && !is_part && !is_kernel;
    case Lines::kernels:
      return is_ours(m) && is_kernel;
    case Lines::peers:
      return std::any_of(report.measurements.begin(), report.measurements.end(),
                         [&](const Measurement& other) {
                           return other.stage == m.stage && other.device == m.device &&
                                  is_ours(other) != is_ours(m);
                         });
  }
  return false;
}

const char* title_of(Lines lines) {
  switch (lines) {
    case Lines::preparation:
      return "Reading and preparing, by stages";
    case Lines::waits:
      return "What a user waits for";
    case Lines::kernels:
      return "Kernels";
    case Lines::peers:
      return "Beside others (dashed)";
  }
  return "";
}

std::string label_of(const Report& report, const Measurement& m) {
  std::string label = m.stage.starts_with("kernel ") ? m.stage.substr(7) : m.stage;
  if (!is_ours(m)) label += ", " + m.by;
  for (const Growth& growth : growths_of(report)) {
    if (growth.stage != m.stage || growth.by != m.by || growth.device != m.device) continue;
    const std::string words = in_words(growth);
    label += "  " + words.substr(0, words.find(' '));
  }
  return label;
}

// In the order of the report; lines of one stage have one color.
std::vector<Line> lines_of(const Report& report, const std::string& device, Lines which) {
  std::vector<Line> lines;
  std::vector<std::string> stages;
  std::set<std::pair<std::string, std::string>> seen;
  for (const Measurement& first : report.measurements) {
    if (first.device != device || !belongs(report, first, which)) continue;
    if (!seen.emplace(first.stage, first.by).second) continue;
    const auto stage = std::find(stages.begin(), stages.end(), first.stage);
    Line line{label_of(report, first),
              {},
              static_cast<std::size_t>(stage - stages.begin()),
              !is_ours(first)};
    if (stage == stages.end()) stages.push_back(first.stage);
    for (const Measurement& m : report.measurements) {
      const bool is_point = m.stage == first.stage && m.by == first.by && m.device == device;
      if (is_point && median_ms(m) > 0.0) line.points.push_back(&m);
    }
    std::stable_sort(
        line.points.begin(), line.points.end(),
        [](const Measurement* a, const Measurement* b) { return a->vertices < b->vertices; });
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

bool has_two_sizes(const Line& line) {
  return line.points.front()->vertices < line.points.back()->vertices;
}

struct Range {
  double from = 1e300;
  double to = 0.0;
  void take(double value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
};

struct Axes {
  Scale x;
  Scale y;
  double left;
  double right;
  double top;
  double bottom;
};

Axes axes_for(const std::vector<Line>& lines, double width) {
  constexpr double kRoom = 1.15;  // around the points, as a factor
  Range sizes;
  Range times;
  double label_width = 0.0;
  for (const Line& line : lines) {
    label_width = std::max(label_width, text_width(line.label));
    for (const Measurement* m : line.points) {
      const Spread spread = spread_of(clock_of(*m));
      sizes.take(static_cast<double>(m->vertices));
      times.take(spread.median);
      if (spread.low > 0.0) times.take(spread.low);
      times.take(spread.high);
    }
  }
  const double right = width - kLeader - label_width;
  const double bottom = kHeight - kBottom;
  return {Scale::logarithmic(sizes.from / kRoom, sizes.to * kRoom, kLeft, right),
          Scale::logarithmic(times.from / kRoom, times.to * kRoom, bottom, kTop),
          kLeft,
          right,
          kTop,
          bottom};
}

void draw_axes(const Axes& axes, Svg& svg) {
  for (const double size : axes.x.ticks(44)) {
    const double x = axes.x(size);
    svg.line({x, axes.top}, {x, axes.bottom}, "grid");
    svg.text({x, axes.bottom + 16}, brief_count(size), "quiet", Anchor::middle);
  }
  for (const double ms : axes.y.ticks(18)) {
    const double y = axes.y(ms);
    svg.line({axes.left, y}, {axes.right, y}, "grid");
    svg.text({axes.left - 6, y + 4}, brief_count(ms), "quiet", Anchor::end);
  }
  svg.line({axes.left, axes.bottom}, {axes.right, axes.bottom}, "axis");
  svg.text({axes.right, axes.bottom + 32}, "vertices", "quiet", Anchor::end);
  svg.text({axes.left - 6, axes.top - 4}, "ms", "quiet", Anchor::end);
}

void draw_line(const Line& line, const Axes& axes, Svg& svg) {
  std::vector<Point> points;
  for (const Measurement* m : line.points) {
    const Spread spread = spread_of(clock_of(*m));
    const Point at{axes.x(static_cast<double>(m->vertices)), axes.y(spread.median)};
    if (spread.low > 0.0) {
      const std::string classes = line_class(line.color) + " error";
      svg.line({at.x, axes.y(spread.low)}, {at.x, axes.y(spread.high)}, classes);
    }
    points.push_back(at);
  }
  svg.polyline(points, line.is_peer ? dashed_class(line.color) : line_class(line.color));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Measurement& m = *line.points[k];
    svg.marker(points[k], line.color, marker_class(line.color),
               m.stage + " by " + m.by + ", " + m.mesh + ", " + grouped(m.vertices) +
                   " vertices: " + short_number(median_ms(m)) + " ms");
  }
}

// Where labels stand that want to stand at `wanted` (rising), a line of text apart and within the
// axes as far as there is room.
std::vector<double> spread_out(std::vector<double> wanted, double top, double bottom) {
  double least = top + kLabelGap / 2;
  for (double& y : wanted) {
    y = std::max(y, least);
    least = y + kLabelGap;
  }
  double most = bottom;
  for (auto y = wanted.rbegin(); y != wanted.rend(); ++y) {
    *y = std::min(*y, most);
    most = *y - kLabelGap;
  }
  return wanted;
}

void draw_labels(std::vector<Line> lines, const Axes& axes, Svg& svg) {
  const auto end_of = [&](const Line& line) {
    const Measurement& last = *line.points.back();
    return Point{axes.x(static_cast<double>(last.vertices)), axes.y(median_ms(last))};
  };
  std::stable_sort(lines.begin(), lines.end(),
                   [&](const Line& a, const Line& b) { return end_of(a).y < end_of(b).y; });
  std::vector<double> wanted;
  for (const Line& line : lines) wanted.push_back(end_of(line).y);
  const std::vector<double> places = spread_out(wanted, axes.top, axes.bottom);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Point end = end_of(lines[k]);
    const double x = axes.right + kLeader;
    svg.polyline(
        {{end.x + 6, end.y}, {std::max(end.x + 6, axes.right - 2), end.y}, {x - 3, places[k]}},
        line_class(lines[k].color) + " leader");
    svg.text({x, places[k] + 4}, lines[k].label, "ink", Anchor::start);
  }
}

}  // namespace

std::optional<Svg> scaling_plot(const Report& report, const std::string& device, Lines which,
                                double width) {
  const std::vector<Line> lines = lines_of(report, device, which);
  if (std::none_of(lines.begin(), lines.end(), has_two_sizes)) return std::nullopt;
  Svg svg(width, kHeight);
  svg.text({0, 13}, title_of(which), "heading", Anchor::start);
  const Axes axes = axes_for(lines, width);
  draw_axes(axes, svg);
  for (const Line& line : lines) draw_line(line, axes, svg);
  draw_labels(lines, axes, svg);
  return svg;
}

}  // namespace lapwing::bench
