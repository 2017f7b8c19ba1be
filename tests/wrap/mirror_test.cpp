// Wraps of symmetric templates with `mirror`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deform/mirror_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "support/error_message.h"
#include "wrap/known_scan.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The mesh is a ball that is symmetric about x = 0. The scan has a dent on one side, and is placed
// elsewhere.
struct DentedScan {
  explicit DentedScan(int subdivisions) : mesh(icosphere(subdivisions)), scan(icosphere(4)) {
    for (Positions* positions : {&mesh.positions, &scan.positions}) {
      for (Vector3d& p : *positions) p = p.cwiseProduct(Vector3d(1.0, 1.3, 1.8));
    }
    places = mesh.positions;
    for (Positions* positions : {&scan.positions, &places}) {
      for (Vector3d& p : *positions) {
        if (p.x() > 0.0) p.x() *= 1.0 - 0.3 * std::exp(-4.0 * (p.y() * p.y() + p.z() * p.z()));
        p = away * p;
      }
    }
  }
  // The asymmetry of a result, as a fraction of the diagonal.
  double asymmetry(const Wrapped& result) const {
    Positions back = result.positions;
    for (Vector3d& p : back) p = result.report.alignment.map.inverse() * p;
    return test::asymmetry(test::MirrorScene{.mesh = mesh}, back);
  }

  Mesh mesh;
  Mesh scan;
  Positions places;  // of the mesh's vertices on the scan
  Eigen::Affine3d away = Eigen::Translation3d(3.0, 1.0, -2.0) *
                         Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()) *
                         Eigen::Scaling(1.7);
};

Wrapped wrap_on_cpu(const Mesh& mesh, const Mesh& scan, const WrapRequest& request) {
  CpuKernels kernels;
  return wrap(mesh, scan, request, kernels);
}

// The second template is so large that a decimated copy is wrapped first.
TEST(WrapWithMirror, IsSymmetricOnAScanThatIsNot) {
  for (const int subdivisions : {3, 5}) {
    const DentedScan dented(subdivisions);
    WrapRequest request{.landmarks = test::landmarks_at(
                            test::spread_vertices(dented.mesh.positions, 6), dented.places)};
    if (subdivisions == 3) {
      EXPECT_GT(dented.asymmetry(wrap_on_cpu(dented.mesh, dented.scan, request)), 0.01);
    }
    request.mirror = MirrorSpec{MirrorPlane{}};
    const Wrapped result = wrap_on_cpu(dented.mesh, dented.scan, request);
    EXPECT_LT(dented.asymmetry(result), 1e-9);
    EXPECT_LT(result.report.to_scan.mean, 0.02 * bounds_of(dented.scan.positions).diagonal());
    EXPECT_EQ(why_failed(result.report, dented.mesh.face_count()), "");
  }
}

TEST(WrapWithMirror, FindsThePlaneOfSymmetry) {
  const DentedScan dented(3);
  // Without the other symmetries of the ball, the plane is unique.
  Mesh mesh = dented.mesh;
  for (Vector3d& p : mesh.positions) p += Vector3d(0.0, 0.2 * p.z() * p.z(), 0.2 * p.y() * p.y());
  const Wrapped result =
      wrap_on_cpu(mesh, mesh, {.aligned = true, .mirror = MirrorSpec{AutomaticMirror{}}});
  EXPECT_LT(test::asymmetry(test::MirrorScene{.mesh = mesh}, result.positions), 1e-9);
  EXPECT_LT(test::mean_error(result.positions, mesh.positions), 1e-5);
}

// Half of the scan is missing.
TEST(WrapWithMirror, CompletesTheSideThatTheScanLacks) {
  const Mesh mesh = icosphere(3);
  Mesh scan = icosphere(4);
  for (Vector3d& p : scan.positions) p = p.cwiseProduct(Vector3d(1.2, 1.0, 0.9));
  const Mesh whole = scan;
  KeepMask right(scan.vertex_count());
  for (Index v = 0; v < scan.vertex_count(); ++v) right[v] = scan.positions[v].x() > -0.05;
  keep_vertices(scan, right);
  const Wrapped half =
      wrap_on_cpu(mesh, scan, {.aligned = true, .mirror = MirrorSpec{MirrorPlane{}}});
  const Wrapped expected = wrap_on_cpu(mesh, whole, {.aligned = true});
  EXPECT_LT(test::mean_error(half.positions, expected.positions), 2e-3);
}

TEST(WrapWithMirror, LandmarksOfOneSideHoldForBoth) {
  const Mesh mesh = icosphere(3);
  const std::vector<Index> images = mirror_images(mesh, {}, "mirror");
  const Index side =
      static_cast<Index>(std::ranges::max_element(mesh.positions, {},
                                                  [](const Vector3d& p) { return p.x() + p.y(); }) -
                         mesh.positions.begin());
  const Vector3d place = Eigen::AngleAxisd(0.2, Vector3d::UnitZ()) * mesh.positions[side];
  WrapRequest request{.aligned = true, .mirror = MirrorSpec{MirrorPlane{}}};
  request.landmarks.rows = {{.point = side, .position = place}};
  const Wrapped one = wrap_on_cpu(mesh, mesh, request);
  const Vector3d mirrored = place.cwiseProduct(Vector3d(-1.0, 1.0, 1.0));
  EXPECT_LT((one.positions[side] - place).norm(), 0.01);
  EXPECT_LT((one.positions[images[side]] - mirrored).norm(), 0.01);
  // Landmarks on both sides are compatible with their images.
  request.landmarks.rows.push_back({.point = images[side], .position = mirrored});
  const Wrapped both = wrap_on_cpu(mesh, mesh, request);
  EXPECT_LT(test::mean_error(both.positions, one.positions), 0.01);
}

TEST(WrapWithMirror, NamesAVertexWithoutAMirrorImage) {
  Mesh mesh = icosphere(2);
  const auto refusal = [&](const MirrorPlane& plane) {
    return error_message<InputError>(
        [&] { wrap_on_cpu(mesh, mesh, {.aligned = true, .mirror = MirrorSpec{plane}}); });
  };
  EXPECT_THAT(refusal({.point = Vector3d(5.0, 0.0, 0.0)}),
              testing::HasSubstr("mirror: the mirror plane does not pass through the mesh"));
  EXPECT_THAT(refusal({.normal = Vector3d(1.0, 0.3, 0.1)}),
              testing::AllOf(testing::HasSubstr("of the template has no mirror image"),
                             testing::HasSubstr("the plane of symmetry")));
  const Index far = static_cast<Index>(
      std::ranges::max_element(mesh.positions, {}, [](const Vector3d& p) { return p.x(); }) -
      mesh.positions.begin());
  mesh.positions[far].x() *= 1.5;
  EXPECT_THAT(refusal({}), testing::HasSubstr("away from its mirrored position"));
}

}  // namespace
}  // namespace lapwing
