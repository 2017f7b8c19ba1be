#include "lapwing/laplacian/laplacian_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

// The stiffness that replaces kStiff, as a multiple of the diagonal. A vertex with this stiffness
// misses its prescribed position by at most a thousandth of its displacement
// (engine/decisions/020). With a larger factor, free handles would need more iterations.
constexpr double kHeldStiffness = 1e3;

}  // namespace

LaplacianSystem::LaplacianSystem(const Topology& topology, std::span<const Index> roi,
                                 const Unknowns& unknowns, const SystemPattern& pattern)
    : topology_(topology),
      pattern_(pattern),
      roi_(roi.begin(), roi.end()),
      constraints_{unknowns, {}},
      is_row_(topology.rings.row_count(), 0),
      factor_(pattern, 1) {
  for (const Index v : roi_) is_row_[v] = 1;
}

LaplacianSystem::LaplacianSystem(std::span<const Vector3d> rest, const Topology& topology,
                                 std::span<const Index> roi, const Constraints& constraints,
                                 const SystemPattern& pattern, const EnergyTerms& terms,
                                 StageTimings& timings)
    : LaplacianSystem(topology, roi, constraints.unknowns, pattern) {
  const Stopwatch watch;
  parallel_invoke([&] { assemble(rest, terms); }, [&] { analyze(); });
  factorize(constraints.W);
  shared_rings();  // computed now, while `rest` is valid
  timings.add("laplacian", watch.elapsed_ms());
}

void LaplacianSystem::share_setup_from(const LaplacianSystem& other) {
  if (other.is_analyzed()) {
    factor_.analyze_as(other.factor_);
    places_ = other.places_;
  }
  weights_ = other.weights_;
  rest_ = other.rest_;
  const std::scoped_lock lock(other.building_rings_);
  rings_ = other.rings_;
}

void LaplacianSystem::assemble(std::span<const Vector3d> rest, const EnergyTerms& terms,
                               std::span<const Spring> springs) {
  assemble(rest,
           std::make_shared<const EnergyWeights>(energy_weights(topology_, rest, roi_, terms)),
           springs);
}

void LaplacianSystem::assemble(std::span<const Vector3d> rest,
                               std::shared_ptr<const EnergyWeights> weights,
                               std::span<const Spring> springs) {
  if (weights != weights_) rings_.reset();
  is_assembled_ = false;
  rest_ = rest;
  weights_ = std::move(weights);
  L_ = laplacian_rows(topology_.rings, weights_->laplacian, roi_);
  if (!weights_->rows.empty()) {
    for (std::size_t r = 0; r < L_.size(); ++r) {
      const double root = std::sqrt(weights_->rows[roi_[r]]);
      for (std::size_t b = L_.starts[r]; b < L_.starts[r + 1]; ++b) L_.values[b] *= root;
    }
  }
  BlockMatrix A = pattern_.normal().normal_matrix(L_, {}, factor_.take_memory());
  if (!weights_->stiffness.empty()) add_edge_terms(A);
  springs_ = with_finite_stiffness(springs, A);
  add_springs(springs_, constraints_.unknowns, A);
  factor_.set_matrix(std::move(A));
  is_assembled_ = true;
}

void LaplacianSystem::analyze() {
  if (is_analyzed()) return;
  factor_.analyze();
  places_.resize(size());
  Index place = 0;
  for (const int k : elimination_order()) places_[static_cast<std::size_t>(k)] = place++;
}

void LaplacianSystem::factorize(std::span<const double> W) {
  constraints_.W = finite_weights(W);
  try {
    factor_.factorize(constraints_.W);
  } catch (const NotPositiveDefinite& error) {
    const Index vertex = constraints_.unknowns.vertices[error.block];
    throw SolverError("the Laplacian system is singular at vertex " + std::to_string(vertex) +
                          ": belt and handle do not hold its component. Add belt vertices there, "
                          "or exclude it from the region",
                      {vertex});
  }
}

std::vector<double> LaplacianSystem::finite_weights(std::span<const double> W) const {
  std::vector<double> finite(W.begin(), W.end());
  const std::span<const double> diagonal = factor_.unconstrained_diagonal();
  const double mean = mean_diagonal();
  for (std::size_t u = 0; u < finite.size(); ++u) {
    if (finite[u] == kStiff) finite[u] = kHeldStiffness * std::max(mean, diagonal[u]);
  }
  return finite;
}

// Rigid parts must not make the constraints stiffer, because the rotation of a free handle would
// then be lost in rounding errors. With stiffness factors, the mean is therefore computed as if all
// vertices had the smallest factor.
double LaplacianSystem::mean_diagonal() const {
  const std::span<const double> diagonal = factor_.unconstrained_diagonal();
  std::vector<double> softened(diagonal.begin(), diagonal.end());
  double softest = weights_->factors.empty() ? 1.0 : kRigidStiffness;
  for (std::size_t u = 0; u < diagonal.size() && !weights_->factors.empty(); ++u) {
    const double factor = weights_->factors[constraints_.unknowns.vertices[u]];
    softened[u] /= factor;
    softest = std::min(softest, factor);
  }
  if (softened.empty()) return 0.0;
  return softest * std::reduce(softened.begin(), softened.end()) /
         static_cast<double>(softened.size());
}

std::shared_ptr<const RegionRings> LaplacianSystem::shared_rings() const {
  const std::scoped_lock lock(building_rings_);
  if (rings_ == nullptr) {
    const std::vector<Index> rows = rows_by_elimination();
    rings_ = std::make_shared<const RegionRings>(
        region_rings(topology_, rest_, *weights_, rows, std::span(rows).first(size())));
  }
  return rings_;
}

// Returns the vertices of the unknowns in elimination order, followed by all other vertices of the
// region.
std::vector<Index> LaplacianSystem::rows_by_elimination() const {
  const Unknowns& unknowns = constraints_.unknowns;
  std::vector<Index> rows;
  rows.reserve(roi_.size());
  for (const int k : elimination_order()) {
    rows.push_back(unknowns.vertices[static_cast<std::size_t>(k)]);
  }
  for (const Index v : roi_) {
    if (unknowns.of_vertex[v] == kNoIndex) rows.push_back(v);
  }
  return rows;
}

// An edge between two rows counts twice, once in each row.
void LaplacianSystem::add_edge_terms(BlockMatrix& A) const {
  constexpr std::size_t kUnknownsPerTask = 2048;
  const BlockPattern& blocks = *A.pattern;
  const Adjacency& rings = topology_.rings;
  const auto add_to_column = [&](std::size_t c) {
    const Index v = constraints_.unknowns.vertices[c];
    for (std::size_t e = rings.starts[v]; e < rings.starts[v + 1]; ++e) {
      const Index j = rings.values[e];
      const double k = (is_row_[j] != 0 ? 2.0 : 1.0) * weights_->stiffness[e];
      A.values[blocks.starts[c]] += k;
      const Index r = constraints_.unknowns.of_vertex[j];
      if (r == kNoIndex || r < c) continue;
      const auto column = blocks.column(c);
      const auto at = std::lower_bound(column.begin(), column.end(), r) - column.begin();
      A.values[blocks.starts[c] + static_cast<std::size_t>(at)] -= k;
    }
  };
  parallel_for(size(), kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) add_to_column(c);
  });
}

void LaplacianSystem::multiply(std::span<const Vector3d> u, std::span<double> y) const {
  constexpr std::size_t kUnknownsPerTask = 2048;
  std::vector<double> rows(3 * L_.size());
  lapwing::multiply(L_, u, rows);
  pattern_.normal().multiply_transposed(L_, rows, y);
  add_spring_product(springs_, constraints_.unknowns, u, y);
  if (weights_->stiffness.empty()) return;
  const Adjacency& rings = topology_.rings;
  parallel_for(size(), kUnknownsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Index v = constraints_.unknowns.vertices[k];
      for (std::size_t e = rings.starts[v]; e < rings.starts[v + 1]; ++e) {
        const Index j = rings.values[e];
        Eigen::Map<Vector3d>(y.data() + 3 * k) +=
            (is_row_[j] != 0 ? 2.0 : 1.0) * weights_->stiffness[e] * (u[v] - u[j]);
      }
    }
  });
}

void LaplacianSystem::right_hand_side(std::span<const Vector3d> prescribed,
                                      std::span<double> b) const {
  const std::size_t n = size();
  const Unknowns& unknowns = constraints_.unknowns;
  const std::vector<Vector3d> given = dirichlet_values(roi_, unknowns, prescribed);
  std::vector<double> moved(3 * n, 0.0);
  if (!given.empty()) multiply(given, moved);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = prescribed[unknowns.vertices[k]][static_cast<Eigen::Index>(axis)];
      b[axis * n + k] = constraints_.W[k] * d - moved[3 * k + axis];
    }
  }
}

void LaplacianSystem::add_spring_forces(std::span<double> b) const {
  const Numbers forces = spring_forces(springs_, constraints_.unknowns);
  for (std::size_t k = 0; 3 * k < forces.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) b[axis * size() + k] += forces[3 * k + axis];
  }
}

void LaplacianSystem::solve_in_elimination_order(std::span<double> columns_of_b,
                                                 std::size_t columns) const {
  if (size() > 0) factor_.solver().solve_in_places(columns_of_b, columns, places_);
}

void LaplacianSystem::solve_in_place(std::span<double> columns_of_b, std::size_t columns) const {
  if (size() > 0) factor_.solver().solve(columns_of_b, columns_of_b, columns);
}

}  // namespace lapwing
