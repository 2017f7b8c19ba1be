#include "lapwing/doctor/holes.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(FindHoles, ClosedMeshesHaveNone) {
  EXPECT_THAT(find_holes(icosphere(1)), IsEmpty());
  EXPECT_THAT(find_holes(Mesh{}), IsEmpty());
}

TEST(FindHoles, TheRimHasTheOrientationOfAFaceThatClosesIt) {
  Mesh mesh = icosphere(1);
  const auto face = mesh.face(7);
  std::vector<Index> corners(face.begin(), face.end());
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  KeepMask keep(mesh.face_count(), 1);
  keep[7] = 0;
  keep_faces(mesh, keep);
  const std::vector<Hole> holes = find_holes(mesh);
  ASSERT_THAT(holes, SizeIs(1));
  EXPECT_EQ(holes[0].rim, corners);
  EXPECT_FALSE(holes[0].is_border);
  EXPECT_THAT(holes[0].trouble, IsEmpty());
}

TEST(FindHoles, TheLongestLoopOfAFlatPartIsItsBorder) {
  Mesh mesh = grid(5, 5);
  mesh.positions.resize(36);
  KeepMask keep(36, 1);
  keep[14] = 0;  // an inner vertex
  keep_vertices(mesh, keep);
  const std::vector<Hole> holes = find_holes(mesh);
  ASSERT_THAT(holes, SizeIs(2));
  EXPECT_THAT(holes[0].rim, SizeIs(20));
  EXPECT_TRUE(holes[0].is_border);
  EXPECT_FALSE(holes[1].is_border);
  EXPECT_THAT(chosen(holes, {}), SizeIs(1));
  EXPECT_THAT(chosen(holes, {.borders = true}), SizeIs(2));
  EXPECT_THAT(chosen(holes, {.most_rim_vertices = 19, .borders = true}), SizeIs(1));
}

TEST(FindHoles, UnweldedSeamsAreNoHoles) {
  Mesh mesh = icosphere(1);
  Mesh soup;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto first = static_cast<Index>(soup.vertex_count());
    for (const Index v : mesh.face(f)) soup.positions.push_back(mesh.positions[v]);
    add_polygon(soup, {first, first + 1, first + 2});
  }
  EXPECT_THAT(find_holes(soup), IsEmpty());
}

TEST(FindHoles, RimsThatAreNotManifoldHaveATrouble) {
  for (const Hole& hole : find_holes(three_winged_edge())) {
    EXPECT_THAT(hole.trouble, HasSubstr("more than two faces"));
  }
  EXPECT_THAT(find_holes(three_winged_edge())[0].trouble, HasSubstr("--fix OUT"));
  Mesh nowhere = cylinder(5, 2, 1.0, 9.0);
  nowhere.positions[2].x() = std::numeric_limits<double>::quiet_NaN();
  const auto holes = find_holes(nowhere);
  EXPECT_THAT(holes[0].trouble, HasSubstr("vertex 2 is not finite"));
}

// The sheet without two squares that touch at the inner vertex 12.
Mesh sheet_with_touching_holes() {
  Mesh mesh = grid(4, 4);
  KeepMask keep(mesh.face_count(), 1);
  for (const std::size_t square : {5, 10}) keep[2 * square] = keep[2 * square + 1] = 0;
  keep_faces(mesh, keep);
  return mesh;
}

TEST(FindHoles, HolesThatTouchAtAVertexAreTwo) {
  const std::vector<Hole> holes = find_holes(sheet_with_touching_holes());
  ASSERT_THAT(holes, SizeIs(3));
  EXPECT_TRUE(holes[0].is_border);
  for (const std::size_t k : {1, 2}) {
    EXPECT_THAT(holes[k].rim, SizeIs(4));
    EXPECT_THAT(holes[k].rim, Contains(12));
    EXPECT_NEAR(holes[k].perimeter, 1.0, 1e-12);
    EXPECT_THAT(holes[k].trouble, IsEmpty());
  }
}

TEST(FindHoles, HolesThatTouchAtTwoVerticesOfOnePlaceAreTwo) {
  Mesh mesh = sheet_with_touching_holes();
  fix(mesh);
  EXPECT_EQ(mesh.vertex_count(), 26U);
  EXPECT_THAT(find_holes(mesh), SizeIs(3));
}

TEST(FindHoles, ASingleFaceIsNotFilledByItsReverse) {
  Mesh mesh = cylinder(6, 2, 1.0, 9.0);
  const auto first = static_cast<Index>(mesh.vertex_count());
  for (const double x : {5.0, 6.0, 7.0}) mesh.positions.emplace_back(x, x * x, 0.0);
  add_polygon(mesh, {first, first + 1, first + 2});
  const std::vector<Hole> holes = find_holes(mesh);
  ASSERT_THAT(holes, SizeIs(3));
  EXPECT_THAT(holes[0].trouble, IsEmpty());
  EXPECT_THAT(holes[2].trouble, HasSubstr("single face"));
}

TEST(FindHoles, FacesOfOppositeOrientationAtTheRimAreATrouble) {
  Mesh mesh = cylinder(6, 2, 1.0, 9.0);
  Faces& faces = mesh.edit_faces();
  std::swap(faces.vertices[0], faces.vertices[1]);
  EXPECT_THAT(find_holes(mesh)[0].trouble, HasSubstr("opposite orientations"));
}

TEST(FindHoles, NamesTheNumberOfRimVerticesAndAPlace) {
  EXPECT_EQ(name_hole(find_holes(cylinder(6, 2, 1.0, 9.0))[1]),
            "the hole with 6 rim vertices at vertex 6");
}

}  // namespace
}  // namespace lapwing
