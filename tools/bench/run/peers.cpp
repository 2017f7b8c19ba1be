#include <array>
#include <memory>
#include <vector>

#include <Eigen/SparseCore>

#include "run/bench_run.h"
#include "run/edit_parts.h"
#include "solvers/peer_solvers.h"

#ifdef LAPWING_HAVE_CGAL
#include "run/cgal_arap.h"
#endif

namespace lapwing::bench {
namespace {

// Largest meshes, in vertices. Beyond them a peer takes minutes or gigabytes.
constexpr std::size_t kMostForEigenProduct = 120'000;
[[maybe_unused]] constexpr std::size_t kMostForCholmod = 120'000;
[[maybe_unused]] constexpr std::size_t kMostForArap = 120'000;

using Sparse = Eigen::SparseMatrix<double>;

Sparse as_sparse(const BlockRows& M, std::size_t vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * M.columns.size());
  for (std::size_t r = 0; r < M.size(); ++r) {
    for (std::size_t b = M.starts[r]; b < M.starts[r + 1]; ++b) {
      for (std::size_t k = 0; k < 9; ++k) {
        entries.emplace_back(static_cast<int>(3 * r + k % 3),
                             static_cast<int>(3 * M.columns[b] + k / 3), M.values[9 * b + k]);
      }
    }
  }
  Sparse S(static_cast<int>(3 * M.size()), static_cast<int>(3 * vertex_count));
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

void measure_product(BenchRun& run, const BlockRows& M) {
  const Subject& subject = run.subject();
  if (!run.wants_peer("normal matrix", "Eigen")) return;
  const Sparse S = as_sparse(M, subject.vertices());
  const Sparse St = S.transpose();
  run.measure_peer("normal matrix", "Eigen", [&] { const Sparse N = St * S; });
}

// Factorizes our matrix, in our order of its blocks.
void measure_factorization(BenchRun& run, const EditParts& parts, const BlockRows& M,
                           std::unique_ptr<BlockSolver> solver, const char* by) {
  const bool wanted = run.wants_peer("analyze", by) || run.wants_peer("factor", by) ||
                      run.wants_peer("response", by);
  if (!wanted) return;
  const BlockMatrix N = parts.pattern->normal().normal_matrix(M, parts.constraints.W);
  const auto analyze = [&] { solver->analyze(parts.pattern->blocks(), 3, parts.pattern->order()); };
  if (run.measure_peer("analyze", by, analyze) == nullptr) analyze();
  if (run.measure_peer("factor", by, [&] { solver->factorize(N); }) == nullptr)
    solver->factorize(N);
  std::vector<double> x(kResponseColumns * N.scalar_size(), 1.0);
  run.measure_peer(
      "response", by, [&] { solver->solve(x, x, kResponseColumns); },
      [&] { std::fill(x.begin(), x.end(), 1.0); });
  const auto one = std::span(x).first(N.scalar_size());
  run.measure_peer(
      "back-substitution", by, [&] { solver->solve(one, one, 1); },
      [&] { std::fill(x.begin(), x.end(), 1.0); });
}

#ifdef LAPWING_HAVE_CGAL
// Moves the handle from rest to the end of its motion and back, as our rows do. Each frame begins
// where the last one ended.
void measure_arap(BenchRun& run) {
  const Subject& subject = run.subject();
  constexpr const char* kArap = "CGAL ARAP";
  constexpr int kMostIterations = 200;
  const bool wanted = run.wants_peer("preparation", kArap) ||
                      run.wants_peer("settle iteration", kArap) ||
                      run.wants_peer("settle frame", kArap);
  if (!wanted) return;
  const auto arap = make_cgal_arap(subject.mesh, subject.region, ArapVariant::spokes_and_rims);
  if (run.measure_peer("preparation", kArap, [&] { arap->prepare(); }) == nullptr) {
    arap->prepare();
  }
  MovingHandle handle(subject);
  run.measure_peer(
      "settle iteration", kArap, [&] { arap->iterate(1, 0.0); },
      [&] { arap->move(handle.next()); });
  int iterations = 0;
  Measurement* const row = run.measure_peer(
      "settle frame", kArap, [&] { iterations = arap->iterate(kMostIterations); },
      [&] { arap->move(handle.next()); });
  if (row != nullptr) row->counts["iterations"] = static_cast<std::uint64_t>(iterations);
}
#endif

}  // namespace

void measure_peers(BenchRun& run) {
  const Subject& subject = run.subject();
  if (!run.settings().peers) return;
#ifdef LAPWING_HAVE_CGAL
  if (subject.vertices() <= kMostForArap) measure_arap(run);
#endif
  if (subject.vertices() > kMostForEigenProduct) return;
  const EditParts parts(subject);
  const BlockRows M = assemble_rsi_rows(*run.processor().kernels, parts.ring_problem(subject));
  measure_product(run, M);
  if (subject.vertices() <= run.settings().most_for_eigen) {
    measure_factorization(run, parts, M, make_eigen_solver(), "Eigen");
  }
#ifdef LAPWING_HAVE_CHOLMOD
  if (subject.vertices() <= kMostForCholmod) {
    measure_factorization(run, parts, M, make_cholmod_solver(), "CHOLMOD");
  }
#endif
}

}  // namespace lapwing::bench
