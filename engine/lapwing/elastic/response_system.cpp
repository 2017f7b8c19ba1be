#include "lapwing/elastic/response_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/normal_matrix.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Refinement stops below this relative residual, which is about the rounding error of the blended
// columns.
constexpr double kGoodResidual = 1e-10;
constexpr int kMostRefinements = 2;

// Factor of G if components can rotate freely. It leaves 1e-6 of A in the tangent, far more than
// rounding errors.
const double kRootOfTurningShare = std::sqrt(1.0 - 1e-6);

double norm(std::span<const double> v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

std::string component_of(Index vertex, const Topology& topology, const Unknowns& unknowns) {
  const Components components = connected_components(topology.rings);
  std::size_t size = 0;
  Index first = kNoIndex;
  for (const Index v : unknowns.vertices) {
    if (components.of_vertex[v] != components.of_vertex[vertex]) continue;
    ++size;
    first = std::min(first, v);
  }
  return "the component of " + std::to_string(size) + " vertices whose first is vertex " +
         std::to_string(first);
}

// Enlarges the diagonal, so that rounding errors in directions without stiffness, such as a hinge
// between two triangles, do not make the matrix indefinite. kShare is slightly greater than the
// solver's tolerance for pivots.
void brace(BlockMatrix& N) {
  constexpr double kShare = 3e-13;
  for (std::size_t c = 0; c < N.pattern->size(); ++c) {
    double* block = N.values.data() + 9 * N.pattern->starts[c];
    for (std::size_t k = 0; k < 3; ++k) block[4 * k] *= 1.0 + kShare;
  }
}

}  // namespace

BlockMatrix energy_hessian(const SystemPattern& pattern, const LaplacianSystem& laplacian,
                           const BlockRows& G, Numbers memory) {
  BlockMatrix N =
      pattern.normal().reduced_matrix(laplacian.unconstrained_matrix(), G, std::move(memory));
  brace(N);
  return N;
}

std::shared_ptr<BlockRows> tangent_rows(const Topology& topology, std::span<const Index> roi,
                                        const LaplacianSystem& laplacian,
                                        std::span<const Vector3d> rest, Kernels& kernels) {
  auto rows = std::make_shared<BlockRows>(rsi_rows(topology.rings, roi));
  const EnergyWeights& weights = laplacian.weights();
  kernels.assemble_tangent(
      {{rest, topology.rings, weights.laplacian, roi}, weights.rows, weights.stiffness},
      rows->values);
  return rows;
}

ResponseSystem::ResponseSystem(const Topology& topology, std::span<const Index> roi,
                               const Unknowns& unknowns, const SystemPattern& pattern,
                               LinearResponse kind)
    : topology_(topology),
      pattern_(pattern),
      kind_(kind),
      roi_(roi.begin(), roi.end()),
      constraints_{unknowns, {}},
      factor_(pattern, 3) {}

void ResponseSystem::analyze(const Progress& progress, StageTimings& timings) {
  if (is_analyzed()) return;
  const Stopwatch watch;
  report_progress(progress, "analyze", 0.0);
  factor_.analyze();
  timings.add("analyze", watch.elapsed_ms());
}

std::size_t ResponseSystem::memory_bytes() const {
  std::size_t blocks = pattern_.blocks().rows.size();  // blocks of N, then of the rows
  for (const Index v : roi_) blocks += 1 + topology_.rings.size(v);
  return 9 * sizeof(double) * blocks + factor_.solver().statistics().peak_bytes;
}

void ResponseSystem::assemble(std::span<const Vector3d> rest, bool turns_freely,
                              std::shared_ptr<const BlockRows> rows, Kernels& kernels,
                              const Progress& progress, StageTimings& timings) {
  Stopwatch watch;
  const auto stage_is_done = [&](const char* stage) {
    timings.add(stage, watch.elapsed_ms());
    watch.restart();
  };
  const auto make_rows = [&] {
    report_progress(progress, "assemble", 0.0);
    rows_.reset();  // frees the rows of the last rest shape
    rows_ = made_rows(rest, turns_freely, std::move(rows), kernels);
    stage_is_done("assemble");
  };
  if (is_analyzed()) {
    make_rows();
  } else {
    // All threads search for the order. Then the symbolic factorization runs on one thread, in
    // parallel to the assembly of the rows. The assembly of N, which takes longer, uses all threads
    // again.
    report_progress(progress, "assemble", 0.0);
    pattern_.factorization_order();
    const double ordering_ms = watch.elapsed_ms();
    watch.restart();
    const auto make_rows_first = [&] {
      make_rows();
      report_progress(progress, "analyze", 0.0);
    };
    const auto analyze = [&] { factor_.analyze(); };
    if (pattern_.has_analysis()) {
      make_rows_first();
      analyze();
    } else {
      parallel_invoke(make_rows_first, analyze);
    }
    timings.add("analyze", ordering_ms + watch.elapsed_ms());
    watch.restart();
  }
  report_progress(progress, "normal_matrix", 0.0);
  Numbers memory = factor_.take_memory();
  if (kind_ == LinearResponse::tangent) {
    factor_.set_matrix(energy_hessian(pattern_, *laplacian_, *rows_, std::move(memory)));
  } else {
    BlockMatrix N = pattern_.normal().normal_matrix(*rows_, {}, std::move(memory));
    add_springs(laplacian_->springs(), constraints_.unknowns, N);
    factor_.set_matrix(std::move(N));
  }
  stage_is_done("normal_matrix");
}

std::shared_ptr<const BlockRows> ResponseSystem::made_rows(std::span<const Vector3d> rest,
                                                           bool turns_freely,
                                                           std::shared_ptr<const BlockRows> rows,
                                                           Kernels& kernels) const {
  if (kind_ == LinearResponse::rsi) {
    auto made = std::make_shared<BlockRows>(rsi_rows(topology_.rings, roi_));
    kernels.assemble_rsi({rest, topology_.rings, laplacian_->weights().laplacian, roi_},
                         made->values);
    return made;
  }
  if (!turns_freely && rows != nullptr) return rows;
  auto made = tangent_rows(topology_, roi_, *laplacian_, rest, kernels);
  if (turns_freely) {
    for (double& value : made->values) value *= kRootOfTurningShare;
  }
  return made;
}

void ResponseSystem::factorize(std::span<const double> W, const Progress& progress,
                               StageTimings& timings) {
  if (factor_.is_factorized_for(W)) return;
  const Stopwatch watch;
  report_progress(progress, "factor", 0.0);
  constraints_.W.assign(W.begin(), W.end());
  try {
    factor_.factorize(W, progress);
  } catch (const NotPositiveDefinite& error) {
    const Index vertex = constraints_.unknowns.vertices[error.block];
    throw SolverError(
        "the system is singular at vertex " + std::to_string(vertex) + ", in " +
            component_of(vertex, topology_, constraints_.unknowns) +
            ": belt and handle do not hold this component. Add belt vertices there, exclude it "
            "from the region, or run `lapwing check` to find degenerate triangles",
        {vertex});
  }
  timings.add("factor", watch.elapsed_ms());
}

// Computes y = N u for the rows of the unknowns.
void ResponseSystem::multiply(std::span<const Vector3d> u, std::span<double> y) const {
  std::vector<double> rows(3 * rows_->size());
  lapwing::multiply(*rows_, u, rows);
  pattern_.normal().multiply_transposed(*rows_, rows, y);
  if (kind_ == LinearResponse::rsi) {
    return add_spring_product(laplacian_->springs(), constraints_.unknowns, u, y);
  }
  std::vector<double> held(y.size());
  laplacian_->multiply(u, held);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = held[i] - y[i];
}

void ResponseSystem::right_hand_side(std::span<const Vector3d> prescribed,
                                     std::span<double> b) const {
  // With hard constraints, the prescribed displacements move to the right-hand side. With soft
  // constraints, every constrained vertex is an unknown, so `given` is empty.
  const std::vector<Vector3d> given = dirichlet_values(roi_, constraints_.unknowns, prescribed);
  std::fill(b.begin(), b.end(), 0.0);
  if (!given.empty()) {
    multiply(given, b);
    for (double& number : b) number = -number;
  }
  for (std::size_t u = 0; u < constraints_.unknowns.size(); ++u) {
    if (!(constraints_.W[u] > 0.0)) continue;
    Eigen::Map<Vector3d>(b.data() + 3 * u) +=
        constraints_.W[u] * prescribed[constraints_.unknowns.vertices[u]];
  }
}

void ResponseSystem::solve_in_place(std::span<double> columns_of_b, std::size_t columns) const {
  if (constraints_.unknowns.size() > 0) factor_.solver().solve(columns_of_b, columns_of_b, columns);
}

double ResponseSystem::refine(std::span<const Vector3d> prescribed, std::span<const double> forces,
                              std::vector<Vector3d>& u) const {
  std::vector<double> r(3 * constraints_.unknowns.size());
  right_hand_side(prescribed, r);
  for (std::size_t i = 0; i < forces.size(); ++i) r[i] += forces[i];
  const double size = norm(r);
  if (size == 0.0) return 0.0;
  double relative = 0.0;
  for (int step = 0;; ++step) {
    // The residual at the unknowns is W (prescribed - u) + f - N u. This holds for hard and for
    // soft constraints.
    multiply(u, r);
    for (std::size_t k = 0; k < constraints_.unknowns.size(); ++k) {
      const Index v = constraints_.unknowns.vertices[k];
      Eigen::Map<Vector3d> r_k(r.data() + 3 * k);
      r_k = constraints_.W[k] * (prescribed[v] - u[v]) - r_k;
      if (!forces.empty()) r_k += Eigen::Map<const Vector3d>(forces.data() + 3 * k);
    }
    relative = norm(r) / size;
    if (!(relative > kGoodResidual) || step == kMostRefinements) return relative;
    solve_in_place(r, 1);
    for (std::size_t k = 0; k < constraints_.unknowns.size(); ++k) {
      u[constraints_.unknowns.vertices[k]] += Eigen::Map<const Vector3d>(r.data() + 3 * k);
    }
  }
}

}  // namespace lapwing
