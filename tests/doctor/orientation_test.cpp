#include "lapwing/doctor/orientation.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Appends a copy of `part`.
void append(Mesh& mesh, const Mesh& part) {
  const auto first = static_cast<Index>(mesh.vertex_count());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (std::size_t f = 0; f < part.face_count(); ++f) {
    std::vector<Index> face(part.face(f).begin(), part.face(f).end());
    for (Index& v : face) v += first;
    mesh.add_face(face);
  }
}

// Returns a sphere of 42 vertices, oriented outward if `orientation` is '+', inward if it is '-'.
Mesh ball(double radius, char orientation,
          const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) {
  Mesh mesh = icosphere(1);
  for (Eigen::Vector3d& p : mesh.positions) p = center + radius * p;
  if (orientation == '-') turn_inside_out(mesh);
  return mesh;
}

// Returns nested spheres of 42 vertices, the largest first.
Mesh nested_balls(const std::string& orientations) {
  Mesh mesh;
  double radius = 1.0;
  for (const char orientation : orientations) {
    append(mesh, ball(radius, orientation));
    radius *= 0.5;
  }
  return mesh;
}

// Returns '+' for each sphere of 42 vertices that is oriented outward, and '-' for the others.
std::string orientations_of(const Mesh& mesh) {
  std::string orientations;
  for (std::size_t f = 0; f < mesh.face_count(); f += 80) {
    const auto face = mesh.face(f);
    const Eigen::Vector3d& a = mesh.positions[face[0]];
    const double volume = a.dot(mesh.positions[face[1]].cross(mesh.positions[face[2]]));
    orientations += volume > 0.0 ? '+' : '-';
  }
  return orientations;
}

std::vector<Index> first_of(const Mesh& mesh, DefectKind kind) {
  const CheckReport report = check(mesh);
  const Defect* const defect = report.find(kind);
  return defect == nullptr ? std::vector<Index>() : defect->first;
}

struct Nested {
  std::string given;
  std::vector<Index> inside_out;  ///< first vertex of each component that is inside out
  std::string repaired;

  friend void PrintTo(const Nested& n, std::ostream* out) { *out << n.given; }
};

class NestedBalls : public ::testing::TestWithParam<Nested> {};

TEST_P(NestedBalls, TurnUnlessTheyAreCavities) {
  Mesh mesh = nested_balls(GetParam().given);
  EXPECT_EQ(first_of(mesh, DefectKind::inside_out_part), GetParam().inside_out);
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::turned_parts), GetParam().inside_out.size());
  EXPECT_EQ(report.count(RepairKind::flipped_faces), 0U);
  EXPECT_EQ(orientations_of(mesh), GetParam().repaired);
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Orientation, NestedBalls,
    ::testing::Values(Nested{"+", {}, "+"}, Nested{"-", {0}, "+"}, Nested{"+-", {}, "+-"},
                      Nested{"++", {}, "++"},           // a component inside another
                      Nested{"-+", {0}, "+-"},          // a solid with a cavity, inside out
                      Nested{"--", {0, 42}, "++"},      // the above, inside out
                      Nested{"+-+", {}, "+-+"},         // a ball in a cavity
                      Nested{"+--", {84}, "+-+"},       // the above with an inside-out ball
                      Nested{"-+-", {0, 84}, "+-+"}));  // a ball in a cavity, inside out

TEST(InsideOut, PartsBesideOneAnotherAreJudgedAlone) {
  Mesh mesh;
  append(mesh, ball(1.0, '+'));
  append(mesh, ball(0.1, '-', {1.5, 0, 0}));      // outside all bounding boxes
  append(mesh, ball(0.1, '-', {0.9, 0.9, 0.9}));  // in the first ball's box only
  append(mesh, ball(0.1, '-', {0.1, 0.1, 0.1}));
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), ElementsAre(42, 84));
}

TEST(InsideOut, CavityInTheHandleOfATorusIsNoneInItsHole) {
  Mesh mesh = torus(24, 12, 2.0, 0.5);
  const auto first = static_cast<Index>(mesh.vertex_count());
  append(mesh, ball(0.2, '-', {2.0, 0, 0}));
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), IsEmpty());
  append(mesh, ball(0.2, '-'));
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), ElementsAre(first + 42));
}

TEST(InsideOut, CubesAlignedWithTheirCavitiesAreTold) {
  // Rays that start at the corners of one cube hit edges and diagonals of the other.
  Mesh mesh;
  for (const double size : {1.0, 0.5}) {
    Mesh cube;
    for (const int x : {0, 1}) {
      for (const int y : {0, 1}) {
        for (const int z : {0, 1})
          cube.positions.emplace_back(size * (2 * x - 1), size * (2 * y - 1), size * (2 * z - 1));
      }
    }
    for (const auto& quad : {std::array<Index, 4>{0, 1, 3, 2},
                             {4, 6, 7, 5},
                             {0, 4, 5, 1},
                             {2, 3, 7, 6},
                             {0, 2, 6, 4},
                             {1, 5, 7, 3}}) {
      cube.add_face(quad);
    }
    if (size < 1.0) turn_inside_out(cube);
    append(mesh, cube);
  }
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), IsEmpty());
  turn_inside_out(mesh);
  EXPECT_THAT(first_of(mesh, DefectKind::inside_out_part), ElementsAre(0));
}

TEST(InsideOut, DoesNotDependOnSizeOrPlace) {
  for (const double size : {1e-9, 1e9}) {
    EXPECT_THAT(first_of(ball(size, '-', size * Eigen::Vector3d(1e4, -1e4, 1e4)),
                         DefectKind::inside_out_part),
                ElementsAre(0));
  }
}

// Returns the faces of a sphere whose corners are all above `height`.
Mesh cap(double height, char orientation) {
  const Mesh sphere = icosphere(4);
  Mesh mesh;
  mesh.positions = sphere.positions;
  for (std::size_t f = 0; f < sphere.face_count(); ++f) {
    const auto face = sphere.face(f);
    const auto is_above = [&](Index v) { return sphere.positions[v].z() > height; };
    if (std::ranges::all_of(face, is_above)) mesh.add_face(face);
  }
  if (orientation == '-') turn_inside_out(mesh);
  fix(mesh);  // removes isolated vertices
  return mesh;
}

TEST(InwardOpen, IsAHintAboutParts) {
  const CheckReport report = check(cap(-0.5, '-'));
  ASSERT_NE(report.find(DefectKind::inward_open_part), nullptr);
  EXPECT_THAT(report.find(DefectKind::inward_open_part)->first, ElementsAre(0));
  EXPECT_FALSE(report.has_problems());
  EXPECT_FALSE(report.is_fixable());
}

TEST(InwardOpen, IsToldOfAHemisphereAndATubeButNotOfAShallowBowl) {
  EXPECT_THAT(first_of(cap(0.0, '-'), DefectKind::inward_open_part), ElementsAre(0));
  EXPECT_THAT(first_of(cap(0.5, '-'), DefectKind::inward_open_part), IsEmpty());
  EXPECT_THAT(first_of(cap(0.0, '+'), DefectKind::inward_open_part), IsEmpty());
  Mesh tube = cylinder(12, 6, 1.0, 3.0);
  EXPECT_THAT(first_of(tube, DefectKind::inward_open_part), IsEmpty());
  turn_inside_out(tube);
  EXPECT_THAT(first_of(tube, DefectKind::inward_open_part), ElementsAre(0));
}

TEST(FacingOf, IsThatOfTheComponent) {
  Mesh mesh = nested_balls("--");
  append(mesh, cap(-0.5, '-'));
  append(mesh, ball(0.1, '+', {5, 5, 5}));
  EXPECT_EQ(facing_of(mesh, 41), Facing::inside_out);
  EXPECT_EQ(facing_of(mesh, 42), Facing::inside_out);
  EXPECT_EQ(facing_of(mesh, 84), Facing::inward_open);
  EXPECT_EQ(facing_of(mesh, static_cast<Index>(mesh.vertex_count()) - 1), Facing::outward);
}

}  // namespace
}  // namespace lapwing
