#include "lapwing/region/edit_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RegionSpec all() {
  return {AllVertices{}, "/roi"};
}
RegionSpec listed(std::vector<Index> vertices, std::string where) {
  return {ListedVertices{std::move(vertices)}, std::move(where)};
}
RegionSpec handle(std::vector<Index> vertices) {
  return listed(std::move(vertices), "/handles/0/region");
}

EditRegion resolved(const Mesh& mesh, const RegionSpec& roi, const BeltSpec& belt,
                    const std::vector<RegionSpec>& handles) {
  std::vector<HandleSpec> specs;
  for (const RegionSpec& region : handles) specs.push_back({region});
  return resolve_edit_region(roi, belt, specs, mesh, LoosePolicy::refuse);
}

std::string error_of(const Mesh& mesh, const RegionSpec& roi, const BeltSpec& belt,
                     const std::vector<RegionSpec>& handles) {
  return error_message<InputError>([&] { resolved(mesh, roi, belt, handles); });
}

Index nearest(const Mesh& mesh, const Vector3d& place) {
  const auto distance = [&](const Vector3d& p) { return (p - place).squaredNorm(); };
  return static_cast<Index>(std::ranges::min_element(mesh.positions, {}, distance) -
                            mesh.positions.begin());
}

Mesh beside(const Mesh& a, Mesh b) {
  for (Vector3d& p : b.positions) p.x() += 5.0;
  return test::joined(a, b);
}

TEST(BoundaryAnchors, OfADiskIsARingOfTheFractionsWidth) {
  const Mesh mesh = grid(40, 40);
  const Index center = 20 * 41 + 20;
  const RegionSpec disk{GeodesicDisk{center, 0.4}, "/roi"};
  const EditRegion region =
      resolved(mesh, disk, BoundaryAnchors{0.25, "/belt"}, {handle({center})});
  for (const Index v : region.roi) {
    const double radius = (mesh.positions[v] - mesh.positions[center]).norm();
    const bool in_belt = std::binary_search(region.belt.begin(), region.belt.end(), v);
    // The border runs along the grid, up to an edge diagonal (0.035) within the circle.
    if (radius > 0.31) {
      EXPECT_TRUE(in_belt) << radius;
    }
    if (radius < 0.26) {
      EXPECT_FALSE(in_belt) << radius;
    }
  }
}

TEST(BoundaryAnchors, OfFractionZeroIsTheBorder) {
  const Mesh mesh = grid(4, 4);
  const VertexSet roi{6, 7, 8, 11, 12, 13, 16, 17, 18};
  EXPECT_THAT(resolve_border_belt({0.0, "/belt"}, roi, {}, mesh).vertices,
              ElementsAre(6, 7, 8, 11, 13, 16, 17, 18));
}

TEST(BoundaryAnchors, OfAWholeOpenMeshFollowsTheMeshBoundary) {
  const Mesh mesh = grid(4, 4);
  const EditRegion region = resolved(mesh, all(), BoundaryAnchors{}, {handle({12})});
  EXPECT_EQ(region.belt.size(), 16U);
}

TEST(BoundaryAnchors, LeavesTheHandleOut) {
  const Mesh mesh = grid(4, 4);
  const EditRegion region = resolved(mesh, all(), BoundaryAnchors{}, {handle({0, 1, 12})});
  EXPECT_EQ(region.belt.size(), 14U);
  EXPECT_THAT(intersect(region.belt, region.handles[0]), IsEmpty());
}

TEST(BoundaryAnchors, IsEmptyOnAWholeClosedMesh) {
  const Mesh mesh = icosphere(1);
  const EditRegion region = resolved(mesh, all(), BoundaryAnchors{}, {handle({0, 1, 2})});
  EXPECT_THAT(region.belt, IsEmpty());
}

TEST(BoundaryAnchors, MeasuresEachComponentByItself) {
  Mesh small = grid(4, 4);
  for (Vector3d& p : small.positions) p *= 0.01;
  const Mesh mesh = beside(grid(10, 10), small);
  const EditRegion region = resolved(mesh, all(), BoundaryAnchors{0.25, "/belt"}, {handle({60})});
  EXPECT_EQ(subtract(region.roi, region.belt).front(), 24U);
  EXPECT_EQ(subtract(region.roi, region.belt).back(), 121U + 18U);
}

Mesh without_faces(const Mesh& mesh, const std::function<bool(const Vector3d&)>& is_cut) {
  Mesh cut;
  cut.positions = mesh.positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Vector3d centre = Vector3d::Zero();
    for (const Index v : mesh.face(f)) centre += mesh.positions[v] / 3.0;
    if (!is_cut(centre)) cut.add_face(mesh.face(f));
  }
  return cut;
}

VertexSet border_of(const Mesh& mesh, const std::vector<VertexSet>& handles) {
  VertexSet all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return resolve_border_belt({0.0, "/belt"}, all, handles, mesh).vertices;
}

const VertexSet kMiddle{10 * 21 + 10};

struct Hole {
  const char* name;
  std::function<bool(const Vector3d&)> is_cut;
};

class AHoleInASheet : public ::testing::TestWithParam<Hole> {};

TEST_P(AHoleInASheet, MovesAlong) {
  const Mesh whole = grid(20, 20);
  const Mesh holed = without_faces(whole, GetParam().is_cut);
  ASSERT_LT(holed.face_count(), whole.face_count());
  EXPECT_EQ(border_of(holed, {kMiddle}), border_of(whole, {kMiddle}));
  EXPECT_EQ(border_of(holed, {kMiddle, {0}}), border_of(whole, {kMiddle, {0}}));
  EXPECT_THAT(resolved(holed, all(), BoundaryAnchors{}, {handle(kMiddle)}).held_holes, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, AHoleInASheet,
    ::testing::Values(
        Hole{"OfOneTriangle",
             [](const Vector3d& p) { return (p - Vector3d(0.28, 0.27, 0)).norm() < 0.02; }},
        Hole{"LikeAMouth",
             [](const Vector3d& p) {
               return std::abs(p.y() - 0.3) < 0.05 && std::abs(p.x() - 0.5) < 0.2;
             }},
        Hole{"AtTheHandle",
             [](const Vector3d& p) { return (p - Vector3d(0.55, 0.55, 0)).norm() < 0.06; }},
        Hole{"AmongSeveral",
             [](const Vector3d& p) {
               return std::abs(std::fmod(p.x(), 0.25) - 0.125) < 0.04 &&
                      std::abs(std::fmod(p.y(), 0.25) - 0.125) < 0.04;
             }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BoundaryAnchors, OfADiskWithAHoleIsItsOuterBorder) {
  const Mesh whole = grid(40, 40);
  const Mesh holed = without_faces(
      whole, [](const Vector3d& p) { return (p - Vector3d(0.6, 0.5, 0)).norm() < 0.04; });
  const RegionSpec box{Box{{0.2, 0.2, -1.0}, {0.8, 0.8, 1.0}}, "/roi"};
  const std::vector<RegionSpec> handles{handle({20 * 41 + 20})};
  EXPECT_EQ(resolved(holed, box, BoundaryAnchors{0.0, "/belt"}, handles).belt,
            resolved(whole, box, BoundaryAnchors{0.0, "/belt"}, handles).belt);
}

// The rims of holes become anchors only if nothing else constrains the surface.
TEST(BoundaryAnchors, HoldTheRimsOfHolesOnlyIfNothingElseCanHoldTheSurface) {
  const Mesh holed = without_faces(icosphere(4), [](const Vector3d& p) { return p.z() < -0.97; });
  const Index top = nearest(holed, {0, 0, 1});
  const Index side = nearest(holed, {1, 0, 0});
  const EditRegion one = resolved(holed, all(), BoundaryAnchors{0.0, "/belt"}, {handle({top})});
  for (const Index v : one.belt) EXPECT_LT(holed.positions[v].z(), -0.9);
  EXPECT_THAT(one.belt, ::testing::SizeIs(::testing::Gt(10U)));
  ASSERT_THAT(one.held_holes, ::testing::SizeIs(1));
  EXPECT_EQ(one.held_holes[0], one.belt.front());
  const EditRegion two =
      resolve_edit_region(all(), BoundaryAnchors{},
                          std::array{HandleSpec{handle({top})}, HandleSpec{handle({side})}}, holed);
  EXPECT_THAT(two.belt, IsEmpty());
  EXPECT_THAT(two.held_holes, IsEmpty());
}

TEST(BoundaryAnchors, OfATubeAreTheEndsThatNoHandleHas) {
  const Mesh tube = cylinder(12, 41, 0.5, 20.0);
  VertexSet foot(12);
  std::iota(foot.begin(), foot.end(), Index{0});
  VertexSet head(12);
  std::iota(head.begin(), head.end(), Index{12 * 40});
  const VertexSet middle{12 * 20};
  EXPECT_EQ(border_of(tube, {middle}), unite(foot, head));
  EXPECT_EQ(border_of(tube, {head}), foot);
}

TEST(BoundaryAnchors, FractionOutsideZeroToOneIsRefused) {
  EXPECT_EQ(error_of(grid(4, 4), all(), BoundaryAnchors{1.5, "/belt"}, {handle({12})}),
            "/belt/fraction: expected a number from 0 to 1, got 1.5");
}

TEST(EditRegion, KeepsWhatWasAsked) {
  const EditRegion region = resolved(grid(4, 4), all(), listed({4, 0, 24}, "/belt"),
                                     {handle({13, 12}), listed({6}, "/handles/1/region")});
  EXPECT_EQ(region.roi.size(), 25U);
  EXPECT_THAT(region.belt, ElementsAre(0, 4, 24));
  EXPECT_THAT(region.handles, ElementsAre(ElementsAre(12, 13), ElementsAre(6)));
}

TEST(EditRegion, HandleInTheBeltIsRefusedWithItsVertices) {
  EXPECT_EQ(error_of(grid(4, 4), all(), listed({0, 1, 2, 3}, "/belt"), {handle({2, 3, 12})}),
            "/handles/0/region: the handle shares vertices 2, 3 with the belt. Remove them from "
            "one of the two, for example with \"minus\"");
}

TEST(EditRegion, LongListsOfVerticesAreCutAtEight) {
  const std::vector<Index> many{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_THAT(error_of(grid(4, 4), all(), listed(many, "/belt"), {handle(many)}),
              HasSubstr("vertices 0, 1, 2, 3, 4, 5, 6, 7 and 3 more"));
}

TEST(EditRegion, HandlesThatShareVerticesAreRefused) {
  EXPECT_THAT(error_of(grid(4, 4), all(), listed({0, 4, 24}, "/belt"),
                       {handle({12, 13}), listed({13}, "/handles/1/region")}),
              HasSubstr("/handles/1/region: the handle shares vertex 13 with handle 0"));
}

TEST(EditRegion, HandleAndBeltStayInTheRoi) {
  const RegionSpec roi = listed({6, 7, 8, 11, 12, 13, 16, 17, 18}, "/roi");
  EXPECT_THAT(error_of(grid(4, 4), roi, BoundaryAnchors{}, {handle({12, 24})}),
              HasSubstr("/handles/0/region: the handle extends beyond the ROI at vertex 24"));
  EXPECT_THAT(error_of(grid(4, 4), roi, listed({0, 6}, "/belt"), {handle({12})}),
              HasSubstr("/belt: the belt extends beyond the ROI at vertex 0"));
}

TEST(EditRegion, EmptyRoiAndHandleAreRefused) {
  EXPECT_THAT(error_of(grid(4, 4), all(), BoundaryAnchors{}, {handle({})}),
              HasSubstr("/handles/0/region: the handle has no vertices"));
  EXPECT_THAT(error_of(grid(4, 4), listed({}, "/roi"), BoundaryAnchors{}, {}),
              HasSubstr("/roi: the ROI has no vertices"));
}

TEST(EditRegion, VertexThatIsNotFiniteIsNamedUnlessItIsLoose) {
  Mesh mesh = grid(4, 4);
  mesh.positions.emplace_back(std::nan(""), 0, 0);
  EXPECT_EQ(resolved(mesh, all(), BoundaryAnchors{}, {handle({12})}).roi.size(), 26U);
  mesh.positions[24].z() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of(mesh, all(), BoundaryAnchors{}, {handle({12})}),
              HasSubstr("/roi: the mesh has a non-finite position, in or next to the ROI, at "
                        "vertex 24"));
}

TEST(Anchors, ComponentThatNothingHoldsIsNamed) {
  const Mesh mesh = beside(grid(4, 4), icosphere(0));
  EXPECT_EQ(
      error_of(mesh, all(), BoundaryAnchors{}, {handle({12})}),
      "/roi: the component of 12 vertices that contains vertex 25 has no anchor: no handle, belt "
      "or vertex outside the ROI holds it. Add a belt there, or remove the component from the ROI");
}

TEST(Anchors, OnOneLineLetTheComponentTurn) {
  EXPECT_EQ(error_of(grid(4, 4), all(), listed({0, 1, 4}, "/belt"), {handle({2})}),
            "/roi: the component of 25 vertices that contains vertex 0 can turn freely: its "
            "anchors (vertices 0, 1, 2, 4) lie on one line. Add a belt vertex off that line, or "
            "remove the component from the ROI");
  EXPECT_THAT(error_of(grid(4, 4), all(), listed({}, "/belt"), {handle({12})}),
              HasSubstr("can turn freely: its anchors (vertex 12) lie on one line"));
}

TEST(Anchors, CollinearityDoesNotDependOnPlaceOrUnit) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    Mesh mesh = grid(4, 4);
    for (Vector3d& p : mesh.positions) p = unit * (p + Vector3d(1e4, 0, 0));
    EXPECT_THAT(error_of(mesh, all(), listed({0, 4}, "/belt"), {handle({2})}),
                HasSubstr("lie on one line"));
    EXPECT_EQ(error_of(mesh, all(), listed({0, 4}, "/belt"), {handle({7})}), "");
  }
}

TEST(Anchors, VerticesOutsideTheRoiHoldIt) {
  const RegionSpec roi = listed({6, 7, 11, 12}, "/roi");
  EXPECT_EQ(error_of(grid(4, 4), roi, listed({}, "/belt"), {handle({12})}), "");
}

TEST(Anchors, LooseVerticesNeedNone) {
  Mesh mesh = grid(4, 4);
  mesh.positions.emplace_back(9, 9, 9);
  EXPECT_EQ(error_of(mesh, all(), BoundaryAnchors{}, {handle({12})}), "");
}

}  // namespace
}  // namespace lapwing
