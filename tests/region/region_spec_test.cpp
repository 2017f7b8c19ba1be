#include "lapwing/region/region_spec.h"

#include <array>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Form>
RegionSpec spec(Form form) {
  return {std::move(form), "bend.json: /steps/0/roi"};
}

VertexSet resolve_on(const Mesh& mesh, const RegionSpec& region) {
  return resolve(region, mesh);
}

std::string error_on(const Mesh& mesh, const RegionSpec& region) {
  return error_message<InputError>([&] { resolve_on(mesh, region); });
}

TEST(Region, AllHoldsEveryVertexLooseOnesToo) {
  Mesh mesh = grid(1, 1);
  mesh.positions.emplace_back(5, 5, 5);
  EXPECT_THAT(resolve_on(mesh, spec(AllVertices{})), ElementsAre(0, 1, 2, 3, 4));
}

TEST(Region, ListComesOutSortedWithoutRepeats) {
  EXPECT_THAT(resolve_on(grid(2, 2), spec(ListedVertices{{7, 1, 7, 3}})), ElementsAre(1, 3, 7));
  EXPECT_TRUE(resolve_on(grid(2, 2), spec(ListedVertices{})).empty());
}

TEST(Region, MissingVertexIsNamedWithItsPlaceInTheList) {
  EXPECT_EQ(
      error_on(grid(2, 2), spec(ListedVertices{{1, 99}})),
      "bend.json: /steps/0/roi/vertices/1: vertex 99 is not in the mesh, which has 9 vertices "
      "(numbered from 0)");
}

TEST(Region, DiskOnAFlatGridIsRound) {
  const Mesh mesh = grid(20, 20);
  const VertexSet disk = resolve_on(mesh, spec(GeodesicDisk{Index{220}, 0.301}));
  const Vector3d center = mesh.positions[220];
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const bool within = (mesh.positions[v] - center).norm() <= 0.301;
    EXPECT_EQ(std::binary_search(disk.begin(), disk.end(), v), within) << v;
  }
}

TEST(Region, DiskMeasuresAlongTheSurfaceAndNotThroughTheAir) {
  Mesh mesh = grid(10, 1);
  Mesh sheet = mesh;
  for (Vector3d& p : sheet.positions) p.z() = 0.01;
  // Two sheets close together, joined by nothing.
  for (const Vector3d& p : sheet.positions) mesh.positions.push_back(p);
  for (std::size_t f = 0; f < sheet.face_count(); ++f) {
    const auto t = sheet.face(f);
    mesh.add_face(std::array<Index, 3>{t[0] + 22, t[1] + 22, t[2] + 22});
  }
  EXPECT_LT(resolve_on(mesh, spec(GeodesicDisk{Index{0}, 5.0})).back(), 22U);
}

TEST(Region, DiskNearAPointStartsAtTheNearestVertexOfATriangle) {
  Mesh mesh = grid(4, 4);
  mesh.positions.emplace_back(0.5, 0.5, 0.3);
  EXPECT_THAT(resolve_on(mesh, spec(GeodesicDisk{Vector3d(0.5, 0.5, 0.3), 0.1})), ElementsAre(12));
}

TEST(Region, DiskOfALooseVertexIsThatVertex) {
  Mesh mesh = grid(2, 2);
  mesh.positions.emplace_back(5, 5, 5);
  EXPECT_THAT(resolve_on(mesh, spec(GeodesicDisk{Index{9}, 100.0})), ElementsAre(9));
}

TEST(Region, DiskNeedsAVertexOfTheMeshOrAFinitePoint) {
  EXPECT_THAT(error_on(grid(2, 2), spec(GeodesicDisk{Index{9}, 1.0})),
              HasSubstr("/steps/0/roi/disk/center: vertex 9 is not in the mesh"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_on(grid(2, 2), spec(GeodesicDisk{Vector3d(0, nan, 0), 1.0})),
              HasSubstr("/steps/0/roi/disk/near: the point is not finite"));
}

TEST(Region, NeedsASurface) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const RegionSpec& region :
       {spec(AllVertices{}), spec(ListedVertices{{0}}), spec(GeodesicDisk{Index{0}, 1.0}),
        spec(Box{{0, 0, 0}, {1, 1, 1}})}) {
    EXPECT_EQ(error_on(mesh, region),
              "bend.json: /steps/0/roi: the mesh has no surface to edit: it has 3 vertices and no "
              "faces; export it with its faces, or reconstruct the surface of the points first");
  }
  mesh.add_face(std::array<Index, 3>{0, 1, 1});
  EXPECT_THAT(error_on(mesh, spec(AllVertices{})),
              HasSubstr("none of its faces has three different, finite vertices"));
}

TEST(Region, BoxHoldsItsFaces) {
  const RegionSpec box = spec(Box{{0.0, 0.5, 0.0}, {0.5, 1.0, 0.0}});
  EXPECT_THAT(resolve_on(grid(2, 2), box), ElementsAre(3, 4, 6, 7));
}

TEST(Region, BoxLeavesOutVerticesThatAreNotFinite) {
  Mesh mesh = grid(1, 1);
  mesh.positions[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(resolve_on(mesh, spec(Box{{-9, -9, -9}, {9, 9, 9}})), ElementsAre(0, 1, 3));
}

TEST(Region, EmptyBoxSaysWhereTheMeshIs) {
  EXPECT_EQ(error_on(grid(2, 2), spec(Box{{5, 5, 5}, {6, 6, 6}})),
            "bend.json: /steps/0/roi/box: no vertex lies in the box; the mesh spans (0, 0, 0) to "
            "(1, 1, 0). Move or enlarge the box");
}

TEST(Region, UnionAndDifferenceAreThoseOfSets) {
  const RegionSpec a = spec(ListedVertices{{0, 1, 2}});
  const RegionSpec b = spec(ListedVertices{{2, 3}});
  EXPECT_THAT(resolve_on(grid(2, 2), spec(UnionRegion{{a, b}})), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(resolve_on(grid(2, 2), spec(DifferenceRegion{{a, b}})), ElementsAre(0, 1));
  EXPECT_THAT(error_on(grid(2, 2), spec(DifferenceRegion{{a, a}})),
              HasSubstr("/steps/0/roi/minus: no vertices of the first"));
}

TEST(Region, DiskInAnAnnulusIsMostOfIt) {
  const RegionSpec hole = spec(Box{{0.4, 0.4, -1}, {0.6, 0.6, 1}});
  const RegionSpec annulus = spec(DifferenceRegion{{spec(AllVertices{}), hole}});
  const VertexSet disk = resolve_on(grid(20, 20), spec(DiskInRegion{{annulus}}));
  EXPECT_EQ(disk, intersect(disk, resolve_on(grid(20, 20), annulus)));
  EXPECT_GT(disk.size(), 350U);
  EXPECT_LT(disk.size(), 416U);
  EXPECT_THAT(error_on(grid(2, 2), spec(DiskInRegion{{spec(ListedVertices{{0, 8}})}})),
              HasSubstr("/steps/0/roi/disk_in: no triangle has its three corners in the region"));
}

TEST(Region, EqualityIgnoresWhereItWasWritten) {
  EXPECT_EQ((RegionSpec{Box{}, "a.json: /steps/0/roi"}), (RegionSpec{Box{}, ""}));
  EXPECT_NE((RegionSpec{UnionRegion{{spec(AllVertices{})}}, ""}),
            (RegionSpec{DifferenceRegion{{spec(AllVertices{})}}, ""}));
}

// Vertex (column, row) of the 8 x 8 grid.
Index at(Index column, Index row) {
  return row * 9 + column;
}

TEST(LoopRegion, OnAGridHoldsTheSideOfTheVertexNamed) {
  const std::vector<Index> square{at(2, 2), at(6, 2), at(6, 6), at(2, 6)};
  VertexSet within;
  VertexSet rim;
  for (Index r = 2; r <= 6; ++r) {
    for (Index c = 2; c <= 6; ++c) {
      within.push_back(at(c, r));
      if (r == 2 || r == 6 || c == 2 || c == 6) rim.push_back(at(c, r));
    }
  }
  const Mesh mesh = grid(8, 8);
  EXPECT_EQ(resolve_on(mesh, spec(LoopRegion{square, at(4, 4)})), within);
  const VertexSet all = resolve_on(mesh, spec(AllVertices{}));
  EXPECT_EQ(resolve_on(mesh, spec(LoopRegion{square, at(0, 0)})),
            unite(subtract(all, within), rim));
}

TEST(LoopRegion, AlongTheMeshBoundaryHoldsEverything) {
  const std::vector<Index> border{at(0, 0), at(8, 0), at(8, 8), at(0, 8)};
  EXPECT_EQ(resolve_on(grid(8, 8), spec(LoopRegion{border, at(4, 4)})).size(), 81U);
}

TEST(LoopRegion, SpurOfTheLoopIsNoCut) {
  // Goes out to (7, 4) and back on its way around.
  const std::vector<Index> loop{at(2, 2), at(5, 2), at(5, 4), at(7, 4),
                                at(5, 4), at(5, 5), at(2, 5)};
  const VertexSet outer = resolve_on(grid(8, 8), spec(LoopRegion{loop, at(8, 8)}));
  const VertexSet inner = resolve_on(grid(8, 8), spec(LoopRegion{loop, at(3, 3)}));
  EXPECT_EQ(inner.size(), 16U + 2U);
  EXPECT_EQ(intersect(inner, outer).size(), 12U + 2U);
  EXPECT_EQ(unite(inner, outer).size(), 81U);
}

TEST(LoopRegion, AroundATubeKeepsOneEnd) {
  const Mesh tube = cylinder(12, 9, 0.5, 4.0);
  const std::vector<Index> around{4 * 12 + 0, 4 * 12 + 4, 4 * 12 + 8};
  EXPECT_EQ(resolve_on(tube, spec(LoopRegion{around, 0})).size(), 5U * 12U);
  EXPECT_EQ(resolve_on(tube, spec(LoopRegion{around, 8 * 12})).size(), 5U * 12U);
}

TEST(LoopRegion, AroundATorusDoesNotSeparateIt) {
  const Mesh ring = torus(16, 12, 2.0, 0.5);
  const std::string meridian = error_on(ring, spec(LoopRegion{{0, 4, 8}, 100}));
  EXPECT_THAT(meridian, HasSubstr("bend.json: /steps/0/roi/loop: the loop does not separate the "
                                  "mesh: vertex 100 reaches both sides of its edge"));
  // A small loop on it does separate.
  const VertexSet patch =
      resolve_on(ring, spec(LoopRegion{{0, 4 * 12, 4 * 12 + 3, 3}, 2 * 12 + 1}));
  EXPECT_GT(patch.size(), 8U);
  EXPECT_LT(patch.size(), 40U);
}

TEST(LoopRegion, ErrorsNameThePlaceAndTheStep) {
  Mesh mesh = grid(8, 8);
  const Mesh other = icosphere(0);
  const auto first = static_cast<Index>(mesh.vertex_count());
  for (const Vector3d& p : other.positions) mesh.positions.push_back(p + Vector3d(9, 9, 9));
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    const auto t = other.face(f);
    mesh.add_face(std::array<Index, 3>{t[0] + first, t[1] + first, t[2] + first});
  }
  const std::vector<Index> square{at(2, 2), at(6, 2), at(6, 6), at(2, 6)};
  const auto error = [&](std::vector<Index> loop, Index inside) {
    return error_on(mesh, spec(LoopRegion{std::move(loop), inside}));
  };
  EXPECT_THAT(error({1, 2}, 0), HasSubstr("/loop: a loop needs at least 3 vertices, got 2"));
  EXPECT_THAT(error({1, 2, 500}, 0), HasSubstr("/loop/2: vertex 500 is not in the mesh"));
  EXPECT_THAT(error(square, 500), HasSubstr("/inside: vertex 500 is not in the mesh"));
  EXPECT_THAT(error(square, at(3, 2)), HasSubstr("/inside: vertex 21 lies on the loop"));
  EXPECT_THAT(error({at(2, 2), first, at(3, 3)}, 0),
              HasSubstr("/loop/0: no path of edges leads from vertex 20 to vertex 81"));
  EXPECT_THAT(error(square, first), HasSubstr("/inside: no path over triangles leads"));
  EXPECT_THAT(error({at(1, 1), at(4, 1), at(6, 1)}, 0),
              HasSubstr("/loop: the loop runs back over"));
}

}  // namespace
}  // namespace lapwing
