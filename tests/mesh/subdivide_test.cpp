#include "lapwing/mesh/subdivide.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/environment.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

bool is_boundary(const Edges& edges, Index v) {
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.is_boundary(e) && (edges.ends[e][0] == v || edges.ends[e][1] == v)) return true;
  }
  return false;
}

// Returns the position of the interior vertex v on the limit surface (Loop 1987).
Vector3d limit(const Mesh& mesh, Index v) {
  const auto ring = mesh.topology().rings[v];
  const auto n = static_cast<double>(ring.size());
  const double c = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / n);
  const double share = 1.0 / (0.375 * n / (0.625 - c * c) + n);
  Vector3d point = (1.0 - n * share) * mesh.positions[v];
  for (const Index w : ring) point += share * mesh.positions[w];
  return point;
}

Mesh rough(Mesh mesh) {
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    mesh.positions[i].z() += 0.2 * std::sin(3.0 * static_cast<double>(i));
  }
  return mesh;
}

class Subdivision : public ::testing::TestWithParam<Mesh (*)(const Mesh&)> {};

TEST_P(Subdivision, MakesFourOfEveryTriangleThatFaceAsItDoes) {
  const Mesh coarse = grid(4, 3);
  const Mesh fine = GetParam()(coarse);
  EXPECT_EQ(fine.face_count(), 4 * coarse.face_count());
  EXPECT_EQ(fine.vertex_count(), coarse.vertex_count() + build_edges(coarse).count());
  for (const Triangle& t : fine.topology().triangles) {
    const auto& p = fine.positions;
    EXPECT_GT((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z(), 0.0);
  }
}

TEST_P(Subdivision, CommutesWithAffineMaps) {
  const Mesh coarse = rough(icosphere(1));
  Eigen::Affine3d map = Eigen::Translation3d(3, 4, 5) *
                        Eigen::AngleAxisd(2.0, Vector3d(1, 1, 0).normalized()) *
                        Eigen::Scaling(1.0, 2.0, 0.5);
  Mesh moved = coarse;
  for (Vector3d& p : moved.positions) p = map * p;
  const Mesh a = GetParam()(moved);
  const Mesh b = GetParam()(coarse);
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    EXPECT_LT((a.positions[v] - map * b.positions[v]).norm(), 1e-12);
  }
}

TEST_P(Subdivision, RefusesPolygons) {
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.add_face(std::array<Index, 4>{0, 1, 2, 3});
  EXPECT_THAT(error_message<InputError>([&] { GetParam()(square); }), HasSubstr("4 corners"));
}

TEST_P(Subdivision, RefusesVerticesThatAreNotFinite) {
  Mesh mesh = grid(2, 2);
  mesh.positions[4].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_message<InputError>([&] { GetParam()(mesh); }),
              ::testing::AllOf(HasSubstr("vertex 4 "), HasSubstr("lapwing check MESH --fix OUT")));
}

INSTANTIATE_TEST_SUITE_P(Both, Subdivision,
                         ::testing::Values([](const Mesh& mesh) { return subdivide(mesh); },
                                           loop_subdivide),
                         [](const auto& test) { return test.index == 0 ? "Linear" : "Loop"; });

TEST(Subdivide, PutsNewVerticesAtMidpointsAndMovesNoOldOne) {
  const Mesh coarse = rough(grid(3, 3));
  const Mesh fine = subdivide(coarse);
  const Edges edges = build_edges(coarse);
  for (std::size_t v = 0; v < coarse.vertex_count(); ++v) {
    EXPECT_EQ(fine.positions[v], coarse.positions[v]);
  }
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto& [a, b] = edges.ends[e];
    EXPECT_LT((fine.positions[coarse.vertex_count() + e] -
               0.5 * (coarse.positions[a] + coarse.positions[b]))
                  .norm(),
              1e-15);
  }
}

// Valences 5 and 6 on a rough sphere, 4 and 8 inside a rough sheet, 3 on a tetrahedron.
TEST(LoopSubdivide, LeavesTheLimitOfEveryInnerVertexWhereItIs) {
  Mesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.3, 0.1, 1}};
  for (const auto& t : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    tetrahedron.add_face(t);
  }
  for (const Mesh& coarse : {rough(icosphere(1)), rough(grid(5, 5)), tetrahedron}) {
    const Mesh fine = loop_subdivide(coarse);
    const Edges edges = build_edges(coarse);
    const Topology& topology = coarse.topology();
    for (Index v = 0; v < coarse.vertex_count(); ++v) {
      if (is_boundary(edges, v)) continue;
      EXPECT_LT((limit(fine, v) - limit(coarse, v)).norm(), 1e-12)
          << v << " of valence " << topology.rings.size(v);
    }
  }
}

// The border is a cubic B-spline, whose points end at (a + 4 v + b) / 6.
TEST(LoopSubdivide, LeavesTheLimitOfEveryBorderVertexWhereItIs) {
  const Mesh coarse = rough(grid(5, 5));
  const auto border_limit = [](const Mesh& mesh, Index v) {
    const Edges edges = build_edges(mesh);
    Vector3d sum = 4.0 * mesh.positions[v];
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (!edges.is_boundary(e)) continue;
      if (edges.ends[e][0] == v) sum += mesh.positions[edges.ends[e][1]];
      if (edges.ends[e][1] == v) sum += mesh.positions[edges.ends[e][0]];
    }
    return Vector3d(sum / 6.0);
  };
  const Mesh fine = loop_subdivide(coarse);
  for (const Index v : {0U, 3U, 6U, 35U}) {
    EXPECT_LT((border_limit(fine, v) - border_limit(coarse, v)).norm(), 1e-12) << v;
  }
}

TEST(LoopSubdivide, BorderDoesNotFeelTheInside) {
  const Mesh flat = grid(5, 5);
  Mesh bent = flat;
  bent.positions[14].z() = 1.0;  // inside
  const Mesh a = loop_subdivide(flat);
  const Mesh b = loop_subdivide(bent);
  const Edges edges = build_edges(a);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (!edges.is_boundary(e)) continue;
    EXPECT_EQ(a.positions[edges.ends[e][0]], b.positions[edges.ends[e][0]]);
  }
}

TEST(LoopSubdivide, AwkwardVerticesStay) {
  Mesh mesh = grid(2, 2);
  const auto loose = static_cast<Index>(mesh.vertex_count());
  mesh.positions.emplace_back(5, 5, 5);
  mesh.positions.emplace_back(0.5, 0.5, 1);
  mesh.add_face(std::array<Index, 3>{4, 5, loose + 1});  // a third triangle on an inner edge
  const Mesh fine = loop_subdivide(mesh);
  EXPECT_EQ(fine.positions[loose], mesh.positions[loose]);
  for (const Vector3d& p : fine.positions) EXPECT_TRUE(p.allFinite());
}

TEST(Subdivide, MoreTrianglesThanAllowedAreRefusedBeforeAnyIsMade) {
  EXPECT_NO_THROW(require_subdividable(icosphere(2), 7));
  EXPECT_THAT(error_message<InputError>([] { require_subdividable(icosphere(2), 8); }),
              ::testing::StartsWith("subdividing would make 20,971,520 triangles, more than the "
                                    "limit of 20,000,000"));
  const test::Environment lower(kMostTriangles.variable, "1000");
  EXPECT_THROW(subdivide(icosphere(2)), InputError);
  EXPECT_THROW(loop_subdivide(icosphere(2)), InputError);
}

}  // namespace
}  // namespace lapwing
