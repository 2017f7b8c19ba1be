#pragma once

#include <string>
#include <vector>

#include "report/scale.h"
#include "report/svg.h"

namespace lapwing::bench {

struct Bar {
  std::string label;
  double value = 0;
  std::vector<double> marks;  ///< other values, drawn across the bar's row
  std::string text;           ///< behind the bar
  std::size_t color = 0;
};

struct BarGroup {
  std::string heading;
  std::vector<Bar> bars;
};

/// What the values are measured against.
struct BarAxis {
  bool is_log = false;
  double from = 0;
  double to = 1;
  double origin = 0;     ///< where bars begin
  double reference = 1;  ///< a line across all
  std::string (*tick)(double) = nullptr;
  std::string low;  ///< what the left end means, below the ticks; and the right one
  std::string high;
};

/// Bars on their sides, in groups, each with its label in front and its text behind. What reaches
/// beyond the axis is cut off there; marks beyond it are left out.
Svg bar_chart(const std::string& title, const std::vector<BarGroup>& groups, const BarAxis& axis,
              double width);

}  // namespace lapwing::bench
