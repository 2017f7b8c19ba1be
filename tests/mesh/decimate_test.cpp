#include "lapwing/mesh/decimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

long characteristic(const std::vector<Triangle>& triangles) {
  std::set<Index> vertices;
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      vertices.insert(t[c]);
      edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
    }
  }
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(triangles.size());
}

Decimated decimated(const Mesh& mesh, std::size_t count) {
  return decimate(mesh.positions, mesh.topology().triangles,
                  std::vector<Index>(mesh.vertex_count(), 0), count);
}

Vector3d area_vector(const Triangle& t, const Decimated& d, const Positions& positions) {
  const auto at = [&](std::size_t c) { return positions[d.kept[t[c]]]; };
  return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
}

TEST(Decimate, SphereStaysOneAndFacesOutward) {
  const Mesh sphere = icosphere(4);
  const Decimated d = decimated(sphere, 200);
  EXPECT_EQ(d.kept.size(), 200U);
  EXPECT_TRUE(std::is_sorted(d.kept.begin(), d.kept.end()));
  EXPECT_EQ(characteristic(d.triangles), 2);
  for (const Triangle& t : d.triangles) {
    EXPECT_GT(area_vector(t, d, sphere.positions).dot(sphere.positions[d.kept[t[0]]]), 0.0);
  }
}

TEST(Decimate, EveryVertexHasAnOwnerNearby) {
  const Mesh sphere = icosphere(4);
  const Decimated d = decimated(sphere, 200);
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    ASSERT_LT(d.owners[v], d.kept.size());
    EXPECT_LT((sphere.positions[d.kept[d.owners[v]]] - sphere.positions[v]).norm(), 0.6);
  }
  for (Index own = 0; own < d.kept.size(); ++own) EXPECT_EQ(d.owners[d.kept[own]], own);
}

TEST(Decimate, SheetKeepsItsOutlineAndLiesFlat) {
  const Mesh sheet = grid(30, 20);
  const Decimated d = decimated(sheet, 60);
  EXPECT_LE(d.kept.size(), 60U);
  const auto area = [](const Decimated& of, const Positions& positions) {
    Vector3d sum = Vector3d::Zero();
    for (const Triangle& t : of.triangles) sum += area_vector(t, of, positions);
    return sum.norm();
  };
  EXPECT_NEAR(area(d, sheet.positions), area(decimated(sheet, 651), sheet.positions), 1e-12);
  EXPECT_EQ(characteristic(d.triangles), 1);
}

TEST(Decimate, VerticesStayAmongTheirGroup) {
  const Mesh sphere = icosphere(3);
  std::vector<Index> groups;
  for (const Vector3d& p : sphere.positions) groups.push_back(p.z() > 0.3 ? 1 : 0);
  groups[7] = kKeptGroup;
  const Decimated d = decimate(sphere.positions, sphere.topology().triangles, groups, 80);
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    EXPECT_EQ(groups[d.kept[d.owners[v]]], groups[v]);
  }
  EXPECT_EQ(d.kept[d.owners[7]], 7U);
}

// Three sheets on one line of edges.
TEST(Decimate, VerticesOnEdgesOfThreeTrianglesAreKept) {
  const Mesh sheet = grid(8, 8);
  Mesh book;
  std::vector<Index> spine;
  for (const double angle : {0.0, 2.0, 4.0}) {
    std::vector<Index> own;
    std::size_t on_spine = 0;
    for (const Vector3d& p : sheet.positions) {
      const bool is_on_spine = p.x() == sheet.positions[0].x();
      if (is_on_spine && angle > 0.0) {
        own.push_back(spine[on_spine++]);
        continue;
      }
      own.push_back(static_cast<Index>(book.vertex_count()));
      if (is_on_spine) spine.push_back(own.back());
      const double across = p.x() - sheet.positions[0].x();
      book.positions.emplace_back(across * std::cos(angle), p.y(), across * std::sin(angle));
    }
    for (const Triangle& t : sheet.topology().triangles) {
      book.add_face(Triangle{own[t[0]], own[t[1]], own[t[2]]});
    }
  }
  ASSERT_EQ(spine.size(), 9U);
  const Decimated d = decimated(book, book.vertex_count() / 3);
  EXPECT_LE(d.kept.size(), book.vertex_count() / 3);
  for (const Index v : spine) EXPECT_EQ(d.kept[d.owners[v]], v);
}

TEST(Decimate, NoPartVanishes) {
  Mesh triangles;
  for (int k = 0; k < 3; ++k) {
    for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}) {
      triangles.positions.push_back(p + Vector3d(3.0 * k, 0, 0));
    }
    const auto first = static_cast<Index>(3 * k);
    triangles.add_face(Triangle{first, first + 1, first + 2});
  }
  EXPECT_EQ(decimated(triangles, 1).triangles.size(), 3U);
}

TEST(Decimate, VerticesWithoutTrianglesHaveNoOwner) {
  Mesh mesh = icosphere(1);
  mesh.positions.emplace_back(9.0, 9.0, 9.0);
  EXPECT_EQ(decimated(mesh, 20).owners.back(), kNoIndex);
}

// The mesh is a cone with 40 triangles around its tip, and a brim. The tip has too many neighbours:
// it cannot be merged into another vertex, nor another vertex into it.
TEST(Decimate, CrowdedVertexLosesItsNeighboursFirst) {
  constexpr Index kAround = 40;
  Mesh cone;
  cone.positions.emplace_back(0.0, 0.0, 1.0);
  for (const double radius : {1.0, 1.5}) {
    for (Index k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      cone.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
  }
  for (Index k = 0; k < kAround; ++k) {
    const Index next = (k + 1) % kAround;
    cone.add_face(Triangle{0, 1 + k, 1 + next});
    cone.add_face(Triangle{1 + k, 1 + kAround + k, 1 + kAround + next});
    cone.add_face(Triangle{1 + k, 1 + kAround + next, 1 + next});
  }
  const Decimated d = decimated(cone, 60);
  EXPECT_LE(d.kept.size(), 60U);
  EXPECT_EQ(characteristic(d.triangles), 1);
}

// At a flipped triangle, the corners that follow a vertex in its triangles do not include all its
// neighbours.
TEST(Decimate, TriangleTurnedOverStaysOnItsSurface) {
  const Mesh sphere = icosphere(4);
  Mesh turned;
  turned.positions = sphere.positions;
  Index number = 0;
  for (Triangle t : sphere.topology().triangles) {
    if (++number % 50 == 0) std::swap(t[1], t[2]);
    turned.add_face(t);
  }
  const Decimated d = decimated(turned, 300);
  EXPECT_LE(d.kept.size(), 300U);
  EXPECT_EQ(characteristic(d.triangles), 2);
}

TEST(Decimate, FarFromTheOriginIsTheSame) {
  const Mesh sphere = icosphere(4);
  Mesh far = sphere;
  // The offset consists of powers of two, so that adding it loses few bits of the positions.
  for (Vector3d& p : far.positions) p += Vector3d(4096.0, 0.0, -4096.0);
  const Decimated here = decimated(sphere, 300);
  const Decimated there = decimated(far, 300);
  EXPECT_EQ(there.kept.size(), here.kept.size());
  EXPECT_EQ(characteristic(there.triangles), 2);
}

}  // namespace
}  // namespace lapwing
