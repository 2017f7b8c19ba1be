#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/domain_map.h"
#include "parameterize/test_patches.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::hills;
using test::moved;
using test::placed;
using test::PlacedPatch;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

BoundaryPins pins_of(const Mesh& mesh, Domain domain) {
  const PlacedPatch patch = placed(mesh);
  return default_pins(patch.patch, patch.positions, domain);
}

Mesh stretched(Mesh mesh, double x, double y) {
  for (Vector3d& p : mesh.positions) p = {x * p.x(), y * p.y(), 0.0};
  return mesh;
}

TEST(DefaultPins, OfARectangleAreItsCorners) {
  EXPECT_THAT(pins_of(stretched(grid(6, 4), 3, 2), Domain::square), ElementsAre(0, 6, 34, 28));
  EXPECT_THAT(pins_of(grid(5, 5), Domain::square), ElementsAre(0, 5, 35, 30))
      << "a square is as wide along its diagonals";
  EXPECT_THAT(pins_of(moved(grid(5, 5)), Domain::square), ElementsAre(0, 5, 35, 30));
}

TEST(DefaultPins, OfADropIsItsTip) {
  // A disk drawn out to a tip at vertex 1 of the boundary.
  Mesh drop;
  drop.positions = {{0, 0, 0}};
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / 16;
    const double reach = k == 3 ? 4.0 : 1.0;
    drop.positions.emplace_back(reach * std::cos(angle), reach * std::sin(angle), 0.1);
  }
  for (Index k = 0; k < 16; ++k) {
    drop.add_face(std::array<Index, 3>{0, 1 + k, 1 + (k + 1) % 16});
  }
  EXPECT_THAT(pins_of(drop, Domain::disk), ElementsAre(4));
}

TEST(DefaultPins, MoveWithThePatchSymmetricOrNot) {
  Mesh wheel;  // as wide all around
  wheel.positions = {{0, 0, 0}};
  for (int k = 0; k < 7; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / 7;
    wheel.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  for (Index k = 0; k < 7; ++k) wheel.add_face(std::array<Index, 3>{0, 1 + k, 1 + (k + 1) % 7});
  for (const Mesh& mesh : {hills(), grid(6, 6), stretched(grid(6, 4), 3, 2), wheel}) {
    for (const Domain domain : {Domain::disk, Domain::square}) {
      EXPECT_EQ(pins_of(mesh, domain), pins_of(moved(mesh), domain));
    }
  }
}

TEST(DefaultPins, OfAStalkFollowItsFoot) {
  // A closed tube: all of the patch stands on its boundary.
  const Mesh stalk = [] {
    Mesh tube = cylinder(12, 8, 1.0, 6.0);
    for (Vector3d& p : tube.positions) p.x() *= 1.0 + 0.5 * (6.0 - p.z()) / 6.0;
    tube.positions.emplace_back(0, 0, 6.5);
    for (Index k = 0; k < 12; ++k) {
      tube.add_face(std::array<Index, 3>{84 + k, 84 + (k + 1) % 12, 96});
    }
    return tube;
  }();
  const BoundaryPins pins = pins_of(stalk, Domain::disk);
  ASSERT_EQ(pins.size(), 1U);
  EXPECT_GT(std::abs(stalk.positions[pins[0]].x()), 1.4) << "where the foot is widest";
  EXPECT_EQ(pins_of(moved(stalk), Domain::disk), pins);
}

std::string refusal(Domain domain, const BoundaryPins& pins) {
  const PlacedPatch patch = placed(grid(4, 4));
  return error_message<InputError>(
      [&] { mean_value_map(patch.patch, patch.positions, domain, pins); });
}

TEST(Pins, ThatDoNotFitTheDomainAreRefusedByName) {
  EXPECT_THAT(refusal(Domain::disk, {}),
              HasSubstr("the disk needs 1 pinned boundary vertex, got 0"));
  EXPECT_THAT(refusal(Domain::square, {0}),
              HasSubstr("the square needs 4 pinned boundary vertices"));
  EXPECT_THAT(refusal(Domain::disk, {12}), HasSubstr("vertex 12 cannot be pinned: it is not on"));
  EXPECT_THAT(refusal(Domain::disk, {400}), HasSubstr("cannot be pinned: it is not on"));
  EXPECT_THAT(refusal(Domain::square, {0, 24, 4, 20}), HasSubstr("are not in order"));
  EXPECT_THAT(refusal(Domain::square, {0, 20, 24, 4}), HasSubstr("are not in order"));
  EXPECT_THAT(refusal(Domain::square, {0, 4, 4, 20}),
              HasSubstr("the pins vertex 0, vertex 4, vertex 4, vertex 20 are not in order"));
  EXPECT_EQ(refusal(Domain::square, {4, 24, 20, 0}), "");
}

TEST(Pins, SquareNeedsFourBoundaryVertices) {
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.add_face(std::array<Index, 3>{0, 1, 2});
  EXPECT_THAT(error_message<InputError>([&] { pins_of(triangle, Domain::square); }),
              HasSubstr("the patch around vertex 0 has 3"));
}

TEST(BoundaryPoints, OfVerticesFallenTogetherStayApart) {
  Mesh mesh = grid(3, 3);
  mesh.positions[1] = mesh.positions[0];
  const PlacedPatch patch = placed(mesh);
  const auto points = boundary_points(patch.patch, patch.positions, Domain::disk, {0});
  EXPECT_GT((points[1] - points[0]).norm(), 1e-6);
}

}  // namespace
}  // namespace lapwing
