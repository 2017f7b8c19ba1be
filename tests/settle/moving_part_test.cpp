#include "lapwing/settle/moving_part.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::IsEmpty;

// A sheet of which every seventh vertex is given; unknowns in descending order, since an order of
// elimination may be any.
class MovingPart : public ::testing::Test {
 protected:
  MovingPart() {
    for (Index v = static_cast<Index>(sheet_.vertex_count()); v-- > 0;) {
      if (v % 7 != 0) unknowns_.push_back(v);
    }
    std::vector<Index> rows = unknowns_;
    for (Index v = 0; v < sheet_.vertex_count(); v += 7) rows.push_back(v);
    const EnergyWeights weights =
        energy_weights(sheet_.topology(), sheet_.positions, rows, {.detail_length = 0.1});
    rings_ = region_rings(sheet_.topology(), sheet_.positions, weights, rows, unknowns_);
    step_.resize(3 * unknowns_.size());
  }
  // The vertex of unknown `k` goes by `length`.
  void go(std::size_t k, std::size_t axis, double length) {
    step_[axis * unknowns_.size() + k] = length;
  }

  const Mesh sheet_ = grid(40, 40);
  std::vector<Index> unknowns_;
  RegionRings rings_;
  std::vector<double> step_;
};

TEST_F(MovingPart, IsWhatMovesAndTheUnknownsOfThreeRingsAround) {
  const Index moved = unknowns_[800];
  go(800, 1, -0.4);
  go(3, 2, 0.01);  // far less than the other
  const std::vector<Index> part = moving_part(rings_, step_, 0.4);
  EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
  // Breadth first, through unknowns alone.
  std::vector<int> ring_of(sheet_.vertex_count(), -1);
  std::vector<Index> front{moved};
  ring_of[moved] = 0;
  std::size_t count = 1;
  for (int ring = 1; ring <= 3; ++ring) {
    std::vector<Index> next;
    for (const Index v : front) {
      for (const Index j : sheet_.topology().rings[v]) {
        if (j % 7 == 0 || ring_of[j] >= 0) continue;
        ring_of[j] = ring;
        next.push_back(j);
      }
    }
    count += next.size();
    front = next;
  }
  EXPECT_EQ(part.size(), count);
  for (const Index v : part) EXPECT_GE(ring_of[v], 0) << "vertex " << v;
}

TEST_F(MovingPart, IsEmptyWhereManyMove) {
  for (std::size_t k = 0; k < unknowns_.size(); k += 3) go(k, 0, 0.4);
  EXPECT_THAT(moving_part(rings_, step_, 0.4), IsEmpty());
}

}  // namespace
}  // namespace lapwing
