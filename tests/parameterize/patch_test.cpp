#include "lapwing/parameterize/patch.h"

#include <limits>
#include <map>
#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/region_spec.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

VertexSet all_of(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

Patch patch_of(const Mesh& mesh, const VertexSet& region) {
  return disk_patch(region, mesh.topology(), mesh.positions, "coat.json: /steps/0/target");
}
Patch patch_of(const Mesh& mesh) {
  return patch_of(mesh, all_of(mesh));
}

// A strip of `quads` quads, one triangle wide: vertices 2 k below, 2 k + 1 above.
Mesh strip(Index quads) {
  Mesh mesh;
  for (Index k = 0; k <= quads; ++k) {
    mesh.positions.emplace_back(k, 0, 0);
    mesh.positions.emplace_back(k, 1, 0);
  }
  for (Index k = 0; k < quads; ++k) {
    mesh.add_face(std::array<Index, 3>{2 * k, 2 * k + 2, 2 * k + 1});
    mesh.add_face(std::array<Index, 3>{2 * k + 1, 2 * k + 2, 2 * k + 3});
  }
  return mesh;
}

Vector3d vector_area(std::span<const Triangle> triangles, std::span<const Vector3d> positions) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& [a, b, c] : triangles) {
    sum += 0.5 * (positions[b] - positions[a]).cross(positions[c] - positions[a]);
  }
  return sum;
}

// How often each edge of the patch is passed, lower end first.
std::map<std::array<Index, 2>, int> edge_uses(const Patch& patch) {
  std::map<std::array<Index, 2>, int> uses;
  for (const Triangle& t : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({t[k], t[(k + 1) % 3]});
      ++uses[{low, high}];
    }
  }
  return uses;
}

// No edge but those of the loop joins two vertices of the loop, every edge lies in two triangles or
// on the loop, and midpoints lie where they say.
void expect_no_chord(const Patch& patch) {
  std::vector<char> on_loop(patch.size(), 0);
  for (const Index v : patch.loop) on_loop[v] = 1;
  std::size_t boundary = 0;
  for (const auto& [edge, uses] : edge_uses(patch)) {
    const bool between = on_loop[edge[0]] != 0 && on_loop[edge[1]] != 0;
    EXPECT_EQ(uses, between ? 1 : 2) << edge[0] << "-" << edge[1];
    boundary += uses == 1 ? 1 : 0;
  }
  EXPECT_EQ(boundary, patch.loop.size());
}

TEST(Patch, OfAWholeGridKeepsItsNumbers) {
  const Mesh mesh = grid(6, 4);
  const Patch patch = patch_of(mesh);
  EXPECT_EQ(patch.vertices, all_of(mesh));
  EXPECT_EQ(patch.loop.size(), 20U);
  EXPECT_THAT(std::span(patch.loop).first(3), ElementsAre(0, 1, 2)) << "counterclockwise";
  expect_no_chord(patch);
}

TEST(Patch, TrianglesAreThoseOfTheMeshInOwnNumbers) {
  const Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  const VertexSet region = resolve({GeodesicDisk{Index{17}, 0.7}, "target"}, mesh);
  const Patch patch = disk_patch(region, topology, mesh.positions, "target");
  ASSERT_THAT(patch.midpoint_of, IsEmpty());
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const Triangle& source = topology.triangles[patch.triangle_sources[t]];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(patch.vertices[patch.triangles[t][k]], source[k]);
    }
  }
  for (Index own = 0; own < patch.size(); ++own) {
    EXPECT_EQ(patch.own_number(patch.vertices[own]), own);
  }
  EXPECT_EQ(patch.own_number(subtract(all_of(mesh), region).front()), kNoIndex);
}

TEST(Patch, LoopRunsWithThePatchOnItsLeft) {
  const Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  const Patch patch = disk_patch(resolve({GeodesicDisk{Index{17}, 0.7}, "target"}, mesh), topology,
                                 mesh.positions, "target");
  const auto positions = on_patch(patch, std::span<const Vector3d>(mesh.positions));
  // Around any boundary: the vector area of what it bounds.
  Vector3d around = Vector3d::Zero();
  for (std::size_t k = 0; k < patch.loop.size(); ++k) {
    const Index next = patch.loop[(k + 1) % patch.loop.size()];
    around += 0.5 * positions[patch.loop[k]].cross(positions[next]);
  }
  EXPECT_NEAR((around - vector_area(patch.triangles, positions)).norm(), 0.0, 1e-14);
}

TEST(Patch, LeavesOutVerticesInNoTriangle) {
  const Patch patch = patch_of(grid(4, 4), {0, 1, 5, 6, 24});
  EXPECT_THAT(patch.vertices, ElementsAre(0, 1, 5, 6));
}

TEST(Patch, StripOneTriangleWideIsHalvedAlongItsMiddle) {
  const Mesh mesh = strip(5);
  const Patch patch = patch_of(mesh);
  EXPECT_EQ(patch.midpoint_of.size(), 9U);
  // Its ends are cut into two, the eight others into three.
  EXPECT_EQ(patch.triangles.size(), 2U * 2U + 8U * 3U);
  expect_no_chord(patch);
  const auto positions = on_patch(patch, std::span<const Vector3d>(mesh.positions));
  for (std::size_t m = 0; m < patch.midpoint_of.size(); ++m) {
    const auto [a, b] = patch.midpoint_of[m];
    EXPECT_EQ(positions[patch.vertices.size() + m], 0.5 * (positions[a] + positions[b]));
  }
  EXPECT_NEAR((vector_area(patch.triangles, positions) - Vector3d(0, 0, 5)).norm(), 0.0, 1e-14);
  for (const Triangle& t : patch.triangles) {
    EXPECT_GT(vector_area(std::span(&t, 1), positions).z(), 0.0);
  }
}

TEST(Patch, EarAndSingleTriangle) {
  // A grid's corner may be an ear: one triangle behind a chord.
  const Mesh ear = [] {
    Mesh mesh = grid(2, 2);
    mesh.positions.emplace_back(-1, -1, 0);
    mesh.add_face(std::array<Index, 3>{9, 1, 0});
    return mesh;
  }();
  expect_no_chord(patch_of(ear));
  Mesh single;
  single.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  single.add_face(std::array<Index, 3>{0, 1, 2});
  const Patch patch = patch_of(single);
  EXPECT_THAT(patch.loop, ElementsAre(0, 1, 2));
  EXPECT_THAT(patch.midpoint_of, IsEmpty());
}

TEST(Patch, TriangleBehindThreeChordsIsCutIntoFour) {
  // A triangle with another one on each of its sides.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, -1, 0}, {3, 2, 0}, {-1, 2, 0}};
  for (const Triangle& t : {Triangle{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}}) mesh.add_face(t);
  const Patch patch = patch_of(mesh);
  EXPECT_EQ(patch.triangles.size(), 4U + 3U * 2U);
  expect_no_chord(patch);
}

std::string refusal(const Mesh& mesh) {
  return error_message<InputError>([&] { patch_of(mesh); });
}

TEST(Patch, RefusalSaysWhatTheRegionIsAndOffersTheLargestDisk) {
  EXPECT_THAT(
      refusal(cylinder(8, 4, 1.0, 3.0)),
      StartsWith("coat.json: /steps/0/target: the region is not a disk: it has 2 boundary loops (8 "
                 "vertices from vertex 0, 8 vertices from vertex 24). Choose another region, or "
                 "replace it by {\"disk_in\": REGION} to use the largest disk inside, which has "));
  EXPECT_THAT(refusal(torus(16, 8, 2.0, 0.5)),
              AllOf(HasSubstr("it has no boundary and 1 handle"),
                    HasSubstr("{\"disk_in\": REGION}"), HasSubstr("of its 128 vertices")));
  Mesh none;
  none.positions = {{0, 0, 0}};
  EXPECT_THAT(refusal(none), HasSubstr("has no triangle"));
}

TEST(Patch, VertexThatIsNotFiniteIsNamed) {
  Mesh mesh = grid(3, 3);
  mesh.positions[5].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(mesh), HasSubstr("the region has a non-finite position at vertex 5"));
}

}  // namespace
}  // namespace lapwing
