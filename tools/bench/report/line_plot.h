#pragma once

#include <string>
#include <vector>

#include "report/report.h"
#include "report/svg.h"

namespace lapwing::bench {

/// Measurements of one thing at one size or more.
struct PlotLine {
  std::string label;
  std::vector<const Measurement*> points;  ///< not empty, by size
  std::size_t color = 0;
  std::size_t shape = 0;  ///< of the markers
  bool is_dashed = false;
};

bool has_two_sizes(const PlotLine& line);

/// Median times over numbers of vertices, both logarithmic, with error bars from one quartile to
/// the other and each line's label at its end. A line joins the sizes of one mesh if that has
/// three.
Svg line_plot(const std::string& title, const std::vector<PlotLine>& lines, double width,
              double height);

}  // namespace lapwing::bench
