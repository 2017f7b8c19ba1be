#include "pose_colors.h"

#include <algorithm>

#include "lapwing/mesh/joined_surface.h"
#include "lapwing/render/pose_measure.h"

namespace lapwing::cli {
namespace {

std::vector<float> measured(PoseMeasure measure, const Mesh& mesh,
                            std::span<const Eigen::Vector3d> rest) {
  const JoinedSurface joined = joined_surface(mesh);
  if (joined.empty() || !joined.is_closed_at(rest)) {
    return measure_pose(measure, mesh.topology(), rest, mesh.positions);
  }
  std::vector<float> values =
      measure_pose(measure, joined.surface.topology(), rest, mesh.positions);
  for (const Index v : joined.followers) values[v] = values[joined.leaders[v]];
  return values;
}

}  // namespace

const std::vector<std::string>& pose_colors() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PoseMeasure measure : all_pose_measures()) all.emplace_back(name_of(measure));
    return all;
  }();
  return names;
}

void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options) {
  const auto all = all_pose_measures();
  const PoseMeasure wanted =
      *std::find_if(all.begin(), all.end(), [&](PoseMeasure m) { return name_of(m) == measure; });
  const std::vector<float> values = measured(wanted, mesh, rest);
  paint.set_scalars(values);
  options.style.color = SurfaceColor::scalar;
  options.style.range = range_without_outliers(values);
  options.legend_title = legend_title(wanted);
}

}  // namespace lapwing::cli
