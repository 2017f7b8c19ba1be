#include "pose_colors.h"

#include <algorithm>

#include "lapwing/render/pose_measure.h"

namespace lapwing::cli {

const std::vector<std::string>& pose_colors() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PoseMeasure measure : all_pose_measures()) all.emplace_back(name_of(measure));
    return all;
  }();
  return names;
}

void color_by(const std::string& measure, const Topology& topology,
              std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
              SurfacePaint& paint, RenderOptions& options) {
  const auto all = all_pose_measures();
  const PoseMeasure wanted =
      *std::find_if(all.begin(), all.end(), [&](PoseMeasure m) { return name_of(m) == measure; });
  const std::vector<float> values = measure_pose(wanted, topology, rest, current);
  paint.set_scalars(values);
  options.style.color = SurfaceColor::scalar;
  options.style.range = range_without_outliers(values);
  options.legend_title = legend_title(wanted);
}

}  // namespace lapwing::cli
