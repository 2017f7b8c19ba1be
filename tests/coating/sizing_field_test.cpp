#include "lapwing/coating/sizing_field.h"

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

constexpr Index kSourceCells = 16;

// For the unit square with so many cells on a side, to carry the detail of one with kSourceCells.
SizingField carried_to(Index cells) {
  const PatchedMesh source(grid(kSourceCells, kSourceCells));
  const PatchedMesh target(grid(cells, cells));
  CorrespondenceOptions options{.domain = Domain::square};
  const std::vector<Index> from = corners(kSourceCells);
  const std::vector<Index> to = corners(cells);
  for (std::size_t c = 0; c < 4; ++c) options.boundary_pairs.push_back({from[c], to[c]});
  const Correspondence map = correspond(source.placed(), target.placed(), options, "test");
  return {peel_cotangent(source, 0.1), target.patch, target.own, map.points};
}

// Of the edges of a grid two in three are sides of cells, one is a diagonal.
double mean_edge(Index cells) {
  return (2.0 + std::numbers::sqrt2) / (3.0 * static_cast<double>(cells));
}

TEST(SizingField, KeepsTheTrianglesOfTheSourceItself) {
  EXPECT_FALSE(carried_to(kSourceCells).asks_for_remeshing());
}

TEST(SizingField, KeepsTrianglesThatAreFineEnough) {
  EXPECT_FALSE(carried_to(2 * kSourceCells).asks_for_remeshing());
}

TEST(SizingField, AsksForMoreWhereEveryOtherVertexOfTheSourceIsMissing) {
  EXPECT_TRUE(carried_to(kSourceCells / 2).asks_for_remeshing());
}

TEST(SizingField, AsksForFinerTrianglesThanTheSourceHasWhereTheyAreOthers) {
  const SizingField length = carried_to(kSourceCells - 1);
  EXPECT_TRUE(length.asks_for_remeshing());
  const double wanted = SizingField::kFineness * mean_edge(kSourceCells);
  EXPECT_NEAR(length(Vector3d(0.46, 0.53, 0.0)), wanted, 0.05 * wanted);
}

}  // namespace
}  // namespace lapwing::test
