// Coats and mixes as functions of meshes and a request.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/coat.h"
#include "support/error_message.h"
#include "support/largest_distance.h"

namespace lapwing::test {
namespace {

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

}  // namespace
}  // namespace lapwing::test
