#include "lapwing/transfer/transfer.h"

#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide_mesh.h"
#include "support/error_message.h"
#include "support/joined_meshes.h"
#include "support/largest_distance.h"
#include "support/models.h"
#include "support/split_meshes.h"
#include "wrap/known_scan.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::largest_distance;
using ::testing::HasSubstr;

TransferSolver solver(const Mesh& source, const Mesh& target, const TransferRequest& request = {}) {
  CpuKernels kernels;
  return TransferSolver(source, target, request, kernels);
}

Positions moved(Positions positions, const Affine3d& motion) {
  for (Vector3d& p : positions) p = motion * p;
  return positions;
}

Mesh with_positions(Mesh mesh, Positions positions) {
  mesh.positions = std::move(positions);
  return mesh;
}

// Bends a shape about the y axis by `degrees` per unit of z above 0, and widens it there.
Positions bent(Positions positions, double degrees = 30.0) {
  for (Vector3d& p : positions) {
    const double z = std::max(p.z(), 0.0);
    const double angle = degrees * z * 3.14159265358979 / 180.0;
    const Vector3d across(p.x() * (1.0 + 0.2 * z), p.y(), 0.0);
    p = AngleAxisd(angle, Vector3d::UnitY()) * across +
        Vector3d(z * std::sin(0.5 * angle), 0.0, p.z() * std::cos(0.5 * angle));
  }
  return positions;
}

Mesh tube() {
  return cylinder(24, 30, 0.5, 3.0);
}

double diagonal(const Positions& positions) {
  return bounds_of(positions).diagonal();
}

const Affine3d kMotion(Eigen::Translation3d(4.0, -1.0, 2.0) *
                       AngleAxisd(2.0, Vector3d(1, 2, 3).normalized()));

TEST(Transfer, OfTheRestPoseKeepsTheTarget) {
  const Mesh source = tube();
  const Mesh target = with_positions(tube(), bent(tube().positions, -10.0));
  const Transferred result = solver(source, target).solve(source.positions);
  EXPECT_LT(largest_distance(result.positions, target.positions),
            1e-6 * diagonal(target.positions));
  EXPECT_NEAR(result.report.largest_rotation_degrees, 0.0, 1e-6);
  EXPECT_NEAR(result.report.edge_stretch, 0.0, 1e-6);
}

TEST(Transfer, ToTheSameMeshIsThePose) {
  const Mesh mesh = tube();
  const Positions pose = moved(bent(mesh.positions), kMotion);
  const Transferred result = solver(mesh, mesh).solve(pose);
  EXPECT_LT(largest_distance(result.positions, pose), 1e-6 * diagonal(pose));
  EXPECT_EQ(result.report.flipped_triangles, 0U);
}

TEST(Transfer, ToARotatedAndScaledCopyIsThePoseRotatedAndScaled) {
  const Mesh mesh = tube();
  const Affine3d placed = kMotion * Eigen::Scaling(3.0);
  const Mesh target = with_positions(mesh, moved(mesh.positions, placed));
  const Positions pose = bent(mesh.positions);
  const Positions expected = moved(pose, placed);
  EXPECT_LT(largest_distance(solver(mesh, target).solve(pose).positions, expected),
            1e-6 * diagonal(expected));
}

TEST(Transfer, OfARigidMotionMovesTheTargetByTheSameRotation) {
  const Mesh source = tube();
  const Mesh target = with_positions(tube(), bent(tube().positions, 15.0));
  const TransferSolver transfer = solver(source, target);
  const Transferred result = transfer.solve(moved(source.positions, kMotion));
  // The similarity between the frames rotates the axis of the motion. The shape stays the same.
  EXPECT_NEAR(result.report.largest_rotation_degrees, 2.0 * 180.0 / 3.14159265358979, 1e-6);
  EXPECT_NEAR(result.report.edge_stretch, 0.0, 1e-6);
  // Counterparts in the same frame: the same rotation, up to a translation.
  const Mesh fine = subdivide(source, {});
  TransferRequest request;
  request.on_source = fine.positions;
  Positions found = solver(source, fine, request).solve(moved(source.positions, kMotion)).positions;
  Positions expected = moved(fine.positions, kMotion);
  const Vector3d shift = expected[0] - found[0];
  for (Vector3d& p : found) p += shift;
  EXPECT_LT(largest_distance(found, expected), 1e-6 * diagonal(expected));
}

TEST(Transfer, ToASubdividedCopyIsTheSubdividedPose) {
  const Mesh source = cylinder(36, 45, 0.5, 3.0);
  const Mesh target = subdivide(source, {});
  const Mesh pose = with_positions(source, bent(source.positions));
  const Positions expected = subdivide(pose, {}).positions;
  TransferRequest known;
  known.on_source = target.positions;
  EXPECT_LT(
      largest_distance(solver(source, target, known).solve(pose.positions).positions, expected),
      1e-3 * diagonal(expected));
  const TransferSolver wrapped = solver(source, target, {.aligned = true});
  ASSERT_TRUE(wrapped.wrap_report().has_value());
  EXPECT_LT(largest_distance(wrapped.solve(pose.positions).positions, expected),
            1e-3 * diagonal(expected));
}

TEST(Transfer, HeldVerticesDoNotMove) {
  const Mesh mesh = tube();
  TransferRequest request;
  request.held = RegionSpec{ListedVertices{{0, 1, 2, 3, 4, 5}}, "held"};
  const Positions pose = moved(bent(mesh.positions), kMotion);
  const Positions result = solver(mesh, mesh, request).solve(pose).positions;
  for (const Index v : {0U, 3U, 5U}) {
    EXPECT_LT((result[v] - mesh.positions[v]).norm(), 1e-3) << v;
  }
  EXPECT_GT(largest_distance(result, mesh.positions), 1.0);
}

TEST(Transfer, PartsWithoutCounterpartsRideAlong) {
  const Mesh mesh = tube();
  TransferRequest request;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double z = mesh.positions[v].z();
    request.counterparts.push_back(z > 1.2 && z < 1.8 ? SurfacePoint::nowhere()
                                                      : SurfacePoint::at_vertex(v));
  }
  const TransferSolver transfer = solver(mesh, mesh, request);
  EXPECT_NEAR(transfer.unmatched_area(), 0.25, 0.1);
  const Positions pose = bent(mesh.positions);
  const Transferred result = transfer.solve(pose);
  EXPECT_LT(largest_distance(result.positions, pose), 0.02 * diagonal(pose));
  EXPECT_EQ(result.report.flipped_triangles, 0U);
}

// A tube with two balls at its upper end: one has counterparts, the other has none.
TEST(Transfer, OtherComponentsStayAtTheSurface) {
  Mesh ball = icosphere(1);
  for (Vector3d& p : ball.positions) p = 0.1 * p + Vector3d(0.62, 0.0, 2.5);
  const Mesh mesh = test::joined(tube(), ball);
  const Positions pose = moved(bent(mesh.positions), kMotion);
  EXPECT_LT(largest_distance(solver(mesh, mesh).solve(pose).positions, pose),
            1e-6 * diagonal(pose));
  TransferRequest request;
  const auto tube_count = static_cast<Index>(tube().vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    request.counterparts.push_back(v < tube_count ? SurfacePoint::at_vertex(v)
                                                  : SurfacePoint::nowhere());
  }
  const Positions result = solver(mesh, mesh, request).solve(pose).positions;
  for (Index v = tube_count; v < mesh.vertex_count(); ++v) {
    EXPECT_LT((result[v] - pose[v]).norm(), 0.15) << v;
    EXPECT_NEAR((result[v] - result[tube_count]).norm(),
                (mesh.positions[v] - mesh.positions[tube_count]).norm(), 1e-9);
  }
}

TEST(Transfer, SeamsOfBothMeshesAreJoined) {
  Mesh mesh = icosphere(3);
  for (Vector3d& p : mesh.positions) p = p.cwiseProduct(Vector3d(0.5, 0.4, 1.5));
  const Positions pose = moved(bent(mesh.positions), kMotion);
  const test::SplitMesh split = test::halves(mesh);
  Positions split_pose;
  for (const Index v : split.sources) split_pose.push_back(pose[v]);
  const auto error_of = [&](const Mesh& source, const Mesh& target, const Positions& source_pose,
                            const Positions& expected) {
    TransferRequest request;
    request.on_source = target.positions;
    return largest_distance(solver(source, target, request).solve(source_pose).positions,
                            expected) /
           diagonal(expected);
  };
  EXPECT_LT(error_of(split.mesh, mesh, split_pose, pose), 1e-6);
  EXPECT_LT(error_of(mesh, split.mesh, pose, split_pose), 1e-6);
  EXPECT_LT(
      largest_distance(solver(split.mesh, split.mesh).solve(split_pose).positions, split_pose),
      1e-6 * diagonal(pose));
}

TEST(Transfer, PosesDoNotAffectEachOther) {
  const Mesh source = tube();
  const Mesh target = subdivide(source, {});
  TransferRequest request;
  request.on_source = target.positions;
  const TransferSolver transfer = solver(source, target, request);
  std::vector<Positions> together(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < together.size(); ++k) {
      threads.emplace_back([&, k] {
        together[k] =
            transfer.solve(bent(source.positions, 10.0 * static_cast<double>(k))).positions;
      });
    }
  }
  for (std::size_t k = 0; k < together.size(); ++k) {
    const Positions alone = solver(source, target, request)
                                .solve(bent(source.positions, 10.0 * static_cast<double>(k)))
                                .positions;
    EXPECT_EQ(together[k], alone) << k;
  }
}

TEST(Transfer, RefusesWhatDoesNotFit) {
  const Mesh mesh = tube();
  const auto refusal = [&](const Mesh& source, const Mesh& target,
                           const TransferRequest& request = {}) {
    return error_message<InputError>([&] { solver(source, target, request); });
  };
  EXPECT_THAT(refusal(Mesh{}, mesh), HasSubstr("source"));
  EXPECT_THAT(refusal(mesh, Mesh{}), HasSubstr("target"));
  TransferRequest request{.counterparts = {SurfacePoint::at_vertex(0)}};
  EXPECT_THAT(refusal(mesh, mesh, request), HasSubstr("counterparts: there are 1"));
  request.counterparts.assign(mesh.vertex_count(), SurfacePoint::nowhere());
  EXPECT_THAT(refusal(mesh, mesh, request), HasSubstr("Fewer than three vertices"));
  request.counterparts[7] = SurfacePoint::at_vertex(100000);
  EXPECT_THAT(refusal(mesh, mesh, request), HasSubstr("vertex 7"));
  request.counterparts[7] = {{0, 1, 2}, {0.5, -0.5, 1.0}};
  EXPECT_THAT(refusal(mesh, mesh, request), HasSubstr("vertex 7"));
  Mesh broken = mesh;
  broken.positions[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(broken, mesh), HasSubstr("5"));
  EXPECT_THAT(refusal(mesh, broken), HasSubstr("5"));

  const TransferSolver transfer = solver(mesh, mesh);
  EXPECT_THAT(error_message<InputError>([&] { transfer.solve({}); }),
              HasSubstr("pose: it has 0 vertices"));
  EXPECT_THAT(error_message<InputError>([&] { transfer.solve(broken.positions, "walk.ply"); }),
              HasSubstr("walk.ply: vertex 5 is not finite"));
}

TEST(Transfer, RefusesHeldVerticesWithoutCounterparts) {
  Mesh ball = icosphere(1);
  for (Vector3d& p : ball.positions) p += Vector3d(5.0, 0.0, 0.0);
  const Mesh mesh = test::joined(tube(), ball);
  const auto tube_count = static_cast<Index>(tube().vertex_count());
  TransferRequest request;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    request.counterparts.push_back(v < tube_count ? SurfacePoint::at_vertex(v)
                                                  : SurfacePoint::nowhere());
  }
  request.held = RegionSpec{ListedVertices{{tube_count}}, "held"};
  EXPECT_THAT(error_message<InputError>([&] { solver(mesh, mesh, request); }), HasSubstr("held"));
}

TEST(TransferOfTheElephant, ToItsDeformedRemeshedCopyFollowsThePose) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const auto file = std::ranges::find(files, "elephant.off",
                                      [](const auto& path) { return path.filename().string(); });
  ASSERT_NE(file, files.end());
  const Mesh source = read_mesh(*file);
  const test::KnownScan known = test::known_scan(source, 0.8);
  // Of the target, only the places of the source's vertices are known. They are landmarks.
  const std::vector<Index> vertices = test::spread_vertices(source.positions, 8);
  TransferRequest request;
  for (const Index v : vertices) {
    request.landmarks.rows.push_back({.point = known.places[v], .position = source.positions[v]});
  }
  const TransferSolver transfer = solver(source, known.scan, request);
  EXPECT_LT(transfer.unmatched_area(), 0.1);
  const Transferred rest = transfer.solve(source.positions);
  EXPECT_LT(largest_distance(rest.positions, known.scan.positions),
            1e-6 * diagonal(known.scan.positions));
  const Transferred rotated = transfer.solve(moved(source.positions, kMotion));
  EXPECT_NEAR(rotated.report.edge_stretch, 0.0, 1e-6);
  EXPECT_EQ(rotated.report.flipped_triangles, 0U);
}

}  // namespace
}  // namespace lapwing
