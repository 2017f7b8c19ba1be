#include "lapwing/coating/fairing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/region/border_belt.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

VertexSet free_vertices(const VertexSet& region, const Topology& topology) {
  const std::vector<char> inside = vertex_mask(topology.vertex_count(), region);
  VertexSet free;
  for (const Index v : region) {
    const auto ring = topology.rings[v];
    const bool at_border =
        std::any_of(ring.begin(), ring.end(), [&](Index j) { return inside[j] == 0; });
    if (!ring.empty() && !at_border && !on_mesh_boundary(v, topology)) free.push_back(v);
  }
  return free;
}

void require_length(double length, const char* where) {
  if (length > 0.0 && std::isfinite(length)) return;
  throw InputError(std::string(where) + ": expected a length above 0, got " +
                   std::to_string(length));
}

// Returns the rows sum_j s_ij (x_i - x_j) / sqrt(mass of row i).
BlockRows scaled_rows(const Adjacency& rings, std::span<const double> s,
                      std::span<const Index> vertices, std::span<const double> masses) {
  BlockRows rows = ring_blocks(rings, vertices);
  rows.block_size = 1;
  rows.values.reserve(rows.columns.size());
  for (std::size_t r = 0; r < vertices.size(); ++r) {
    const auto entries = s.subspan(rings.starts[vertices[r]], rings.size(vertices[r]));
    const double scale = 1.0 / std::sqrt(masses[r]);
    rows.values.push_back(scale * std::accumulate(entries.begin(), entries.end(), 0.0));
    for (const double entry : entries) rows.values.push_back(-scale * entry);
  }
  return rows;
}

}  // namespace

Fairing::Fairing(std::span<const Vector3d> positions, const Topology& topology,
                 const VertexSet& region, LaplacianWeights weights)
    : positions_(positions),
      unknowns_(free_vertices(region, topology), topology.vertex_count()),
      solver_(make_solver()) {
  // s_ij = s_ji, so that D is self-adjoint with respect to the masses.
  const std::vector<double> s = weights == LaplacianWeights::cotangent
                                    ? edge_weights(topology, positions)
                                    : std::vector<double>(topology.rings.values.size(), 1.0);
  masses_ = squared_rings(topology.rings, s, positions, free());
  for (double& mass : masses_) mass *= 0.25;
  rows_ = scaled_rows(topology.rings, s, free(), masses_);
  pattern_ = std::make_unique<SystemPattern>(topology, free(), unknowns_);
  if (!free().empty()) solver_->analyze(pattern_->blocks(), 1, pattern_->order());
}

Positions Fairing::smooth(std::span<const Vector3d> other, double length, const char* where) const {
  require_length(length, where);
  Positions result(other.begin(), other.end());
  if (free().empty()) return result;
  const double t = std::pow(length / (2.0 * std::numbers::pi), 2);
  BlockRows rows = rows_;
  for (double& value : rows.values) value *= t;
  solver_->factorize(pattern_->normal().normal_matrix(rows, masses_));

  // Solve for the displacement u, because its right-hand side is small: (M + t^2 D'MD) u = -t^2
  // D'MD v.
  const std::size_t n = free().size();
  std::vector<double> curvature(3 * n);
  multiply(rows, other, curvature);
  std::vector<double> by_vertex(3 * n);
  pattern_->normal().multiply_transposed(rows, curvature, by_vertex);
  std::vector<double> u(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) u[axis * n + k] = -by_vertex[3 * k + axis];
  }
  solver_->solve(u, u, 3);
  for (std::size_t k = 0; k < n; ++k) {
    result[free()[k]] += Vector3d(u[k], u[n + k], u[2 * n + k]);
  }
  return result;
}

VertexSet grown(const VertexSet& region, double distance, const Topology& topology,
                std::span<const Vector3d> positions) {
  // The shortest path from the region to an outer vertex starts at the border of the region.
  const std::vector<char> inside = vertex_mask(topology.vertex_count(), region);
  VertexSet border;
  for (const Index v : region) {
    const auto ring = topology.rings[v];
    if (std::any_of(ring.begin(), ring.end(), [&](Index j) { return inside[j] == 0; })) {
      border.push_back(v);
    }
  }
  std::vector<char> allowed(topology.vertex_count(), 1);
  for (const Index v : region) allowed[v] = 0;
  for (const Index v : border) allowed[v] = 1;
  const auto distances = geodesic_distances(topology, positions, border, distance, allowed);
  VertexSet result;
  for (Index v = 0; v < distances.size(); ++v) {
    if (distances[v] <= distance) result.push_back(v);
  }
  return unite(result, region);
}

SmoothedPart smooth_part(const VertexSet& region, double length,
                         std::span<const Vector3d> positions, const Topology& topology,
                         LaplacianWeights weights, const char* where) {
  require_length(length, where);
  SmoothedPart result;
  result.part = submesh_around(grown(region, length, topology, positions), topology);
  result.rest = result.part.own(positions);
  result.smooth =
      Fairing(result.rest, result.part.topology, result.part.region, weights).smooth(length, where);
  return result;
}

Positions smooth_around(const VertexSet& region, double length, std::span<const Vector3d> positions,
                        const Topology& topology, LaplacianWeights weights, const char* where) {
  const SmoothedPart smoothed = smooth_part(region, length, positions, topology, weights, where);
  Positions result(positions.begin(), positions.end());
  for (std::size_t own = 0; own < smoothed.smooth.size(); ++own) {
    result[smoothed.part.vertices[own]] = smoothed.smooth[own];
  }
  return result;
}

}  // namespace lapwing
