#include "lapwing/wrap/wrap.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"
#include "support/models.h"
#include "support/split_meshes.h"
#include "wrap/known_scan.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::KnownScan;
using test::mean_error;

Wrapped wrapped(const Mesh& mesh, const Mesh& scan, const WrapRequest& request = {}) {
  CpuKernels kernels;
  return wrap(mesh, scan, request, kernels);
}

Mesh egg() {
  Mesh mesh = icosphere(3);
  for (Vector3d& p : mesh.positions) p = p.cwiseProduct(Vector3d(1.0, 1.3, 1.8));
  return mesh;
}

TEST(Wrap, OntoItselfKeepsTheTemplate) {
  const Mesh mesh = egg();
  const Wrapped result = wrapped(mesh, mesh, {.aligned = true});
  EXPECT_LT(mean_error(result.positions, mesh.positions), 1e-6);
  EXPECT_DOUBLE_EQ(result.report.coverage, 1.0);
  EXPECT_EQ(result.report.alignment.method, AlignmentMethod::none);
  const Wrapped detailed = wrapped(mesh, mesh, {.aligned = true, .detail = true});
  EXPECT_LT(mean_error(detailed.positions, mesh.positions), 1e-6);
}

TEST(Wrap, CoversAScanOfOtherTriangles) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) p = p.cwiseProduct(Vector3d(1.2, 1.0, 0.9));
  const Wrapped result = wrapped(mesh, scan, {.aligned = true});
  const double size = bounds_of(scan.positions).diagonal();
  EXPECT_LT(result.report.to_scan.mean, 5e-4 * size);
  EXPECT_LE(result.report.to_scan.mean, result.report.to_scan.percentile_95);
  EXPECT_LE(result.report.to_scan.percentile_95, result.report.to_scan.max);
  EXPECT_EQ(result.report.flipped_triangles, 0U);
  EXPECT_EQ(why_failed(result.report, mesh.face_count()), "");
}

TEST(Wrap, CounterpartsAreOnTheScanBesideTheResult) {
  const Mesh mesh = icosphere(3);
  const Mesh scan = icosphere(4);
  const Wrapped result = wrapped(mesh, scan, {.aligned = true});
  ASSERT_EQ(result.counterparts.size(), mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_FALSE(result.counterparts[v].is_nowhere()) << v;
    const auto place = result.counterparts[v].of(std::span<const Vector3d>(scan.positions));
    EXPECT_LT((place - result.positions[v]).norm(), 0.02) << v;
  }
}

// The upper half of the scan is missing.
TEST(Wrap, PartsWithoutACounterpartKeepTheirShape) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  KeepMask lower(scan.vertex_count());
  for (Index v = 0; v < scan.vertex_count(); ++v) lower[v] = scan.positions[v].z() < 0.2;
  keep_vertices(scan, lower);
  for (Vector3d& p : scan.positions) p += Vector3d(0.1, 0.0, 0.0);
  const Wrapped result = wrapped(mesh, scan, {.aligned = true});
  EXPECT_NEAR(result.report.coverage, 0.6, 0.1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3d place = mesh.positions[v] + Vector3d(0.1, 0.0, 0.0);
    EXPECT_LT((result.positions[v] - place).norm(), 0.1) << v;
    if (mesh.positions[v].z() > 0.5) {
      EXPECT_TRUE(result.counterparts[v].is_nowhere()) << v;
    }
  }
}

TEST(Wrap, ReachesItsLandmarks) {
  const Mesh mesh = icosphere(3);
  const std::vector<Index> vertices = test::spread_vertices(mesh.positions, 5);
  // The sphere is rotated about its centre, which only landmarks can detect.
  Positions places = mesh.positions;
  const Eigen::AngleAxisd turn(0.5, Vector3d::UnitZ());
  for (Vector3d& p : places) p = turn * p;
  WrapRequest request{.landmarks = test::landmarks_at(vertices, places)};
  const Wrapped result = wrapped(mesh, mesh, request);
  EXPECT_EQ(result.report.alignment.method, AlignmentMethod::landmarks);
  EXPECT_LT(result.report.landmark_error, 1e-3);
  EXPECT_LT(mean_error(result.positions, places), 1e-3);
}

// The landmarks are off the scan, so that the springs of their neighbours pull them back.
TEST(Wrap, ReachesHardLandmarksExactly) {
  const Mesh mesh = icosphere(3);
  WrapRequest request{.aligned = true};
  request.landmarks.rows = {{.point = Index{0}, .position = 1.2 * mesh.positions[0]},
                            {.point = Vector3d(0.0, 0.6, 0.8), .position = Vector3d(0, 0.7, 0.9)}};
  EXPECT_GT(wrapped(mesh, mesh, request).report.landmark_error, 1e-3);
  request.landmarks.hard = true;
  EXPECT_LT(wrapped(mesh, mesh, request).report.landmark_error, 1e-6);
  request.detail = true;
  EXPECT_LT(wrapped(mesh, mesh, request).report.landmark_error, 1e-6);
}

TEST(Wrap, WithDetailMovesVerticesExactlyOntoTheScan) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) {
    p *= 1.0 + 0.02 * std::sin(8.0 * p.x()) * std::sin(8.0 * p.y());
  }
  KeepMask lower(scan.vertex_count());
  for (Index v = 0; v < scan.vertex_count(); ++v) lower[v] = scan.positions[v].z() < 0.5;
  keep_vertices(scan, lower);
  const Wrapped plain = wrapped(mesh, scan, {.aligned = true});
  const Wrapped result = wrapped(mesh, scan, {.aligned = true, .detail = true});
  std::size_t covered = 0;
  double farthest = 0.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (plain.counterparts[v].is_nowhere()) {
      // The rest continues the covered part.
      EXPECT_LT((result.positions[v] - plain.positions[v]).norm(), 0.02) << v;
      continue;
    }
    ++covered;
    farthest = std::max(farthest, double{plain.distances[v]});
    EXPECT_LT(result.distances[v], 1e-9) << v;
  }
  EXPECT_GT(covered, mesh.vertex_count() / 2);
  EXPECT_GT(farthest, 1e-3);
  EXPECT_EQ(result.report.flipped_triangles, 0U);
}

TEST(Wrap, IsTheSameAfterARotationOfTheScan) {
  const Mesh mesh = egg();
  const KnownScan known = test::known_scan(mesh, 0.9);
  const std::vector<Index> vertices = test::spread_vertices(mesh.positions, 6);
  const Wrapped result =
      wrapped(mesh, known.scan, {.landmarks = test::landmarks_at(vertices, known.places)});
  const Eigen::Affine3d turn(Eigen::Translation3d(-2.0, 5.0, 1.0) *
                             Eigen::AngleAxisd(1.1, Vector3d(3, 1, 2).normalized()));
  KnownScan turned = known;
  for (Vector3d& p : turned.scan.positions) p = turn * p;
  for (Vector3d& p : turned.places) p = turn * p;
  const Wrapped other =
      wrapped(mesh, turned.scan, {.landmarks = test::landmarks_at(vertices, turned.places)});
  Positions back = other.positions;
  for (Vector3d& p : back) p = turn.inverse() * p;
  EXPECT_LT(mean_error(back, result.positions), 1e-4);
}

// The template is so large that a decimated copy is wrapped first.
TEST(Wrap, CoversAScanWithALargeTemplate) {
  Mesh mesh = icosphere(5);
  ASSERT_GT(mesh.vertex_count(), 6000U);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) {
    p = Eigen::AngleAxisd(0.6 * p.z(), Vector3d::UnitX()) * p.cwiseProduct(Vector3d(1.2, 1.0, 1.6));
  }
  const Wrapped result = wrapped(mesh, scan, {.aligned = true});
  EXPECT_LT(result.report.to_scan.mean, 1e-3 * bounds_of(scan.positions).diagonal());
  EXPECT_LT(result.report.to_template.percentile_95, 2e-3 * bounds_of(scan.positions).diagonal());
  EXPECT_EQ(result.report.flipped_triangles, 0U);
}

TEST(Wrap, KeepsSeamsClosed) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) p = p.cwiseProduct(Vector3d(1.2, 1.0, 0.8));
  const test::SplitMesh torn = test::soup(mesh);
  const Wrapped result = wrapped(torn.mesh, test::soup(scan).mesh, {.aligned = true});
  EXPECT_LT(result.report.to_scan.mean, 1e-3 * bounds_of(scan.positions).diagonal());
  for (Index v = 0; v < torn.mesh.vertex_count(); ++v) {
    const auto first = std::ranges::find(torn.sources, torn.sources[v]) - torn.sources.begin();
    EXPECT_EQ(result.positions[v], result.positions[static_cast<std::size_t>(first)]) << v;
    EXPECT_FALSE(result.counterparts[v].is_nowhere()) << v;
    EXPECT_TRUE(std::isfinite(result.distances[v])) << v;
  }
}

TEST(Wrap, FollowsAPointCloudWithNormals) {
  const Mesh mesh = egg();
  Mesh scan;
  const Mesh surface = icosphere(4);
  for (const Vector3d& p : surface.positions) {
    scan.positions.push_back(p.cwiseProduct(Vector3d(1.1, 1.4, 1.7)));
    scan.edit_attributes().normals.push_back(p.cwiseQuotient(Vector3d(1.1, 1.4, 1.7)));
  }
  const Wrapped result = wrapped(mesh, scan);
  EXPECT_LT(result.report.to_scan.mean, 2e-3 * bounds_of(scan.positions).diagonal());
  EXPECT_GT(result.report.coverage, 0.95);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const SurfacePoint& point = result.counterparts[v];
    if (point.is_nowhere()) continue;
    EXPECT_EQ(point.weights[0], 1.0);
    ASSERT_LT(point.corners[0], scan.vertex_count());
    EXPECT_LT((scan.positions[point.corners[0]] - result.positions[v]).norm(), 0.25) << v;
  }
}

TEST(Wrap, RefusesAPointCloudWithoutNormals) {
  Mesh scan;
  scan.positions = icosphere(2).positions;
  EXPECT_THAT(
      error_message<InputError>([&] { wrapped(egg(), scan); }),
      testing::AllOf(testing::HasSubstr("scan: it has 162 points"), testing::HasSubstr("normals")));
  scan.positions.resize(4);
  EXPECT_THAT(error_message<InputError>([&] { wrapped(egg(), scan); }),
              testing::HasSubstr("at least 7 points"));
}

TEST(Wrap, KeepsRigidPartsRigid) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) p = p.cwiseProduct(Vector3d(1.4, 1.0, 1.0));
  ListedVertices rigid;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() > 0.5) rigid.vertices.push_back(v);
  }
  const Wrapped result =
      wrapped(mesh, scan, {.aligned = true, .stiffness = {{.region = {rigid, "rigid"}}}});
  const Index first = rigid.vertices.front();
  for (const Index v : rigid.vertices) {
    EXPECT_NEAR((result.positions[v] - result.positions[first]).norm(),
                (mesh.positions[v] - mesh.positions[first]).norm(), 1e-5);
  }
  EXPECT_NEAR(bounds_of(result.positions).max.x(), 1.4, 0.05);
}

TEST(Wrap, AlignsAScanInAnotherUnit) {
  const Mesh mesh = egg();
  Mesh scan = mesh;
  for (Vector3d& p : scan.positions) p = 1000.0 * p + Vector3d(500.0, 0.0, 0.0);
  const Wrapped result = wrapped(mesh, scan);
  EXPECT_NEAR(result.report.alignment.scale, 1000.0, 1.0);
  EXPECT_LT(result.report.to_scan.mean, 1e-3 * bounds_of(scan.positions).diagonal());
}

TEST(Wrap, NamesALandmarkThatContradictsTheOthers) {
  const Mesh mesh = egg();
  std::vector<Index> vertices = test::spread_vertices(mesh.positions, 6);
  WrapRequest request{.landmarks = test::landmarks_at(vertices, mesh.positions)};
  request.landmarks.rows[3].position = -request.landmarks.rows[3].position;
  const Wrapped result = wrapped(mesh, mesh, request);
  EXPECT_EQ(result.report.farthest_landmark, 3U);
  EXPECT_THAT(why_failed(result.report, mesh.face_count()),
              testing::HasSubstr("probably landmark 4"));
}

TEST(Wrap, RefusesWhatIsNoSurfaceAndLandmarksThatDoNotFit) {
  const Mesh mesh = icosphere(1);
  Mesh points;
  EXPECT_THAT(error_message<InputError>([&] { wrapped(mesh, points); }),
              testing::HasSubstr("scan"));
  EXPECT_THAT(error_message<InputError>([&] { wrapped(points, mesh); }),
              testing::HasSubstr("template"));
  WrapRequest request;
  request.landmarks.rows = {{.point = Index{999}, .position = Vector3d::Zero()}};
  EXPECT_THAT(error_message<InputError>([&] { wrapped(mesh, mesh, request); }),
              testing::HasSubstr("landmarks"));
}

TEST(WhyFailed, NamesWhatIsWrongAndWhatToTry) {
  WrapReport report{.coverage = 0.3};
  EXPECT_THAT(why_failed(report, 1000), testing::HasSubstr("30%"));
  report.coverage = 0.9;
  EXPECT_EQ(why_failed(report, 1000), "");
  report.flipped_triangles = 2;
  EXPECT_THAT(why_failed(report, 1000), testing::HasSubstr("2 of 1000 triangles"));
}

Mesh model(std::span<const std::filesystem::path> files, const std::string& name) {
  const auto file =
      std::ranges::find(files, name, [](const auto& path) { return path.filename().string(); });
  EXPECT_NE(file, files.end()) << name;
  return file == files.end() ? Mesh() : read_mesh(*file);
}

TEST(WrapOfTheElephant, FindsItsPlacesWithAndWithoutLandmarks) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh mesh = model(files, "elephant.off");
  const KnownScan known = test::known_scan(mesh, 0.8);
  const std::vector<Index> vertices = test::spread_vertices(mesh.positions, 8);
  const Wrapped by_landmarks =
      wrapped(mesh, known.scan, {.landmarks = test::landmarks_at(vertices, known.places)});
  EXPECT_LT(mean_error(by_landmarks.positions, known.places), 0.006);
  EXPECT_GT(by_landmarks.report.coverage, 0.95);
  const Wrapped by_surfaces = wrapped(mesh, known.scan);
  EXPECT_EQ(by_surfaces.report.alignment.method, AlignmentMethod::surfaces);
  EXPECT_LT(mean_error(by_surfaces.positions, known.places), 0.006);
}

// The legs of the elephant are more than twice as thick as those of the cow.
TEST(WrapOfTheCow, CoversTheLegsOfTheElephant) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh cow = model(files, "cow.off");
  const Mesh elephant = model(files, "elephant.off");
  // Vertices of the cow and of the elephant: trunk, tail, feet, ears, joints, chest, belly, back,
  // crown and withers.
  constexpr std::array<std::array<Index, 2>, 18> kPairs{{{2609, 1160},
                                                         {2322, 1159},
                                                         {1876, 309},
                                                         {750, 1671},
                                                         {2104, 2047},
                                                         {881, 2759},
                                                         {2235, 62},
                                                         {1393, 1534},
                                                         {2834, 1836},
                                                         {685, 1054},
                                                         {2039, 1000},
                                                         {806, 1312},
                                                         {2160, 119},
                                                         {9, 539},
                                                         {31, 1723},
                                                         {30, 2689},
                                                         {99, 2594},
                                                         {12, 1464}}};
  WrapRequest request;
  for (const auto& [v, on_scan] : kPairs) {
    request.landmarks.rows.push_back({.point = v, .position = elephant.positions[on_scan]});
  }
  const WrapReport report = wrapped(cow, elephant, request).report;
  const double size = bounds_of(elephant.positions).diagonal();
  EXPECT_LT(report.to_scan.mean, 3.5e-3 * size);
  EXPECT_LT(report.to_template.mean, 2e-3 * size);
  EXPECT_GT(report.coverage, 0.85);
}

}  // namespace
}  // namespace lapwing
