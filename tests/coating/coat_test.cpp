// Coats and mixes as functions of meshes and a request.
#include "lapwing/coating/coat.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/peel.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "support/cancel_everywhere.h"
#include "support/error_message.h"
#include "support/largest_distance.h"

namespace lapwing::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kHeight = 0.02;

class CoatInMemory : public ::testing::Test {
 protected:
  // All of one sheet on all of another.
  static CoatRequest request() {
    CoatRequest request;
    request.source.patch = {AllVertices{}};
    request.source.detail_size = 0.5;
    request.target_patch = {AllVertices{}};
    request.parameters.remesh = Remeshing::none;
    return request;
  }

  const Mesh source_ = relief(32, 4.0, kHeight);
  const Mesh target_ = grid(32, 32);
};

TEST_F(CoatInMemory, BringsTheSourcesReliefByItsAmplitude) {
  CoatRequest once = request();
  once.parameters.transition = Transition{0.1};
  const Coated coated = coat(target_, source_, once);
  const double height = largest_distance(coated.mesh.positions, target_.positions);
  EXPECT_NEAR(height, kHeight, 0.2 * kHeight);
  EXPECT_EQ(coated.report.largest_displacement, height);
  EXPECT_EQ(coated.report.sources.at(0).vertices, source_.vertex_count());
  EXPECT_THAT(coated.warnings, IsEmpty());
  once.source.amplitude = -2.0;
  const Positions engraved = coat(target_, source_, once).mesh.positions;
  for (Index v = 0; v < target_.vertex_count(); ++v) {
    const Eigen::Vector3d moved = coated.mesh.positions[v] - target_.positions[v];
    EXPECT_LT((engraved[v] - target_.positions[v] + 2.0 * moved).norm(), 1e-12);
  }
}

TEST_F(CoatInMemory, ASurfaceCoatedOntoItselfIsItself) {
  CoatRequest again = request();
  again.parameters.smooth_target = again.source.detail_size;
  again.parameters.transition = Transition{0.0};
  const Coated coated = coat(source_, source_, again);
  EXPECT_LT(largest_distance(coated.mesh.positions, source_.positions), 1e-9);
}

TEST_F(CoatInMemory, MakesACoarsePatchFiner) {
  CoatRequest finer = request();
  finer.parameters.remesh = Remeshing::automatic;
  const Mesh coarse = grid(6, 6);
  const Coated coated = coat(coarse, source_, finer);
  EXPECT_GT(coated.mesh.vertex_count(), 4 * coarse.vertex_count());
  EXPECT_EQ(coated.report.vertices_before_remeshing, coarse.vertex_count());
}

TEST_F(CoatInMemory, OfAMixWithNothingOfTheSecondIsTheCoatOfTheFirst) {
  const CoatRequest first = request();
  MixRequest both;
  both.sources = {first.source, first.source};
  both.target_patch = first.target_patch;
  both.parameters = first.parameters;
  both.weight.form = PaintedWeight{std::vector<double>(target_.vertex_count(), 0.0)};
  const Mesh other = relief(20, 2.0, kHeight);
  EXPECT_LT(largest_distance(mix(target_, source_, other, both).mesh.positions,
                             coat(target_, source_, first).mesh.positions),
            1e-12);
}

TEST_F(CoatInMemory, NamesTheRegionThatDoesNotFit) {
  CoatRequest wrong = request();
  wrong.source.patch = {ListedVertices{{0, 1}}, "the source's patch"};
  EXPECT_THAT(error_message<InputError>([&] { coat(target_, source_, wrong); }),
              HasSubstr("the source's patch"));
}

// Returns a sphere, inside out if `is_inside_out`. It has a hole of radius `hole` around vertex 0.
Mesh sphere(bool is_inside_out, double hole = 0.0) {
  Mesh mesh = icosphere(3);
  Mesh open;
  open.positions = mesh.positions;
  const Eigen::Vector3d center = mesh.positions[0];
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto is_outside = [&](Index v) { return (mesh.positions[v] - center).norm() >= hole; };
    if (std::ranges::all_of(mesh.face(f), is_outside)) open.add_face(mesh.face(f));
  }
  if (is_inside_out) turn_inside_out(open);
  return open;
}

std::vector<std::string> warnings_of(const Mesh& target, const Mesh& source) {
  CoatRequest request;
  request.source.patch = {GeodesicDisk{1U, 0.5}, "source"};
  request.source.detail_size = 0.3;
  request.target_patch = {GeodesicDisk{1U, 0.5}, "target"};
  request.parameters.remesh = Remeshing::none;
  request.parameters.transition = Transition{0.1};
  return coat(target, source, request).warnings;
}

TEST(CoatOfInwardSurface, SaysThatTheDetailGoesInward) {
  const std::string turn = "; turn it with `lapwing check MESH --fix OUT`, or negate \"amplitude\"";
  EXPECT_THAT(warnings_of(sphere(true), sphere(false)),
              ElementsAre("target: the surface is inside out, so bumps on it go inward" + turn));
  EXPECT_THAT(warnings_of(sphere(false), sphere(true)),
              ElementsAre("source: the surface is inside out, so its bumps become dents" + turn));
  EXPECT_THAT(warnings_of(sphere(true, 0.2), sphere(false)),
              ElementsAre("target: the surface has inward normals, so bumps on it go inward; "
                          "reverse its faces, or negate \"amplitude\""));
}

TEST(CoatOfInwardSurface, SaysNothingIfBothSidesAgree) {
  EXPECT_THAT(warnings_of(sphere(false), sphere(false)), IsEmpty());
  EXPECT_THAT(warnings_of(sphere(true), sphere(true)), IsEmpty());
}

TEST(MixOnInwardSurface, SaysOnceThatTheDetailGoesInward) {
  MixRequest request;
  request.sources[0].patch = request.target_patch = {GeodesicDisk{1U, 0.5}, "target"};
  request.sources[0].detail_size = 0.3;
  request.sources[1] = request.sources[0];
  request.parameters.remesh = Remeshing::none;
  request.parameters.transition = Transition{0.1};
  request.parameters.domain = Domain::square;
  request.weight.form = DomainRamp{0.3, 0.7};
  EXPECT_THAT(mix(sphere(true), sphere(false), sphere(false), request).warnings,
              ElementsAre(HasSubstr("target: the surface is inside out")));
}

class CancelCoat : public ::testing::Test {
 protected:
  CoatSource source() const {
    CoatSource source;
    source.patch = {AllVertices{}};
    source.detail_size = 0.5;
    return source;
  }

  // So coarse that its patch is remeshed.
  const Mesh target_ = grid(8, 8);
  const Mesh fine_ = relief(24, 4.0, 0.02);
  const Mesh other_ = relief(16, 2.0, 0.02);
};

TEST_F(CancelCoat, AtEveryPointLeavesTheMeshesAsTheyWere) {
  CoatRequest request;
  request.source = source();
  request.target_patch = {AllVertices{}};
  const Coated whole = coat(target_, fine_, request);
  EXPECT_GT(whole.mesh.vertex_count(), target_.vertex_count()) << "it was remeshed";
  Coated done;
  EXPECT_GT(cancel_everywhere([&](const Progress& progress) {
              const ProgressScope scope(progress);
              done = coat(target_, fine_, request);
            }),
            50U);
  EXPECT_EQ(target_.positions, grid(8, 8).positions);
  EXPECT_EQ(done.mesh.positions, whole.mesh.positions);
}

TEST_F(CancelCoat, OfAMixtureEndsItAtEveryPoint) {
  MixRequest request;
  request.sources = {source(), source()};
  request.target_patch = {AllVertices{}};
  request.parameters.domain = Domain::square;
  request.weight.form = DomainRamp{0.3, 0.7};
  const Positions whole = mix(target_, fine_, other_, request).mesh.positions;
  Positions done;
  cancel_everywhere([&](const Progress& progress) {
    const ProgressScope scope(progress);
    done = mix(target_, fine_, other_, request).mesh.positions;
  });
  EXPECT_EQ(done, whole);
}

TEST_F(CancelCoat, AKeptCoatWhoseDetailSizeWasBeingChangedCanBeChangedAgain) {
  CoatRequest request;
  request.source = source();
  request.target_patch = {AllVertices{}};
  CpuKernels kernels;
  const auto source_mesh = std::make_shared<const Mesh>(fine_);
  PreparedCoat fresh(request, target_, source_mesh, kernels);
  fresh.set_detail_size(0.3);
  PreparedCoat coat(request, target_, source_mesh, kernels);
  cancel_everywhere([&](const Progress& progress) { coat.set_detail_size(0.3, progress); });
  EXPECT_EQ(coat.positions(1.0), fresh.positions(1.0));
}

TEST_F(CancelCoat, OfAPeelingEndsItAtEveryPoint) {
  PeelRequest request;
  request.detail_size = 0.4;
  const Positions whole = peel(fine_, request).mesh.positions;
  Positions done;
  EXPECT_GT(cancel_everywhere([&](const Progress& progress) {
              done = peel(fine_, request, progress).mesh.positions;
            }),
            10U);
  EXPECT_EQ(done, whole);
}

}  // namespace
}  // namespace lapwing::test
