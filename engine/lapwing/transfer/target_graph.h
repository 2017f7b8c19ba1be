#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transfer/graph_laplacian.h"
#include "lapwing/transfer/pose_maps.h"

namespace lapwing {

/// The counterparts of a target's vertices, in the frame of the target.
struct CounterpartMotion {
  std::span<const char> exists;  ///< whether the vertex has a counterpart
  std::span<const Eigen::Vector3d> rest;
  std::span<const Eigen::Vector3d> posed;
};

/// Finds the displacements u of a surface whose triangles should follow given maps T_t. They
/// minimize
///     sum_ij w_ij |(r_i + u_i) - (r_j + u_j) - d_ij|^2,
/// where d_ij is the mean of T_t (r_i - r_j) over the triangles of edge ij. The w_ij are
/// `edge_weights`, so the matrix is n x n and does not depend on the maps.
///
/// The components with a map are solved together: weak edges (ties) join each of them to the
/// largest one, at its contacts. Ties determine only the distances between components. Components
/// without a map are `loose`.
class TargetGraph {
 public:
  /// `areas` contains the area of each triangle that has a map, and 0 for all others; at least one
  /// is positive. Vertices in `held` do not move. `topology` and `rest` must outlive the object.
  /// Throws InputError if all vertices in `held` are loose.
  TargetGraph(const Topology& topology, std::span<const Eigen::Vector3d> rest,
              std::vector<double> areas, const VertexSet& held);

  const std::vector<Index>& solved() const { return unknowns_.vertices; }
  const std::vector<VertexSet>& loose() const { return loose_; }

  /// Fills in the maps of solved triangles that have none. Their R and S are harmonic over the
  /// surface, between the vertices that have a map. Returns the maps of all vertices, as sums.
  std::vector<LinearMap> complete(std::span<LinearMap> of_triangle) const;

  /// Returns the displacements. They are 0 for vertices that are not solved. If no vertex is held,
  /// they are defined up to a translation. `of_vertex` is the result of `complete`.
  std::vector<Eigen::Vector3d> solve(std::span<const LinearMap> of_triangle,
                                     std::span<const LinearMap> of_vertex,
                                     const CounterpartMotion& counterparts) const;

 private:
  bool is_solved(Index v) const { return unknowns_.of_vertex[v] != kNoIndex; }

  struct Tie {
    Index i = 0;
    Index j = 0;
  };

  void split_components();
  void add_ties(const VertexSet& part, const ClosestPoint& main);
  void factorize(const VertexSet& held);
  void factorize_unmapped();
  std::array<Eigen::Vector3d, 3> pulls_of(Index triangle, const LinearMap& map) const;

  const Topology& topology_;
  std::span<const Eigen::Vector3d> rest_;
  const std::vector<double> areas_;
  const std::vector<double> weights_;          // per entry of the rings
  std::vector<std::array<double, 3>> shares_;  // per triangle: its part of the weights of its edges
  std::vector<VertexSet> loose_;
  std::vector<Tie> ties_;
  Unknowns unknowns_;  // solved vertices
  Unknowns unmapped_;  // solved vertices without a triangle that has a map
  std::optional<GraphLaplacian> laplacian_;
  std::optional<GraphLaplacian> harmonic_;
};

}  // namespace lapwing
