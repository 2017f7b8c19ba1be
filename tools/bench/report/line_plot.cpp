#include "report/line_plot.h"

#include <algorithm>
#include <iterator>

#include "report/measurements.h"
#include "report/number_text.h"
#include "report/scale.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kTop = 34;     // the title stands above
constexpr double kBottom = 40;  // ticks and the axis' name below
constexpr double kLeft = 52;    // ticks in front
constexpr double kLabelGap = 14;
constexpr double kLeader = 22;  // between a line's end and its label

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

Axes axes_for(const std::vector<PlotLine>& lines, double width, double height) {
  constexpr double kRoom = 1.15;  // around the points, as a factor
  Range sizes;
  Range times;
  double label_width = 0.0;
  for (const PlotLine& line : lines) {
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
  const double bottom = height - kBottom;
  return {Scale::logarithmic(sizes.from / kRoom, sizes.to * kRoom, kLeft, right),
          Scale::logarithmic(times.from / kRoom, times.to * kRoom, bottom, kTop),
          kLeft,
          right,
          kTop,
          bottom};
}

void draw_axes(const Axes& axes, Svg& svg) {
  for (const double size : axes.x.ticks(34)) {
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

// Those that a line joins: different meshes of about one size would make it jump up and down, so
// where one mesh has sizes enough, it is that one's; the others are marks beside it.
std::vector<const Measurement*> joined(const PlotLine& line) {
  constexpr std::ptrdiff_t kEnough = 3;
  for (const Measurement* first : line.points) {
    const auto is_same = [&](const Measurement* m) { return m->mesh == first->mesh; };
    if (std::count_if(line.points.begin(), line.points.end(), is_same) < kEnough) continue;
    std::vector<const Measurement*> same;
    std::copy_if(line.points.begin(), line.points.end(), std::back_inserter(same), is_same);
    return same;
  }
  return line.points;
}

Point place_of(const Measurement& m, const Axes& axes) {
  return {axes.x(static_cast<double>(m.vertices)), axes.y(median_ms(m))};
}

void draw_line(const PlotLine& line, const Axes& axes, Svg& svg) {
  std::vector<Point> points;
  for (const Measurement* m : joined(line)) points.push_back(place_of(*m, axes));
  svg.polyline(points, line.is_dashed ? dashed_class(line.color) : line_class(line.color));
  for (const Measurement* m : line.points) {
    const Spread spread = spread_of(clock_of(*m));
    const Point at = place_of(*m, axes);
    if (spread.low > 0.0) {
      const std::string classes = line_class(line.color) + " error";
      svg.line({at.x, axes.y(spread.low)}, {at.x, axes.y(spread.high)}, classes);
    }
    svg.marker(at, line.shape, marker_class(line.color),
               m->stage + " by " + m->by + ", " + m->mesh + ", " + grouped(m->vertices) +
                   " vertices: " + short_number(spread.median) + " ms");
  }
}

// Labels that touch, and stand one below the other about the middle of where they want to.
struct Pile {
  double middle;
  double count;
  double top() const { return middle - (count - 1.0) / 2.0 * kLabelGap; }
  double bottom() const { return middle + (count - 1.0) / 2.0 * kLabelGap; }
};

// Where labels stand that want to stand at `wanted` (rising), a line of text apart, and within the
// axes as far as there is room.
std::vector<double> spread_out(const std::vector<double>& wanted, double top, double bottom) {
  const auto kept_within = [&](Pile pile) {
    const double reach = (pile.count - 1.0) / 2.0 * kLabelGap;
    pile.middle = std::max(std::min(pile.middle, bottom - reach), top + reach);
    return pile;
  };
  std::vector<Pile> piles;
  for (const double y : wanted) {
    piles.push_back(kept_within({y, 1.0}));
    while (piles.size() > 1 && piles.end()[-2].bottom() + kLabelGap > piles.back().top()) {
      const Pile below = piles.back();
      piles.pop_back();
      Pile& above = piles.back();
      const double count = above.count + below.count;
      const double middle = (above.middle * above.count + below.middle * below.count) / count;
      above = kept_within({middle, count});
    }
  }
  std::vector<double> places;
  for (const Pile& pile : piles) {
    for (double k = 0.0; k < pile.count; ++k) places.push_back(pile.top() + k * kLabelGap);
  }
  return places;
}

void draw_labels(std::vector<PlotLine> lines, const Axes& axes, Svg& svg) {
  const auto end_of = [&](const PlotLine& line) { return place_of(*joined(line).back(), axes); };
  std::stable_sort(lines.begin(), lines.end(),
                   [&](const PlotLine& a, const PlotLine& b) { return end_of(a).y < end_of(b).y; });
  std::vector<double> wanted;
  for (const PlotLine& line : lines) wanted.push_back(end_of(line).y);
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

bool has_two_sizes(const PlotLine& line) {
  return line.points.front()->vertices < line.points.back()->vertices;
}

Svg line_plot(const std::string& title, const std::vector<PlotLine>& lines, double width,
              double height) {
  Svg svg(width, height);
  svg.text({0, 13}, title, "heading", Anchor::start);
  const Axes axes = axes_for(lines, width, height);
  draw_axes(axes, svg);
  for (const PlotLine& line : lines) draw_line(line, axes, svg);
  draw_labels(lines, axes, svg);
  return svg;
}

}  // namespace lapwing::bench
