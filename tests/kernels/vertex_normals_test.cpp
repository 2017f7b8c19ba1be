#include "lapwing/vulkan/vertex_normals.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/moved_mesh.h"
#include "kernels/twins.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::Sample;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAreArray;

class VertexNormalsKernel : public test::KernelTest {
 protected:
  std::vector<Vector3d> at_rest(const Sample& sample) const { return normals_on(context, sample); }
  static std::vector<Vector3d> normals_on(const std::shared_ptr<gpu::Context>& where,
                                          const Sample& sample) {
    return test::MovedMesh(where, sample.mesh.positions, sample.topology, {}).normals();
  }
};

TEST_P(VertexNormalsKernel, AgreesWithTheCpuTwin) {
  for (const Sample& sample : test::awkward_meshes()) {
    // Without area the direction is rounding noise.
    if (sample.name.starts_with("ring on a line")) continue;
    const auto expected = normals_on(nullptr, sample);
    const auto normals = at_rest(sample);
    ASSERT_EQ(normals.size(), expected.size());
    // The device rounds positions to 2^-24 of the mesh size. This rotates a normal by about that
    // rounding error divided by the edge length.
    const double tolerance = 100 * surface_tolerance();
    for (std::size_t i = 0; i < normals.size(); ++i) {
      EXPECT_LE((normals[i] - expected[i]).norm(), tolerance) << sample.name << " vertex " << i;
    }
  }
}

TEST_P(VertexNormalsKernel, PointOutOfASphere) {
  const Sample sample("sphere", icosphere(3));
  const auto normals = at_rest(sample);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1.0, surface_tolerance());
    EXPECT_GT(normals[i].dot(sample.mesh.positions[i]), 0.999);
  }
}

TEST_P(VertexNormalsKernel, AreZeroWhereThereIsNoArea) {
  Mesh mesh;
  mesh.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {5, 5, 5}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  const auto normals = at_rest(Sample("point", mesh));
  EXPECT_THAT(normals, ::testing::Each(Vector3d(0, 0, 0)));
}

// Moving a vertex changes only its normal and those of its neighbours.
TEST_P(VertexNormalsKernel, FollowAMovingVertex) {
  const Sample sample("grid", grid(6, 6));
  const std::vector<Index> moving{24};
  const std::vector<double> basis{0.0, 0.0, 1.0};
  test::MovedMesh surface(context, sample.mesh.positions, sample.topology, {moving, 1, basis});
  surface.blend(std::vector{0.1});

  Sample bumped = sample;
  bumped.mesh.positions[24].z() = 0.1;
  const auto expected = at_rest(bumped);
  const auto normals = surface.normals();
  const auto ring = sample.topology.rings[24];
  for (Index i = 0; i < normals.size(); ++i) {
    EXPECT_LE((normals[i] - expected[i]).norm(), 10 * surface_tolerance()) << "vertex " << i;
    const bool touched = i == 24 || std::ranges::find(ring, i) != ring.end();
    if (!touched) {
      EXPECT_EQ(normals[i], Vector3d(0, 0, 1)) << "vertex " << i;
    }
  }
}

LAPWING_ON_ALL_TWINS(VertexNormalsKernel);

Adjacency fans_of(const Topology& topology) {
  const Positions anywhere(topology.vertex_count(), Vector3d::Zero());
  return build_fans(topology.triangles, topology.vertex_triangles,
                    split_normals(anywhere, topology, 180.0));
}

// Returns the triangles of the fans around vertex i. Each triangle starts with its smallest index.
std::vector<Triangle> triangles_of(const Adjacency& fans, Index i) {
  std::vector<Triangle> list;
  const auto corners = fans[i];
  for (std::size_t c = 1; c < corners.size(); ++c) {
    if ((corners[c] & kFanBegins) != 0) continue;
    Triangle t{i, corners[c - 1] & ~kFanBegins, corners[c]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    list.push_back(t);
  }
  return list;
}

TEST(Fans, ListEveryTriangleOnceWithItsOrientation) {
  // Two fans meet at vertex 0, as in a bow tie. Edge 0-1 has three triangles; one is reversed.
  Mesh mesh;
  mesh.positions.assign(9, Vector3d::Zero());
  const std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 1, 4},
                                    {5, 6, 0}, {6, 7, 0}, {1, 0, 8}};
  for (const Triangle& face : faces) mesh.add_face(face);
  const Topology& topology = mesh.topology();
  const Adjacency fans = fans_of(topology);
  for (Index i = 0; i < 9; ++i) {
    std::vector<Triangle> expected;
    for (const Index t : topology.vertex_triangles[i]) {
      Triangle face = topology.triangles[t];
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      expected.push_back(face);
    }
    EXPECT_THAT(triangles_of(fans, i), UnorderedElementsAreArray(expected)) << "vertex " << i;
  }
}

TEST(Fans, ManifoldVertexHasOne) {
  const Topology sphere = build_topology(icosphere(1));
  const Adjacency fans = fans_of(sphere);
  for (Index i = 0; i < sphere.vertex_count(); ++i) {
    EXPECT_EQ(fans.size(i), sphere.vertex_triangles.size(i) + 1);
  }
  Mesh corner;
  corner.positions.assign(3, Vector3d::Zero());
  corner.add_face(std::array<Index, 3>{0, 1, 2});
  const Topology& triangle = corner.topology();
  EXPECT_THAT(fans_of(triangle)[1], ElementsAre(2 | kFanBegins, 0));
}

}  // namespace
}  // namespace lapwing
