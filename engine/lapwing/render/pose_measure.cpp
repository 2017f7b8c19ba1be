#include "lapwing/render/pose_measure.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lapwing/deform/shape_measures.h"
#include "lapwing/laplacian/weights.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

struct Words {
  std::string_view name;
  std::string_view legend;
};

// In the order of PoseMeasure.
constexpr std::array<Words, 4> kWords{{{"displacement", "displacement,\nmesh units"},
                                       {"rotation", "rotation,\ndegrees"},
                                       {"detail", "detail error,\nrelative"},
                                       {"stretch", "edge stretch,\nrelative"}}};

const Words& words_of(PoseMeasure measure) {
  return kWords[static_cast<std::size_t>(measure)];
}

// The vertices of a stiff belt move by about a millionth of the largest displacement. Without this
// threshold, some of them would be coloured.
constexpr double kStill = 1e-5;

// Returns the vertices that moved and their neighbours.
std::vector<Index> touched_vertices(const Topology& topology, std::span<const Vector3d> rest,
                                    std::span<const Vector3d> current) {
  double largest = 0.0;
  for (Index v = 0; v < rest.size(); ++v) {
    largest = std::max(largest, (current[v] - rest[v]).norm());
  }
  std::vector<Index> moved;
  for (Index v = 0; v < rest.size(); ++v) {
    if ((current[v] - rest[v]).norm() > kStill * largest) moved.push_back(v);
  }
  return with_ring_neighbours(moved, topology.rings);
}

std::vector<double> measured(PoseMeasure measure, std::span<const Index> touched,
                             const Topology& topology, std::span<const Vector3d> rest,
                             std::span<const Vector3d> current) {
  if (measure == PoseMeasure::displacement) {
    std::vector<double> lengths;
    lengths.reserve(touched.size());
    for (const Index v : touched) lengths.push_back((current[v] - rest[v]).norm());
    return lengths;
  }
  const auto weights = laplacian_weights(topology, rest, LaplacianWeights::uniform);
  VertexMeasures all = measure_vertices(touched, topology, weights, rest, current);
  if (measure == PoseMeasure::rotation) return std::move(all.rotation_degrees);
  if (measure == PoseMeasure::detail) return std::move(all.detail_error);
  return std::move(all.stretch);
}

}  // namespace

std::span<const PoseMeasure> all_pose_measures() {
  static constexpr std::array kAll{PoseMeasure::displacement, PoseMeasure::rotation,
                                   PoseMeasure::detail, PoseMeasure::stretch};
  return kAll;
}

std::string_view name_of(PoseMeasure measure) {
  return words_of(measure).name;
}

std::string_view legend_title(PoseMeasure measure) {
  return words_of(measure).legend;
}

std::vector<float> measure_pose(PoseMeasure measure, const Topology& topology,
                                std::span<const Vector3d> rest, std::span<const Vector3d> current) {
  const std::vector<Index> touched = touched_vertices(topology, rest, current);
  const std::vector<double> numbers = measured(measure, touched, topology, rest, current);
  std::vector<float> values(rest.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t k = 0; k < touched.size(); ++k) {
    values[touched[k]] = static_cast<float>(numbers[k]);
  }
  return values;
}

}  // namespace lapwing
