#include "lapwing/fill/fair_patches.h"

#include <cmath>
#include <numeric>

#include "lapwing/coating/ring_operators.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

void fair_patches(Mesh& surface, Index first) {
  if (first >= surface.vertex_count()) return;
  const Topology& topology = surface.topology();
  std::vector<Index> moved(surface.vertex_count() - first);
  std::iota(moved.begin(), moved.end(), first);
  const Unknowns unknowns(moved, surface.vertex_count());
  const std::vector<Index> row_vertices = with_ring_neighbours(moved, topology.rings);

  const std::vector<double> s = edge_weights(topology, surface.positions);
  const std::vector<double> masses =
      squared_rings(topology.rings, s, surface.positions, row_vertices);
  BlockRows rows = ring_blocks(topology.rings, row_vertices);
  rows.block_size = 1;
  rows.values.reserve(rows.columns.size());
  for (std::size_t r = 0; r < row_vertices.size(); ++r) {
    const Index v = row_vertices[r];
    const auto ring = std::span(s).subspan(topology.rings.starts[v], topology.rings.size(v));
    const double scale = 1.0 / std::sqrt(masses[r]);
    rows.values.push_back(scale * std::accumulate(ring.begin(), ring.end(), 0.0));
    for (const double weight : ring) rows.values.push_back(-scale * weight);
  }

  // Solve D'MD u = -D'MD x for the displacement u, because its right-hand side is small.
  const SystemPattern pattern(topology, row_vertices, unknowns);
  const auto solver = make_solver();
  solver->analyze(pattern.blocks(), 1, pattern.order());
  solver->factorize(pattern.normal().normal_matrix(rows));
  std::vector<double> curvature(3 * row_vertices.size());
  multiply(rows, surface.positions, curvature);
  const std::size_t n = moved.size();
  std::vector<double> by_vertex(3 * n);
  pattern.normal().multiply_transposed(rows, curvature, by_vertex);
  std::vector<double> u(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) u[axis * n + k] = -by_vertex[3 * k + axis];
  }
  solver->solve(u, u, 3);
  for (std::size_t k = 0; k < n; ++k) {
    surface.positions[moved[k]] += Eigen::Vector3d(u[k], u[n + k], u[2 * n + k]);
  }
}

}  // namespace lapwing
