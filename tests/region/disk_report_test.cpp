#include "lapwing/region/disk_report.h"

#include <array>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/largest_disk.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Mesh mesh_of(std::size_t vertices, const std::vector<Triangle>& triangles) {
  Mesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto x = static_cast<double>(v);
    mesh.positions.emplace_back(x, x * x, x * x * x);
  }
  for (const Triangle& t : triangles) mesh.add_face(t);
  return mesh;
}

VertexSet all_of(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  return all;
}

DiskReport report_on(const Mesh& mesh, const VertexSet& region) {
  return report_disk(region_triangles(region, mesh.topology()));
}
DiskReport report_on(const Mesh& mesh) {
  return report_on(mesh, all_of(mesh));
}
std::string words_on(const Mesh& mesh) {
  return describe(report_on(mesh));
}

// The grid without the vertices whose column and row both lie between the two given.
VertexSet frame(Index cells, Index first, Index last) {
  VertexSet vertices;
  for (Index v = 0; v < (cells + 1) * (cells + 1); ++v) {
    const Index column = v % (cells + 1);
    const Index row = v / (cells + 1);
    if (column < first || column > last || row < first || row > last) vertices.push_back(v);
  }
  return vertices;
}

TEST(DiskReport, GridAndTriangleAreDisks) {
  EXPECT_TRUE(report_on(grid(5, 4)).is_disk());
  EXPECT_TRUE(report_on(mesh_of(3, {{0, 1, 2}})).is_disk());
  EXPECT_EQ(words_on(grid(1, 1)), "is a disk");
}

TEST(DiskReport, NamesBothLoopsOfATubeAndOfAnAnnulus) {
  const Mesh tube = cylinder(8, 4, 1.0, 3.0);
  EXPECT_EQ(report_on(tube).euler_characteristic, 0);
  EXPECT_EQ(words_on(tube),
            "has 2 boundary loops (8 vertices from vertex 0, 8 vertices from vertex 24)");
  const DiskReport annulus = report_on(grid(8, 8), frame(8, 4, 4));
  EXPECT_EQ(annulus.loops.size(), 2U);
  EXPECT_EQ(annulus.handles, 0);
  EXPECT_FALSE(annulus.is_disk());
}

TEST(DiskReport, ClosedSurfacesHaveNoBoundaryAndCountTheirHandles) {
  EXPECT_EQ(words_on(icosphere(1)), "has no boundary");
  EXPECT_EQ(words_on(torus(8, 6, 2.0, 0.5)), "has no boundary and 1 handle");
  EXPECT_EQ(report_on(torus(8, 6, 2.0, 0.5)).handles, 1);
}

TEST(DiskReport, HandleBehindOneLoopIsCounted) {
  // A torus without the triangles around one vertex.
  const Mesh ring = torus(8, 6, 2.0, 0.5);
  const DiskReport report = report_on(ring, subtract(all_of(ring), {13}));
  EXPECT_EQ(report.loops.size(), 1U);
  EXPECT_EQ(report.handles, 1);
  EXPECT_EQ(describe(report), "has 1 handle");
}

TEST(DiskReport, NamesPiecesAndWhereTheyTouch) {
  EXPECT_EQ(
      words_on(mesh_of(6, {{3, 4, 5}, {0, 1, 2}})),
      "has 2 pieces (1 triangle from vertex 0, 1 triangle from vertex 3) and 2 boundary loops "
      "(3 vertices from vertex 0, 3 vertices from vertex 3)");
  const DiskReport touching = report_on(mesh_of(5, {{0, 1, 2}, {2, 3, 4}}));
  EXPECT_THAT(touching.pinched, ElementsAre(2));
  EXPECT_EQ(touching.pieces.size(), 2U);
  EXPECT_EQ(touching.handles, 0);
  EXPECT_THAT(describe(touching), ::testing::EndsWith("and parts that touch only at vertex 2"));
}

TEST(DiskReport, NamesEdgesThatNoDiskHas) {
  const DiskReport crowded = report_on(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_THAT(crowded.non_manifold_edges, ElementsAre(std::array<Index, 2>{0, 1}));
  EXPECT_EQ(describe(crowded), "has 1 edge (0-1) with more than two triangles");
  const DiskReport turned = report_on(mesh_of(4, {{0, 1, 2}, {0, 1, 3}}));
  EXPECT_THAT(turned.turned_edges, ElementsAre(std::array<Index, 2>{0, 1}));
  EXPECT_EQ(describe(turned), "has 1 edge (0-1) with triangles of opposite orientation");
}

TEST(DiskReport, MobiusStripIsTurnedSomewhere) {
  const DiskReport strip =
      report_on(mesh_of(5, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}}));
  EXPECT_FALSE(strip.is_disk());
  EXPECT_EQ(strip.euler_characteristic, 0);
}

TEST(DiskReport, VerticesInNoTriangleDoNotCount) {
  const DiskReport report = report_on(grid(4, 4), {0, 1, 5, 6, 24});
  EXPECT_TRUE(report.is_disk());
  EXPECT_THAT(report.loose, ElementsAre(24));
  EXPECT_EQ(describe(report_on(grid(4, 4), {0, 24})), "has no triangles");
}

TEST(LargestDisk, OfADiskIsTheDiskLessItsLooseVertices) {
  const Mesh mesh = grid(4, 4);
  const Topology& topology = mesh.topology();
  EXPECT_THAT(largest_disk({0, 1, 5, 6, 24}, topology, mesh.positions), ElementsAre(0, 1, 5, 6));
  EXPECT_THAT(largest_disk({0, 24}, topology, mesh.positions), IsEmpty());
}

// The share of the region that the largest disk keeps, having made sure that it is a disk.
double share_kept(const Mesh& mesh, const VertexSet& region) {
  const Topology& topology = mesh.topology();
  const VertexSet disk = largest_disk(region, topology, mesh.positions);
  const DiskReport report = report_disk(region_triangles(disk, topology));
  EXPECT_TRUE(report.is_disk()) << describe(report);
  EXPECT_THAT(report.loose, IsEmpty());
  EXPECT_EQ(intersect(disk, region), disk);
  EXPECT_EQ(largest_disk(disk, topology, mesh.positions), disk);
  return static_cast<double>(disk.size()) / static_cast<double>(region.size());
}

TEST(LargestDisk, KeepsMostOfWhatIsNoDisk) {
  EXPECT_GT(share_kept(grid(20, 20), frame(20, 8, 12)), 0.9);
  EXPECT_GT(share_kept(cylinder(24, 12, 1.0, 3.0), all_of(cylinder(24, 12, 1.0, 3.0))), 0.9);
  EXPECT_GT(share_kept(icosphere(3), all_of(icosphere(3))), 0.9);
  const Mesh ring = torus(40, 24, 2.0, 0.5);
  EXPECT_GT(share_kept(ring, all_of(ring)), 0.85);
}

TEST(LargestDisk, LiesInTheLargestPiece) {
  const Mesh mesh = grid(10, 10);
  const VertexSet corner{0, 1, 11, 12};
  const VertexSet rest = subtract(all_of(mesh), unite(corner, {2, 13, 22, 23, 24}));
  const Topology& topology = mesh.topology();
  const VertexSet disk = largest_disk(unite(corner, rest), topology, mesh.positions);
  EXPECT_THAT(intersect(disk, corner), IsEmpty());
}

TEST(LargestDisk, OfRandomRegionsIsAlwaysADisk) {
  std::mt19937 random(11);
  for (const Mesh& mesh : {icosphere(3), torus(24, 12, 2.0, 0.7), grid(18, 18)}) {
    for (int round = 0; round < 20; ++round) {
      VertexSet region;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (random() % 100 < 60U + 2U * static_cast<unsigned>(round)) region.push_back(v);
      }
      share_kept(mesh, region);
    }
  }
}

TEST(LargestDisk, OfBrokenSurfacesIsADiskOrNothing) {
  // Two triangles with the same corners; an edge of three triangles; neighbours turned against each
  // other.
  const Mesh doubled = mesh_of(3, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_THAT(largest_disk({0, 1, 2}, doubled.topology(), doubled.positions), IsEmpty());
  const Mesh crowded = mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_DOUBLE_EQ(share_kept(crowded, all_of(crowded)), 4.0 / 5.0);
  const Mesh turned = mesh_of(4, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_DOUBLE_EQ(share_kept(turned, all_of(turned)), 3.0 / 4.0);
}

}  // namespace
}  // namespace lapwing
