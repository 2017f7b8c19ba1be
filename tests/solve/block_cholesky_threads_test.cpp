// Tests that results do not depend on the number of threads, and events while threads run.

#include <atomic>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "lapwing/solve/ordering.h"
#include "solve/test_matrices.h"
#include "support/sanitizers.h"

namespace lapwing {
namespace {

using namespace test;

BlockCholeskyOptions with_threads(unsigned threads) {
  BlockCholeskyOptions options;
  options.threads = threads;
  return options;
}

// The number of runs of tests that depend on timing. ThreadSanitizer needs fewer runs, because it
// detects races even if they do no harm in a run; it is also slow.
#ifdef LAPWING_THREAD_SANITIZER
constexpr int kRuns = 10;
#else
constexpr int kRuns = 70;
#endif

// Large enough that the fronts at the top are shared.
OwnedMatrix shared_system() {
  return rsi_matrix(icosphere(4), 1.0, 100);
}

void expect_the_same_bits(FactorPrecision precision) {
  for (const OwnedMatrix& A : {shared_system(), laplacian_matrix(grid(120, 120), 1.0, 50)}) {
    for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
      const auto order = fill_reducing_order(*A.pattern, ordering);
      const auto b = random_vector(17 * A.matrix.scalar_size(), 3);
      std::vector<double> expected;
      for (const unsigned threads : {1U, 2U, 3U, 4U, 8U}) {
        BlockCholeskyOptions options = with_threads(threads);
        options.precision = precision;
        BlockCholesky solver(options);
        solver.analyze(*A.pattern, A.matrix.block_size, order);
        solver.factorize(A.matrix);
        std::vector<double> x(b.size());
        for (const std::size_t columns : {1, 3, 13}) {
          const std::size_t first = columns == 1 ? 0 : columns == 3 ? 1 : 4;
          const std::size_t n = A.matrix.scalar_size();
          solver.solve(std::span(b).subspan(first * n, columns * n),
                       std::span(x).subspan(first * n, columns * n), columns);
        }
        if (expected.empty()) expected = x;
        EXPECT_EQ(x, expected) << threads << " threads";
      }
    }
  }
}

TEST(BlockCholeskyThreads, GiveTheSameBits) {
  expect_the_same_bits(FactorPrecision::float64);
}

TEST(BlockCholeskyThreads, GiveTheSameBitsInFloats) {
  expect_the_same_bits(FactorPrecision::float32);
}

TEST(BlockCholeskyThreads, GiveTheSameBitsOnEveryRun) {
  const OwnedMatrix A = rsi_matrix(icosphere(3), 1.0, 40);
  const auto order = fill_reducing_order(*A.pattern);
  const auto b = random_vector(A.matrix.scalar_size(), 3);
  std::vector<double> expected;
  for (const unsigned threads : {1U, 2U, 4U}) {
    BlockCholesky solver(with_threads(threads));
    solver.analyze(*A.pattern, 3, order);
    for (int run = 0; run < kRuns; ++run) {
      solver.factorize(A.matrix);
      std::vector<double> x(b.size());
      solver.solve(b, x, 1);
      if (expected.empty()) expected = x;
      ASSERT_EQ(x, expected) << "run " << run << ", " << threads << " threads";
    }
  }
}

TEST(BlockCholeskyThreads, RefuseTheSameBlock) {
  OwnedMatrix A = shared_system();
  std::mt19937 random(1);
  for (int k = 0; k < 8; ++k) {
    add_to_diagonal(A.matrix, static_cast<Index>(random() % A.pattern->size()), -50.0);
  }
  std::string expected;
  for (const unsigned threads : {1U, 2U, 4U}) {
    BlockCholesky solver(with_threads(threads));
    for (int run = 0; run < 10; ++run) {
      try {
        solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1));
        FAIL() << "an indefinite matrix was factored";
      } catch (const NotPositiveDefinite& error) {
        if (expected.empty()) expected = error.what();
        EXPECT_EQ(error.what(), expected);
      }
    }
  }
}

TEST(BlockCholeskyThreads, ReportRisingProgressOnTheCallingThread) {
  const OwnedMatrix A = shared_system();
  BlockCholesky solver(with_threads(2));
  const auto caller = std::this_thread::get_id();
  std::vector<double> fractions;
  solver.set_progress([&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "factor");
    EXPECT_TRUE(std::this_thread::get_id() == caller);
    fractions.push_back(fraction);
    return true;
  });
  solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1));
  ASSERT_GE(fractions.size(), 2U);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

TEST(BlockCholeskyThreads, StopWhenCancelledAndFactorAgain) {
  const OwnedMatrix A = shared_system();
  const auto b = random_vector(A.matrix.scalar_size(), 1);
  BlockCholesky undisturbed(with_threads(1));
  const auto expected = solve_with(undisturbed, A.matrix, b);
  const auto order = fill_reducing_order(*A.pattern, Ordering::minimum_degree);
  std::mt19937 random(7);
  int cancelled = 0;
  for (const unsigned threads : {1U, 2U, 4U}) {
    BlockCholesky solver(with_threads(threads));
    solver.analyze(*A.pattern, 3, order);
    for (int trial = 0; trial < kRuns; ++trial) {
      int calls = static_cast<int>(random() % 6);
      solver.set_progress([&](std::string_view, double) { return calls-- > 0; });
      try {
        solver.factorize(A.matrix);
      } catch (const Cancelled&) {
        ++cancelled;
      }
    }
    solver.set_progress({});
    solver.factorize(A.matrix);
    std::vector<double> x(b.size());
    solver.solve(b, x, 1);
    EXPECT_EQ(x, expected);
  }
  EXPECT_GE(cancelled, kRuns / 2);
}

TEST(BlockCholeskyThreads, PassOnWhatTheProgressCallbackThrows) {
  const OwnedMatrix A = shared_system();
  BlockCholesky solver(with_threads(2));
  solver.set_progress([](std::string_view, double fraction) -> bool {
    if (fraction > 0.0) throw InputError("the callback's own error");
    return true;
  });
  EXPECT_THROW(solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1)), InputError);
}

}  // namespace
}  // namespace lapwing
