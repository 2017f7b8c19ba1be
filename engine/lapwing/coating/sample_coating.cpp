#include "lapwing/coating/sample_coating.h"

#include <algorithm>
#include <span>

#include "lapwing/coating/ring_areas.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

// The target as it lies on the source, per vertex of the target's mesh; 0 if it lies nowhere.
struct LaidTarget {
  LaidTarget(const MappedRings& mapped, const Coating& coating, std::size_t vertex_count)
      : positions(vertex_count, Vector3d::Zero()), displacement(vertex_count, Vector3d::Zero()) {
    for (std::size_t own = 0; own < mapped.target.vertices.size(); ++own) {
      const Index v = mapped.target.vertices[own];
      positions[v] = mapped.points[own].of(std::span(coating.smooth));
      displacement[v] = mapped.points[own].of(std::span(coating.displacement));
    }
  }
  Positions positions;  // on the smooth surface
  std::vector<Vector3d> displacement;
};

bool lies_on_source(const MappedRings& mapped, std::size_t row) {
  const auto& [target, points] = mapped;
  if (points[row].is_nowhere()) return false;
  const auto ring = std::span(target.neighbours)
                        .subspan(target.starts[row], target.starts[row + 1] - target.starts[row]);
  return std::none_of(ring.begin(), ring.end(),
                      [&](Index j) { return mapped.points[j].is_nowhere(); });
}

// Adds r^2 / 4 c - L' d, with L' of the rings as they lie on the source.
void add_interpolated(const MappedRings& mapped, const Coating& coating, const Topology& topology,
                      LaplacianWeights scheme, Kernels& kernels, std::vector<Vector3d>& xi) {
  std::vector<Vector3d> curvature(xi.size());
  kernels.sample_mapped_laplacians(mapped, MappedSampling::linear, coating.curvature, curvature);
  std::vector<std::size_t> rows;
  std::vector<Index> vertices;
  for (std::size_t r = 0; r < xi.size(); ++r) {
    if (!lies_on_source(mapped, r)) continue;
    rows.push_back(r);
    vertices.push_back(mapped.target.vertices[r]);
  }
  const LaidTarget laid(mapped, coating, topology.vertex_count());
  const auto weights = laplacian_weights(topology, laid.positions, scheme);
  const auto squares = squared_rings(topology.rings, weights, laid.positions, vertices);
  std::vector<Vector3d> faceted(rows.size());
  kernels.sample_laplacians({laid.displacement, topology.rings, weights, vertices}, faceted);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    xi[rows[k]] += 0.25 * squares[k] * curvature[rows[k]] - faceted[k];
  }
}

}  // namespace

std::vector<Vector3d> sample_coating(const MappedRings& mapped, const Coating& coating,
                                     MappedSampling sampling, const Topology& topology,
                                     LaplacianWeights weights, Kernels& kernels) {
  std::vector<Vector3d> xi(mapped.target.row_count());
  kernels.sample_mapped_laplacians(mapped, MappedSampling::one_ring, coating.displacement, xi);
  if (sampling == MappedSampling::linear) {
    add_interpolated(mapped, coating, topology, weights, kernels, xi);
  }
  return xi;
}

}  // namespace lapwing
