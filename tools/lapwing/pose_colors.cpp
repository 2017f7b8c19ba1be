#include "pose_colors.h"

#include <limits>

#include "lapwing/deform/shape_measures.h"
#include "lapwing/laplacian/weights.h"

namespace lapwing::cli {
namespace {

// Vertices that moved, and those with one in their ring.
std::vector<Index> touched_vertices(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                                    std::span<const Eigen::Vector3d> current) {
  std::vector<Index> moved;
  for (Index v = 0; v < rest.size(); ++v) {
    if (rest[v] != current[v]) moved.push_back(v);
  }
  return with_ring_neighbours(moved, topology.rings);
}

// One number per vertex of the mesh; none, as a NaN says, where nothing is touched.
std::vector<float> measured(const std::string& measure, const Topology& topology,
                            std::span<const Eigen::Vector3d> rest,
                            std::span<const Eigen::Vector3d> current) {
  const auto weights = laplacian_weights(topology, rest, LaplacianWeights::uniform);
  const VertexMeasures measures =
      measure_vertices(touched_vertices(topology, rest, current), topology, weights, rest, current);
  std::vector<float> values(rest.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t r = 0; r < measures.vertices.size(); ++r) {
    const Index v = measures.vertices[r];
    values[v] = static_cast<float>(measure == "rotation"  ? measures.rotation_degrees[r]
                                   : measure == "detail"  ? measures.detail_error[r]
                                   : measure == "stretch" ? measures.stretch[r]
                                                          : (current[v] - rest[v]).norm());
  }
  return values;
}

const char* legend_of(const std::string& measure) {
  if (measure == "rotation") return "rotation,\ndegrees";
  if (measure == "detail") return "detail error,\nrelative";
  if (measure == "stretch") return "edge stretch,\nrelative";
  return "displacement,\nmesh units";
}

}  // namespace

const std::vector<std::string>& pose_colors() {
  static const std::vector<std::string> names{"displacement", "rotation", "detail", "stretch"};
  return names;
}

void color_by(const std::string& measure, const Topology& topology,
              std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
              SurfacePaint& paint, RenderOptions& options) {
  const std::vector<float> values = measured(measure, topology, rest, current);
  paint.set_scalars(values);
  options.style.color = SurfaceColor::scalar;
  options.style.range = range_without_outliers(values);
  options.legend_title = legend_of(measure);
}

}  // namespace lapwing::cli
