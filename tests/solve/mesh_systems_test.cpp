// The systems of real meshes: every mesh of Debian's libcgal-demo as a whole and random regions of
// it. Each is solved to a small backward error, or refused, and then it is shown to be singular.
#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "solve/test_matrices.h"
#include "solvers/peer_solvers.h"
#include "support/models.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::Lt;

// The references take most of the time.
#ifdef LAPWING_HAVE_CHOLMOD
constexpr std::size_t kLargestForCholmod = 10'000;
#else
constexpr std::size_t kLargestForEigen = 2'500;
#endif

BlockMatrix with_diagonal_times(const BlockMatrix& A, double factor) {
  BlockMatrix B = A;
  const auto b = static_cast<std::size_t>(A.block_size);
  for (std::size_t c = 0; c < A.pattern->size(); ++c) {
    double* block = B.values.data() + A.pattern->starts[c] * b * b;
    for (std::size_t k = 0; k < b; ++k) block[k * b + k] *= factor;
  }
  return B;
}

// x'Ax / x'Dx for the best x that a few inverse iterations find, D the diagonal of A. 0 where D has
// a zero.
double smallest_rayleigh_quotient(const BlockMatrix& A) {
  const std::size_t n = A.scalar_size();
  const auto b = static_cast<std::size_t>(A.block_size);
  std::vector<double> diagonal(n);
  for (std::size_t c = 0; c < A.pattern->size(); ++c) {
    for (std::size_t k = 0; k < b; ++k) {
      diagonal[c * b + k] = A.values[A.pattern->starts[c] * b * b + k * b + k];
      if (!(diagonal[c * b + k] > 0.0)) return 0.0;
    }
  }
  BlockCholesky shifted;
  std::vector<double> x =
      solve_with(shifted, with_diagonal_times(A, 1.0 + 1e-11), random_vector(n, 3));
  double quotient = 0.0;
  for (int step = 0; step < 4; ++step) {
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i) size += diagonal[i] * x[i] * x[i];
    for (std::size_t i = 0; i < n; ++i) x[i] /= std::sqrt(size);
    std::vector<double> Ax(n);
    multiply(A, x, Ax, 1);
    quotient = 0.0;
    for (std::size_t i = 0; i < n; ++i) quotient += x[i] * Ax[i];
    std::vector<double> Dx(n);
    for (std::size_t i = 0; i < n; ++i) Dx[i] = diagonal[i] * x[i];
    shifted.solve(Dx, x, 1);
  }
  return quotient;
}

struct Outcomes {
  std::size_t solved = 0;
  std::size_t refused = 0;
  std::size_t checked = 0;  // of those solved: the reference solves them too
};

// CHOLMOD where the build has it; null for what is too large.
std::unique_ptr<BlockSolver> reference_for(const BlockMatrix& A) {
  const std::size_t blocks = A.pattern->size();
#ifdef LAPWING_HAVE_CHOLMOD
  return blocks <= kLargestForCholmod ? bench::make_cholmod_solver() : nullptr;
#else
  return blocks <= kLargestForEigen ? bench::make_eigen_solver() : nullptr;
#endif
}

void solve_or_refuse(const BlockMatrix& A, Outcomes& outcomes) {
  const auto b = random_vector(A.scalar_size(), 1);
  BlockCholesky solver;
  std::vector<double> x;
  try {
    x = solve_with(solver, A, b);
  } catch (const NotPositiveDefinite& error) {
    EXPECT_LT(error.block, A.pattern->size());
    EXPECT_THAT(smallest_rayleigh_quotient(A), Lt(1e-11)) << error.what();
    ++outcomes.refused;
    return;
  }
  ++outcomes.solved;
  EXPECT_THAT(backward_error(A, x, b), Lt(kBackwardError));
  const auto reference = reference_for(A);
  if (reference == nullptr) return;
  try {
    const auto y = solve_with(*reference, A, b);
    EXPECT_THAT(backward_error(A, y, b), Lt(kBackwardError));
    ++outcomes.checked;
  } catch (const NotPositiveDefinite&) {
    // At the edge of what double precision can factor, rounding decides for each.
    EXPECT_THAT(smallest_rayleigh_quotient(A), Lt(1e-11));
  }
}

// `count` vertices around `seed`, breadth first and then ascending, the last fifth of them held.
struct RandomRegion {
  std::vector<Index> roi;
  std::vector<double> W;
};
RandomRegion region_around(const Topology& topology, Index seed, std::size_t count) {
  std::vector<Index> reached{seed};
  std::vector<char> seen(topology.vertex_count(), 0);
  seen[seed] = 1;
  for (std::size_t at = 0; at < reached.size() && reached.size() < count; ++at) {
    for (const Index w : topology.rings[reached[at]]) {
      if (seen[w] == 0) reached.push_back(w);
      seen[w] = 1;
    }
  }
  std::vector<char> held(topology.vertex_count(), 0);
  for (std::size_t k = reached.size() * 4 / 5; k < reached.size(); ++k) held[reached[k]] = 1;
  RandomRegion region;
  region.roi = std::move(reached);
  std::sort(region.roi.begin(), region.roi.end());
  for (const Index v : region.roi) region.W.push_back(held[v] != 0 ? 1.0 : 0.0);
  return region;
}

TEST(MeshSystems, AreSolvedOrRefusedRightly) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  std::mt19937 random(7);
  Outcomes outcomes;
  for (const auto& file : files) {
    SCOPED_TRACE(file);
    Mesh mesh;
    try {
      mesh = read_mesh(file);
    } catch (const Error&) {
      continue;  // broken on purpose
    }
    const Topology& topology = mesh.topology();
    if (topology.triangles.empty() || !bounds_of(mesh.positions).min.allFinite()) continue;
    solve_or_refuse(rsi_matrix(mesh, 1.0, 20).matrix, outcomes);
    solve_or_refuse(laplacian_matrix(mesh, 1.0, 20).matrix, outcomes);
    for (int k = 0; k < 2; ++k) {
      const auto seed = static_cast<Index>(random() % mesh.vertex_count());
      const RandomRegion region = region_around(topology, seed, 20 + random() % 2000);
      solve_or_refuse(rsi_matrix(mesh, region.roi, region.W).matrix, outcomes);
    }
  }
  std::printf("%zu solved, %zu of them as the reference does; %zu refused\n", outcomes.solved,
              outcomes.checked, outcomes.refused);
  EXPECT_GT(outcomes.solved, files.size());
}

TEST(MeshSystems, OfAHundredThousandBlocksAreSolved) {
  const OwnedMatrix A = laplacian_matrix(grid(330, 330), 1.0, 50);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  BlockCholesky solver;
  EXPECT_THAT(backward_error(A.matrix, solve_with(solver, A.matrix, b), b), Lt(kBackwardError));
}

}  // namespace
}  // namespace lapwing
