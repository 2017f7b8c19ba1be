#include "lapwing/solve/block_cholesky/symbolic.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "lapwing/solve/block_cholesky/elimination_tree.h"
#include "solve/test_matrices.h"

namespace lapwing::cholesky {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<int> shuffled_order(std::size_t n, unsigned seed) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return order;
}

// Returns the rows below the diagonal of each column of the factor, found by elimination. Columns
// and rows are numbered by their position in the elimination order.
std::vector<std::set<int>> eliminated(const BlockPattern& pattern, std::span<const int> order) {
  std::vector<int> place(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) place[order[j]] = static_cast<int>(j);
  std::vector<std::set<int>> below(order.size());
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    for (const Index r : pattern.column(c)) {
      if (r != c) below[std::min(place[c], place[r])].insert(std::max(place[c], place[r]));
    }
  }
  for (const std::set<int>& column : below) {
    if (column.empty()) continue;
    std::set<int>& parent = below[*column.begin()];
    parent.insert(std::next(column.begin()), column.end());
  }
  return below;
}

// Returns matrices that include several components and columns without off-diagonal blocks.
std::vector<test::OwnedMatrix> matrices() {
  std::vector<test::OwnedMatrix> all;
  for (unsigned seed = 0; seed < 12; ++seed) {
    all.push_back(test::random_matrix(20 + 15 * seed, 1, 0.5 * seed, 1.0, seed));
  }
  return all;
}

TEST(EliminationGraph, HoldsEveryBlockOnceByTheColumnThatGoesFirst) {
  for (const test::OwnedMatrix& A : matrices()) {
    const BlockPattern& pattern = *A.pattern;
    const std::vector<int> order = shuffled_order(pattern.size(), 3);
    const EliminationGraph graph = elimination_graph(pattern, order);
    std::set<int> seen;
    for (int j = 0; j < graph.size(); ++j) {
      for (int e = graph.starts[j]; e < graph.starts[j + 1]; ++e) {
        const auto block = static_cast<std::size_t>(graph.blocks[e]);
        EXPECT_LT(j, graph.later[e]);
        EXPECT_TRUE(seen.insert(graph.blocks[e]).second);
        const auto row = static_cast<int>(pattern.rows[block]);
        const auto column =
            static_cast<int>(std::upper_bound(pattern.starts.begin(), pattern.starts.end(), block) -
                             pattern.starts.begin() - 1);
        EXPECT_EQ(std::minmax(order[j], order[graph.later[e]]), std::minmax(row, column));
      }
    }
    EXPECT_EQ(seen.size(), pattern.rows.size() - pattern.size());
  }
}

TEST(EliminationTree, IsThatOfAnElimination) {
  for (const test::OwnedMatrix& A : matrices()) {
    const std::vector<int> order = shuffled_order(A.pattern->size(), 5);
    const auto below = eliminated(*A.pattern, order);
    const EliminationTree tree = build_elimination_tree(elimination_graph(*A.pattern, order));
    ASSERT_EQ(tree.columns.size(), order.size());
    for (std::size_t j = 0; j < order.size(); ++j) {
      const std::set<int>& column = below[tree.columns[j]];
      EXPECT_EQ(tree.counts[j], 1 + static_cast<int>(column.size()));
      if (column.empty()) {
        EXPECT_EQ(tree.parent[j], -1);
      } else {
        ASSERT_GT(tree.parent[j], static_cast<int>(j)) << "a postorder";
        EXPECT_EQ(tree.columns[tree.parent[j]], *column.begin());
      }
    }
  }
}

// A front that groups columns may have more rows than the elimination, but not fewer.
TEST(AnalyzePattern, FrontsHaveTheRowsOfAnElimination) {
  for (const test::OwnedMatrix& A : matrices()) {
    const std::vector<int> order = shuffled_order(A.pattern->size(), 7);
    const Symbolic symbolic = analyze_pattern(*A.pattern, 1, order);
    const auto below = eliminated(*A.pattern, symbolic.order);
    for (const Front& front : symbolic.fronts) {
      const int end = front.first_block + front.pivot_blocks;
      const std::span rows(symbolic.rows.data() + front.rows_at,
                           static_cast<std::size_t>(front.update_blocks));
      EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
      std::set<int> wanted;
      for (int j = front.first_block; j < end; ++j) {
        wanted.insert(below[j].lower_bound(end), below[j].end());
      }
      EXPECT_TRUE(std::equal(rows.begin(), rows.end(), wanted.begin(), wanted.end()));
    }
  }
}

TEST(AnalyzePattern, EveryBlockGoesToOneFront) {
  for (const test::OwnedMatrix& A : matrices()) {
    const Symbolic symbolic = analyze_pattern(*A.pattern, 1, shuffled_order(A.pattern->size(), 9));
    std::vector<int> times(A.pattern->rows.size(), 0);
    std::size_t next = 0;
    for (const Front& front : symbolic.fronts) {
      EXPECT_EQ(front.entries_begin, next);
      for (; next < front.entries_end; ++next) ++times[symbolic.entries[next].source];
    }
    EXPECT_EQ(next, symbolic.entries.size());
    EXPECT_THAT(times, ::testing::Each(1));
  }
}

TEST(AnalyzePattern, OfNothingIsNothing) {
  const BlockPattern nothing;
  EXPECT_THAT(elimination_graph(nothing, {}).starts, ElementsAre(0));
  EXPECT_THAT(analyze_pattern(nothing, 3, {}).fronts, IsEmpty());
}

}  // namespace
}  // namespace lapwing::cholesky
