#include "lapwing/laplacian/laplacian_system.h"

#include <algorithm>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"

namespace lapwing {

using Eigen::Vector3d;

LaplacianSystem::LaplacianSystem(std::span<const Vector3d> rest, const Topology& topology,
                                 std::span<const Index> roi, const Constraints& constraints,
                                 const SystemPattern& pattern, LaplacianWeights weights,
                                 double stretch_resistance, StageTimings& timings)
    : constraints_(constraints), pattern_(pattern), solver_(make_solver()) {
  const Stopwatch watch;
  BlockMatrix A;
  // The symbolic work needs the pattern alone.
  parallel_invoke(
      [&] {
        const auto w = laplacian_weights(topology, rest, weights);
        std::vector<double> edges;
        if (stretch_resistance > 0.0) edges = edge_weights(topology, rest);
        L_ = laplacian_rows(topology.rings, w, roi);
        A = pattern.normal().normal_matrix(L_, constraints.W);
        const std::vector<Index> rows = rows_by_elimination(roi);
        rings_ = region_rings(topology, rest, w, edges, stretch_resistance, rows,
                              std::span(rows).first(size()));
        if (!edges.empty()) add_edge_terms(A);
      },
      [&] { solver_->analyze(pattern.blocks(), 1, pattern.order()); });
  try {
    solver_->factor(A);
  } catch (const NotPositiveDefinite& error) {
    throw SolverError("the Laplacian system is singular at vertex " +
                      std::to_string(constraints.unknowns.vertices[error.block]) +
                      ": belt and handle do not hold its component. Add belt vertices there, or "
                      "leave it out of the region");
  }
  timings.add("laplacian", watch.elapsed_ms());
}

// The vertices of the unknowns in the order of elimination, then the others of the region.
std::vector<Index> LaplacianSystem::rows_by_elimination(std::span<const Index> roi) {
  const Unknowns& unknowns = constraints_.unknowns;
  std::vector<Index> rows;
  rows.reserve(roi.size());
  places_.resize(size());
  for (const int k : elimination_order()) {
    places_[static_cast<std::size_t>(k)] = static_cast<Index>(rows.size());
    rows.push_back(unknowns.vertices[static_cast<std::size_t>(k)]);
  }
  for (const Index v : roi) {
    if (unknowns.of_vertex[v] == kNoIndex) rows.push_back(v);
  }
  return rows;
}

// Every row holds the edges of its ring, so an edge between two rows counts twice.
void LaplacianSystem::add_edge_terms(BlockMatrix& A) const {
  const BlockPattern& blocks = *A.pattern;
  for (std::size_t c = 0; c < size(); ++c) {
    const std::size_t row = rings_.unknown_rows[places_[c]];
    for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
      const Index j = rings_.neighbours[e];
      const double w = rings_.stiffness[e] * (rings_.is_row(j) ? 2.0 : 1.0);
      A.values[blocks.starts[c]] += w;
      const Index r = constraints_.unknowns.of_vertex[rings_.vertices[j]];
      if (r == kNoIndex || r < c) continue;
      const auto column = blocks.column(c);
      const auto at = std::lower_bound(column.begin(), column.end(), r) - column.begin();
      A.values[blocks.starts[c] + static_cast<std::size_t>(at)] -= w;
    }
  }
}

// (L'L + mu K) u over the unknowns, u on vertices that are none: 3 numbers per unknown.
std::vector<double> LaplacianSystem::from_given(std::span<const Vector3d> given) const {
  std::vector<double> rows(3 * L_.size());
  multiply(L_, given, rows);
  std::vector<double> result(3 * size());
  pattern_.normal().multiply_transposed(L_, rows, result);
  if (rings_.stiffness.empty()) return result;
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t row = rings_.unknown_rows[places_[k]];
    for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
      Eigen::Map<Vector3d>(result.data() + 3 * k) -=
          2.0 * rings_.stiffness[e] * given[rings_.vertices[rings_.neighbours[e]]];
    }
  }
  return result;
}

void LaplacianSystem::right_hand_side(std::span<const Vector3d> wanted, std::span<double> b) const {
  const std::size_t n = size();
  const Unknowns& unknowns = constraints_.unknowns;
  std::vector<Vector3d> given(wanted.size(), Vector3d::Zero());
  bool any_given = false;
  for (const Index v : std::span(rings_.vertices).first(rings_.row_count())) {
    if (unknowns.of_vertex[v] != kNoIndex || wanted[v].isZero(0.0)) continue;
    given[v] = wanted[v];
    any_given = true;
  }
  const std::vector<double> moved = any_given ? from_given(given) : std::vector<double>(3 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = wanted[unknowns.vertices[k]][static_cast<Eigen::Index>(axis)];
      b[axis * n + k] = constraints_.W[k] * d - moved[3 * k + axis];
    }
  }
}

void LaplacianSystem::solve_in_elimination_order(std::span<double> columns_of_b,
                                                 std::size_t columns) const {
  if (size() > 0) solver_->solve_in_places(columns_of_b, columns, places_);
}

void LaplacianSystem::solve_in_place(std::span<double> columns_of_b, std::size_t columns) const {
  if (size() > 0) solver_->solve(columns_of_b, columns_of_b, columns);
}

}  // namespace lapwing
