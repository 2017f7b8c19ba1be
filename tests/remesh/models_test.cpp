// Debian's meshes: scans, mechanical parts, models made by hand.
#include "support/models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/remesh/remesh.h"
#include "remesh/remesh_checks.h"

namespace lapwing {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr std::size_t kMostVertices = 8000;

double mean_edge(const Mesh& mesh) {
  return mean_edge_length(mesh.topology().rings, mesh.positions);
}

TEST(RemeshModels, KeepTheirTopologyOrAreRefusedByName) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  std::size_t remeshed = 0;
  for (const auto& file : files) {
    Mesh mesh;
    try {
      mesh = read_mesh(file);
    } catch (const Error&) {
      continue;  // the corpus holds broken files too
    }
    const double edge = mean_edge(mesh);
    if (mesh.vertex_count() > kMostVertices || !(edge > 0.0)) continue;
    for (const double scale : {0.8, 2.0}) {
      try {
        const RemeshResult result = remesh_all(mesh, scale * edge, {.iterations = 2});
        ++remeshed;
        const Shape before = shape_of(mesh);
        const Shape after = shape_of(result.mesh);
        EXPECT_EQ(after, before) << file;
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    ::testing::AnyOf(::testing::HasSubstr("vert"), ::testing::HasSubstr("face")))
            << file;
      }
    }
  }
  EXPECT_GT(remeshed, 100U);
}

TEST(RemeshModels, HalfAnArmadilloIsRemeshedAndTheOtherHalfIsNot) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh mesh = read_mesh(models_folder() / "cgal/meshes/armadillo.off");
  const double middle = bounds_of(mesh.positions).center().y();
  const VertexSet region = vertices_where(mesh, [&](const Vector3d& p) { return p.y() > middle; });
  const double length = 1.2 * mean_edge(mesh);
  const RemeshResult result = remesh_isotropic(mesh, region, everywhere(length));
  expect_outside_unchanged(mesh, region, result);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_LT(region_quality(result.mesh, result.region).vertices,
            region_quality(mesh, region).vertices);
}

// Edges whose triangles look away from each other by more than 120 degrees.
std::size_t count_folds(const Mesh& mesh) {
  const Edges edges = build_edges(mesh);
  std::size_t folds = 0;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.sides.size(e) != 2) continue;
    const Vector3d a = area_vector(mesh, edges.face_of_corner[edges.sides[e][0]]);
    const Vector3d b = area_vector(mesh, edges.face_of_corner[edges.sides[e][1]]);
    folds += a.dot(b) < -0.5 * a.norm() * b.norm();
  }
  return folds;
}

TEST(RemeshModels, CoarseArmadilloHasNoMoreFoldsThanTheScan) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh mesh = read_mesh(models_folder() / "cgal/meshes/armadillo.off");
  const RemeshResult result = remesh_all(mesh, 2.0 * mean_edge(mesh));
  EXPECT_LE(count_folds(result.mesh), count_folds(mesh));
}

TEST(RemeshModels, ScannedBunnyBecomesUniform) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh mesh = read_mesh(models_folder() / "cgal/meshes/bunny00.off");
  const double length = 2.0 * mean_edge(mesh);
  const RemeshResult result = remesh_all(mesh, length);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_GE(share_of_good_edges(result.mesh, everywhere(length)), 0.99);
  EXPECT_GE(region_quality(result.mesh, result.region).smallest_angle_degrees, 20.0);
  EXPECT_NEAR(volume(result.mesh) / volume(mesh), 1.0, 0.005);
}

}  // namespace
}  // namespace lapwing
