#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/coater.h"
#include "lapwing/coating/fairing.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

// A bumpy sphere: no symmetry, no plane.
Mesh potato() {
  Mesh mesh = icosphere(4);
  for (Vector3d& p : mesh.positions) {
    p *= 1.0 + 0.05 * std::sin(9.0 * p.x() + 1.0) * std::sin(11.0 * p.y()) +
         0.04 * std::sin(14.0 * p.z() + 3.0 * p.x());
  }
  return mesh;
}

constexpr double kDetail = 1.0;

double largest_height(const Coating& coating) {
  double largest = 0.0;
  for (const Vector3d& d : coating.displacement) largest = std::max(largest, d.norm());
  return largest;
}

// What is left of a mesh when the coating of a patch is off.
Mesh bald(const PatchedMesh& source, const Coating& coating) {
  Mesh mesh = source.mesh;
  for (std::size_t own = 0; own < source.patch.vertices.size(); ++own) {
    mesh.positions[source.patch.vertices[own]] = coating.smooth[own];
  }
  return mesh;
}

// The patch of the potato, its coating and the mesh without it.
struct Scene {
  Scene()
      : source(potato(), within(potato(), Vector3d(0.2, 0.3, 1.0), 0.9)),
        coating(peel_cotangent(source, kDetail)),
        target(bald(source, coating), source.patch.vertices) {}

  Positions coat(const std::vector<SurfacePoint>& points, double amplitude,
                 const CoaterOptions& options = {}) {
    Coater coater({target.mesh.positions}, target.topology, target.patch, options, kernels);
    coater.take(coating, points, {});
    return coater.coat(amplitude);
  }

  CpuKernels kernels;
  PatchedMesh source;
  Coating coating;
  PatchedMesh target;
};

// The coating is not 0 on the patch's border, so only vertices inside can come back exactly; with a
// source that is held there they all do.
Mesh held_at_the_border(Mesh mesh, const VertexSet& region) {
  const Topology& topology = mesh.topology();
  const Positions smooth =
      Fairing(mesh.positions, topology, region, LaplacianWeights::cotangent).smooth(kDetail);
  mesh.positions = smooth;
  return mesh;
}

TEST(Coat, GivesASurfaceItsOwnCoatingBack) {
  const Mesh mesh = potato();
  const VertexSet region = within(mesh, Vector3d(0.2, 0.3, 1.0), 0.9);
  const PatchedMesh source(mesh, region);
  const Mesh smooth = held_at_the_border(mesh, source.patch.vertices);
  Coating coating = peel_cotangent(source, kDetail);
  coating.smooth = on_patch<Vector3d>(source.patch, smooth.positions);
  for (std::size_t own = 0; own < coating.smooth.size(); ++own) {
    coating.displacement[own] = coating.positions[own] - coating.smooth[own];
  }
  const PatchedMesh target(smooth, region);
  std::vector<Vector3d> normals(mesh.vertex_count());
  vertex_normals(smooth.positions, target.topology.triangles, target.topology.vertex_triangles,
                 every_vertex(mesh), normals);
  coating.normals = on_patch<Vector3d>(source.patch, normals);

  CpuKernels kernels;
  for (const double hold : {0.0, kDetail}) {
    CoaterOptions options;
    options.hold_length = hold;
    Coater coater({target.mesh.positions}, target.topology, target.patch, options, kernels);
    coater.take(coating, each_to_itself(source.patch), {});
    EXPECT_LT(largest_distance(coater.coat(1.0), mesh.positions), 1e-9);
    EXPECT_LT(coater.relative_residual(), 1e-10);
  }
}

TEST(Coat, GivesASurfaceItsOwnCoatingBackThroughTheDomain) {
  Scene scene;
  const double height = largest_height(scene.coating);
  CoaterOptions options;
  options.hold_length = kDetail;
  for (const Domain domain : {Domain::disk, Domain::square}) {
    CorrespondenceOptions map;
    map.domain = domain;
    const auto correspondence =
        correspond(scene.source.placed(), scene.source.placed(), map, "coat");
    const Positions through = scene.coat(correspondence.points, 1.0, options);
    const Positions direct = scene.coat(each_to_itself(scene.source.patch), 1.0, options);
    EXPECT_LT(largest_distance(through, direct), 0.01 * height);
  }
}

TEST(Coat, OfNoAmplitudeIsTheTargetBitForBit) {
  Scene scene;
  EXPECT_EQ(scene.coat(each_to_itself(scene.source.patch), 0.0), scene.target.mesh.positions);
}

TEST(Coat, IsLinearInItsAmplitudeAndEngravesBelowZero) {
  Scene scene;
  const auto points = each_to_itself(scene.source.patch);
  const Positions once = scene.coat(points, 1.0);
  const Positions engraved = scene.coat(points, -2.0);
  const Positions& rest = scene.target.mesh.positions;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    EXPECT_LT((engraved[v] - rest[v] + 2.0 * (once[v] - rest[v])).norm(), 1e-12);
  }
}

TEST(Coat, LeavesBorderAndOutsideAloneBitForBit) {
  Scene scene;
  const Positions coated = scene.coat(each_to_itself(scene.source.patch), 1.0);
  auto inside = vertex_mask(coated.size(), scene.target.patch.vertices);
  for (const Index own : scene.target.patch.loop) inside[scene.target.patch.vertices[own]] = 0;
  for (std::size_t v = 0; v < coated.size(); ++v) {
    if (inside[v]) continue;
    EXPECT_EQ(coated[v], scene.target.mesh.positions[v]) << v;
  }
}

TEST(Coat, FadesInOverItsTransition) {
  Scene scene;
  const auto points = each_to_itself(scene.source.patch);
  CoaterOptions options;
  options.hold_length = kDetail;
  const Positions sharp = scene.coat(points, 1.0, options);
  options.transition.width = 0.3;
  const Positions soft = scene.coat(points, 1.0, options);
  const auto shares = fades(options.transition, scene.target.patch, scene.target.topology,
                            scene.target.mesh.positions);
  double near_border = 0.0;
  double near_border_sharp = 0.0;
  for (std::size_t own = 0; own < shares.size(); ++own) {
    const Index v = scene.target.patch.vertices[own];
    if (shares[own] > 0.2) continue;
    near_border += (soft[v] - scene.target.mesh.positions[v]).norm();
    near_border_sharp += (sharp[v] - scene.target.mesh.positions[v]).norm();
  }
  EXPECT_LT(near_border, 0.35 * near_border_sharp);
}

TEST(Coat, TakesTheTargetsOwnDetailAwayWhereAsked) {
  // The potato as its own target: what is left without any coating is its smooth version.
  Scene scene;
  CoaterOptions options;
  options.hold_length = kDetail;
  const Positions& rest = scene.source.mesh.positions;
  const Positions smooth_target =
      smooth_around(scene.source.patch.vertices, kDetail, rest, scene.source.topology,
                    LaplacianWeights::cotangent, "smooth_target");
  Coater coater({rest, smooth_target}, scene.source.topology, scene.source.patch, options,
                scene.kernels);
  coater.take(scene.coating, each_to_itself(scene.source.patch), {});
  const Positions smooth = coater.coat(0.0);
  double inside = 0.0;
  double before = 0.0;
  for (std::size_t own = 0; own < scene.source.patch.vertices.size(); ++own) {
    const Index v = scene.source.patch.vertices[own];
    if ((scene.source.mesh.positions[v] - Vector3d(0.2, 0.3, 1.0)).norm() > 0.4) continue;
    inside += (smooth[v] - scene.coating.smooth[own]).norm();
    before += scene.coating.displacement[own].norm();
  }
  EXPECT_LT(inside, 0.2 * before);
  // TransferMode off and put on again it is what it was.
  EXPECT_LT(largest_distance(coater.coat(1.0), scene.source.mesh.positions), 1e-9);
}

TEST(Coat, FollowsSourceAndTargetMovedAsAWhole) {
  Scene scene;
  CoaterOptions options;
  options.hold_length = kDetail;
  options.transition.width = 0.2;
  const PatchedMesh target(icosphere(4), within(icosphere(4), Vector3d(-1, 0, 0), 1.0));
  const auto coated = [&](const Coating& coating, const PatchedMesh& source, const PatchedMesh& on,
                          double size) {
    CoaterOptions scaled = options;
    scaled.hold_length *= size;
    scaled.transition.width *= size;
    const auto map = correspond(source.placed(), on.placed(), {}, "coat");
    Coater coater({on.mesh.positions}, on.topology, on.patch, scaled, scene.kernels);
    coater.take(coating, map.points, {});
    return coater.coat(1.0);
  };
  const Positions plain = coated(scene.coating, scene.source, target, 1.0);
  ASSERT_GT(largest_distance(plain, target.mesh.positions), 0.02);

  constexpr double kScale = 7.0;
  const PatchedMesh moved_source(transformed(scene.source.mesh, similarity(kScale)),
                                 scene.source.patch.vertices);
  const Coating moved_coating = peel_cotangent(moved_source, kScale * kDetail);
  EXPECT_LT(largest_distance(coated(moved_coating, moved_source, target, 1.0), plain), 1e-6);

  const Eigen::Affine3d motion = similarity(kScale);
  const PatchedMesh moved_target(transformed(target.mesh, motion), target.patch.vertices);
  Positions moved = coated(scene.coating, scene.source, moved_target, kScale);
  for (Vector3d& p : moved) p = motion.inverse() * p;
  EXPECT_LT(largest_distance(moved, plain), 1e-6);
}

TEST(Coat, SurvivesATargetRingThatIsAPoint) {
  Scene scene;
  Mesh collapsed = scene.target.mesh;
  const Index middle = within(collapsed, Vector3d(0.2, 0.3, 0.95), 0.2).front();
  for (const Index v : scene.target.topology.rings[middle]) {
    collapsed.positions[v] = collapsed.positions[middle];
  }
  for (const auto sampling : {MappedSampling::one_ring, MappedSampling::linear}) {
    for (const std::optional<double> scale : {std::optional<double>(), std::optional(2.0)}) {
      Coater coater({collapsed.positions}, scene.target.topology, scene.target.patch, {},
                    scene.kernels);
      coater.take(scene.coating, each_to_itself(scene.source.patch), {sampling, scale});
      for (const Vector3d& p : coater.coat(1.0)) ASSERT_TRUE(p.allFinite());
    }
  }
}

TEST(Coat, NeedsInnerVertices) {
  Scene scene;
  const PatchedMesh triangle(grid(1, 1));
  EXPECT_THAT(error_message<InputError>([&] {
                Coater({triangle.mesh.positions}, triangle.topology, triangle.patch, {},
                       scene.kernels);
              }),
              testing::HasSubstr("no inner vertices"));
}

TEST(PatchFades, WithoutAWidthAreAllThereEverywhere) {
  const PatchedMesh square(grid(6, 6));
  const auto shares = fades({}, square.patch, square.topology, square.mesh.positions);
  EXPECT_EQ(shares, std::vector<double>(49, 1.0));
}

TEST(PatchFades, AreMeasuredFromThePatchsBorder) {
  const PatchedMesh square(grid(20, 20));
  const Transition transition{0.25, Transition::Profile::linear};
  const auto shares = fades(transition, square.patch, square.topology, square.mesh.positions);
  for (std::size_t own = 0; own < shares.size(); ++own) {
    const Eigen::Vector3d& p = square.mesh.positions[square.patch.vertices[own]];
    const double depth = std::min({p.x(), 1.0 - p.x(), p.y(), 1.0 - p.y()});
    EXPECT_NEAR(shares[own], std::min(1.0, depth / 0.25), 0.03);
  }
}

}  // namespace
}  // namespace lapwing::test
