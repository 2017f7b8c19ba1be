#include "report/growth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "report/measurements.h"

namespace lapwing::bench {
namespace {

constexpr std::size_t kSmallest = 5'000;  // vertices; overheads dominate below
constexpr std::size_t kFewestSizes = 3;   // two points always lie on a line

struct Sample {
  double x;  // log of the vertices
  double y;  // log of the median
};

double mean(const std::vector<Sample>& points, double Sample::*coordinate) {
  double sum = 0.0;
  for (const Sample& sample : points) sum += sample.*coordinate;
  return sum / static_cast<double>(points.size());
}

void fit_line(const std::vector<Sample>& points, Growth& growth) {
  const double x0 = mean(points, &Sample::x);
  const double y0 = mean(points, &Sample::y);
  double xx = 0.0;
  double xy = 0.0;
  for (const auto& [x, y] : points) {
    xx += (x - x0) * (x - x0);
    xy += (x - x0) * (y - y0);
  }
  growth.exponent = xy / xx;
  growth.factor = std::exp(y0 - growth.exponent * x0);
  double residual = 0.0;
  for (const auto& [x, y] : points) {
    const double off = (y - y0) - growth.exponent * (x - x0);
    residual += off * off;
  }
  const auto freedom = static_cast<double>(points.size() - 2);
  growth.standard_error = std::sqrt(residual / freedom / xx);
}

std::optional<Growth> growth_of(const Report& report, const Measurement& first) {
  std::vector<Sample> points;
  std::set<std::size_t> sizes;
  for (const Measurement& m : report.measurements) {
    const bool belongs = m.stage == first.stage && m.by == first.by && m.device == first.device;
    const double ms = median_ms(m);
    if (!belongs || m.vertices < kSmallest || !(ms > 0.0)) continue;
    points.push_back({std::log(static_cast<double>(m.vertices)), std::log(ms)});
    sizes.insert(m.vertices);
  }
  if (sizes.size() < kFewestSizes) return std::nullopt;
  Growth growth{first.stage, first.by, first.device};
  growth.sizes = sizes.size();
  fit_line(points, growth);
  return growth;
}

}  // namespace

std::vector<Growth> growths_of(const Report& report) {
  std::vector<Growth> growths;
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  for (const Measurement& m : report.measurements) {
    if (!seen.emplace(m.stage, m.by, m.device).second) continue;
    if (auto growth = growth_of(report, m)) growths.push_back(*std::move(growth));
  }
  return growths;
}

std::string in_words(const Growth& growth) {
  char text[64];
  std::snprintf(text, sizeof text, "n^%.2f +-%.2f", growth.exponent, growth.standard_error);
  return text;
}

}  // namespace lapwing::bench
