#include "lapwing/region/boundary_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::vector<BoundaryLoop> loops_of(const Mesh& mesh) {
  return boundary_loops(mesh.topology().triangles, "mesh");
}

TEST(BoundaryLoops, AClosedMeshHasNone) {
  EXPECT_THAT(loops_of(icosphere(2)), IsEmpty());
}

TEST(BoundaryLoops, ASheetSeenFromAboveIsOnTheLeft) {
  EXPECT_THAT(loops_of(grid(2, 2)), ElementsAre(ElementsAre(0U, 1U, 2U, 5U, 8U, 7U, 6U, 3U)));
}

TEST(BoundaryLoops, ATubesEndsRunAgainstEachOther) {
  EXPECT_THAT(loops_of(cylinder(4, 3, 1.0, 1.0)),
              ElementsAre(ElementsAre(0U, 1U, 2U, 3U), ElementsAre(8U, 11U, 10U, 9U)));
}

TEST(BoundaryLoops, NameWhereTheBoundaryTouchesItself) {
  const auto message = error_message<InputError>([] { loops_of(bow_tie()); });
  EXPECT_THAT(message, AllOf(HasSubstr("mesh: the boundary touches itself at vertex 0"),
                             HasSubstr("lapwing check")));
}

TEST(BoundaryLoops, NameWhereTheBoundaryEndsAtATurnedEdge) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {1, 2, 3});
  EXPECT_THAT(error_message<InputError>([&] { loops_of(mesh); }),
              AllOf(HasSubstr("vertices 1, 2"), HasSubstr("opposite orientation")));
}

TEST(BoundaryLoops, NameWhereTheBoundaryEndsAtACrowdedEdge) {
  EXPECT_THAT(error_message<InputError>([] { loops_of(three_winged_edge()); }),
              AllOf(HasSubstr("vertices 0, 1"), HasSubstr("more than two triangles")));
}

TEST(BoundaryLoops, CrowdedEdgesAwayFromTheBoundaryDoNotMatter) {
  // A sheet with a closed tetrahedron on its middle edge.
  Mesh mesh = grid(4, 4);
  const Index top = 25;
  mesh.positions.emplace_back(0.5, 0.5, 1.0);
  mesh.positions.emplace_back(0.6, 0.5, 2.0);
  add_polygon(mesh, {12, 13, top});
  add_polygon(mesh, {13, 12, top + 1});
  add_polygon(mesh, {12, top, top + 1});
  add_polygon(mesh, {13, top + 1, top});
  EXPECT_THAT(loops_of(mesh), ElementsAre(SizeIs(16)));
}

}  // namespace
}  // namespace lapwing
