#include "lapwing/region/geodesic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

std::vector<double> distances_from(const Mesh& mesh, Index source) {
  return geodesic_distances(mesh.topology(), mesh.positions, std::array{source});
}

// Inner vertices of a flat grid moved about, so that it has obtuse and uneven triangles.
Mesh shaken_grid(Index size) {
  Mesh mesh = grid(size, size);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.35 / size, 0.35 / size);
  for (Vector3d& p : mesh.positions) {
    const double dx = shift(random);
    const double dy = shift(random);
    const bool inner = p.x() > 0.0 && p.x() < 1.0 && p.y() > 0.0 && p.y() < 1.0;
    if (inner) p += Vector3d(dx, dy, 0.0);
  }
  return mesh;
}

double largest_relative_error_in_plane(const Mesh& mesh, Index source) {
  const std::vector<double> distances = distances_from(mesh, source);
  double worst = 0.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (v == source) continue;
    const double exact = (mesh.positions[v] - mesh.positions[source]).norm();
    worst = std::max(worst, std::abs(distances[v] - exact) / exact);
  }
  return worst;
}

double largest_relative_error_on_sphere(const Mesh& mesh) {
  const std::vector<double> distances = distances_from(mesh, 0);
  double worst = 0.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double cosine = std::clamp(mesh.positions[v].dot(mesh.positions[0]), -1.0, 1.0);
    if (v != 0) worst = std::max(worst, std::abs(distances[v] / std::acos(cosine) - 1.0));
  }
  return worst;
}

TEST(Geodesic, FlatGridHasEuclidsDistance) {
  EXPECT_LT(largest_relative_error_in_plane(grid(20, 20), 220), 1e-9);
  EXPECT_LT(largest_relative_error_in_plane(grid(20, 7), 0), 1e-9);
}

TEST(Geodesic, UnevenAndObtuseTrianglesStayCloseToEuclid) {
  EXPECT_LT(largest_relative_error_in_plane(shaken_grid(30), 480), 0.01);
}

TEST(Geodesic, SphereHasGreatCircleDistanceAndRefinementConverges) {
  const double coarse = largest_relative_error_on_sphere(icosphere(2));
  const double middle = largest_relative_error_on_sphere(icosphere(3));
  const double fine = largest_relative_error_on_sphere(icosphere(4));
  EXPECT_LT(middle, 0.7 * coarse);
  EXPECT_LT(fine, 0.7 * middle);
  EXPECT_LT(fine, 0.015);
}

// Eight-sided prism of `bands` thin bands over a fan around its bottom's centre, the last vertex.
Mesh prism_on_a_fan(Index bands) {
  Mesh mesh;
  for (Index b = 0; b <= bands; ++b) {
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * std::numbers::pi * k;
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 4.0 * b / bands);
    }
  }
  mesh.positions.emplace_back(0, 0, 0);
  const auto centre = static_cast<Index>(mesh.vertex_count() - 1);
  for (Index k = 0; k < 8; ++k) {
    const Index next = (k + 1) % 8;
    mesh.add_face(std::array{centre, next, k});
    for (Index b = 0; b < 8 * bands; b += 8) {
      mesh.add_face(std::array{b + k, b + next, b + 8 + next});
      mesh.add_face(std::array{b + k, b + 8 + next, b + 8 + k});
    }
  }
  return mesh;
}

TEST(Geodesic, ThinBandsOfWideTrianglesKeepTheirHeight) {
  const Mesh mesh = prism_on_a_fan(200);
  const auto centre = static_cast<Index>(mesh.vertex_count() - 1);
  const std::vector<double> distances = distances_from(mesh, centre);
  for (Index v = 0; v < centre; ++v) {
    const double exact = 1.0 + mesh.positions[v].z();
    EXPECT_NEAR(distances[v], exact, 0.02 * exact);
  }
}

TEST(Geodesic, DistanceToALineOfSourcesIsTheHeightAboveIt) {
  const Mesh mesh = grid(12, 12);
  std::vector<Index> bottom(13);
  for (Index c = 0; c < 13; ++c) bottom[c] = c;
  const auto distances = geodesic_distances(mesh.topology(), mesh.positions, bottom);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(distances[v], mesh.positions[v].y(), 0.011);
  }
}

TEST(Geodesic, NeverLongerThanAPathAlongEdges) {
  const Mesh mesh = shaken_grid(12);
  const Topology& topology = mesh.topology();
  const auto distances = geodesic_distances(topology, mesh.positions, std::array<Index, 1>{0});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::vector<Index> path = shortest_edge_path(topology, mesh.positions, 0, v);
    double length = 0.0;
    for (std::size_t k = 1; k < path.size(); ++k) {
      length += (mesh.positions[path[k]] - mesh.positions[path[k - 1]]).norm();
    }
    EXPECT_LE(distances[v], length * (1.0 + 1e-9));
    EXPECT_GE(distances[v], (mesh.positions[v] - mesh.positions[0]).norm() * (1.0 - 1e-9));
  }
}

TEST(Geodesic, ThereAndBackAreAlike) {
  const Mesh mesh = torus(40, 20, 2.0, 0.7);
  const double there = distances_from(mesh, 3)[417];
  const double back = distances_from(mesh, 417)[3];
  EXPECT_NEAR(there, back, 0.01 * there);
}

TEST(Geodesic, DoesNotDependOnPlaceOrUnit) {
  const Mesh mesh = icosphere(3);
  Mesh moved = mesh;
  const Eigen::AngleAxisd turn(1.0, Vector3d(1, 2, 3).normalized());
  for (Vector3d& p : moved.positions) p = turn * (1000.0 * p) + Vector3d(1e4, -1e4, 3e4);
  const auto distances = distances_from(mesh, 5);
  const auto moved_distances = distances_from(moved, 5);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(moved_distances[v] / 1000.0, distances[v], 1e-6);
  }
}

TEST(Geodesic, MoreSourcesNeverLengthenADistance) {
  const Mesh mesh = torus(24, 12, 2.0, 0.7);
  const Topology& topology = mesh.topology();
  const auto one = geodesic_distances(topology, mesh.positions, std::array<Index, 1>{0});
  const auto two = geodesic_distances(topology, mesh.positions, std::array<Index, 2>{0, 150});
  EXPECT_EQ(two[150], 0.0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_LE(two[v], one[v] * 1.03);
}

TEST(Geodesic, LimitLeavesWhatLiesWithinItAndDropsTheRest) {
  const Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  const auto all = geodesic_distances(topology, mesh.positions, std::array<Index, 1>{0});
  const auto near = geodesic_distances(topology, mesh.positions, std::array<Index, 1>{0}, 0.8);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (all[v] <= 0.8) {
      EXPECT_NEAR(near[v], all[v], 1e-12);
    } else {
      EXPECT_EQ(near[v], kNoLimit);
    }
  }
}

TEST(Geodesic, PathsKeepToTheAllowedVertices) {
  const Mesh mesh = grid(10, 10);
  // A wall with a gap at the top row between the source and the right half.
  std::vector<char> allowed(mesh.vertex_count(), 1);
  for (Index r = 0; r < 10; ++r) allowed[r * 11 + 5] = 0;
  const auto distances = geodesic_distances(mesh.topology(), mesh.positions,
                                            std::array<Index, 1>{0}, kNoLimit, allowed);
  EXPECT_EQ(distances[5], kNoLimit);
  EXPECT_GT(distances[10], 2.0);
  EXPECT_LT(distances[10], 2.5);
}

TEST(Geodesic, OtherComponentsAndLooseVerticesAreNotReached) {
  Mesh mesh = grid(2, 2);
  mesh.positions.emplace_back(5, 5, 5);
  const auto distances = distances_from(mesh, 0);
  EXPECT_EQ(distances[9], kNoLimit);
  EXPECT_EQ(distances_from(mesh, 9)[0], kNoLimit);
  EXPECT_EQ(distances_from(mesh, 9)[9], 0.0);
}

TEST(Geodesic, CrossesEdgesOfThreeTrianglesAndTrianglesWithoutArea) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 0, 0}, {1, 0, 0}};
  for (const Index tip : {2U, 3U, 4U}) mesh.add_face(std::array<Index, 3>{0, 1, tip});
  mesh.add_face(std::array<Index, 3>{0, 1, 5});
  mesh.add_face(std::array<Index, 3>{1, 5, 6});
  const auto distances = distances_from(mesh, 2);
  EXPECT_NEAR(distances[3], 2.0, 1e-12);
  EXPECT_NEAR(distances[4], 2.0, 1e-12);
  EXPECT_NEAR(distances[5], std::sqrt(2.0) + 1.0, 1e-12);
  EXPECT_NEAR(distances[6], std::sqrt(2.0), 1e-12);
}

TEST(Geodesic, VerticesThatAreNotFiniteAreNotReached) {
  Mesh mesh = grid(4, 4);
  mesh.positions[12].x() = std::nan("");
  const auto distances = distances_from(mesh, 0);
  EXPECT_EQ(distances[12], kNoLimit);
  EXPECT_NEAR(distances[24], std::sqrt(2.0), 0.2);
}

TEST(Geodesic, MissingSourceIsRefusedByNumber) {
  EXPECT_EQ(error_message<InputError>([] { distances_from(grid(2, 2), 9); }),
            "vertex 9 cannot be a source of distances: the mesh has 9 vertices (numbered from 0)");
}

TEST(EdgePath, FollowsTheShortestEdges) {
  const Mesh mesh = grid(4, 4);
  const Topology& topology = mesh.topology();
  EXPECT_THAT(shortest_edge_path(topology, mesh.positions, 20, 24),
              ::testing::ElementsAre(20, 21, 22, 23, 24));
  EXPECT_THAT(shortest_edge_path(topology, mesh.positions, 7, 7), ::testing::ElementsAre(7));
}

TEST(EdgePath, IsEmptyBetweenComponents) {
  Mesh mesh = grid(2, 2);
  mesh.positions.emplace_back(5, 5, 5);
  EXPECT_TRUE(shortest_edge_path(mesh.topology(), mesh.positions, 0, 9).empty());
}

TEST(EdgePath, MissingEndIsRefused) {
  const Mesh mesh = grid(2, 2);
  EXPECT_THROW(shortest_edge_path(mesh.topology(), mesh.positions, 0, 9), InputError);
}

TEST(AGeodesicFront, WithARaisedLimitHasTheDistancesOfOneMarch) {
  const Mesh mesh = icosphere(4);
  const Topology& topology = mesh.topology();
  const Index source = 7;
  GeodesicFront front(topology, mesh.positions, {&source, 1});
  for (const double limit : {0.3, 0.35, 1.0, 2.0}) {
    front.march_to(limit);
    const std::vector<double> once =
        geodesic_distances(topology, mesh.positions, {&source, 1}, limit);
    for (Index v = 0; v < topology.vertex_count(); ++v) {
      EXPECT_EQ(front.distances()[v] <= limit, once[v] <= limit) << v;
      if (once[v] <= limit) {
        EXPECT_NEAR(front.distances()[v], once[v], 1e-9) << v;
      }
    }
  }
  EXPECT_LT(front.reached().size(), topology.vertex_count());
}

}  // namespace
}  // namespace lapwing
