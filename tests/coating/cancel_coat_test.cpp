#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/coating/coat.h"
#include "lapwing/coating/peel.h"
#include "support/cancel_everywhere.h"

// Coats, mixes and peelings that are cancelled.
namespace lapwing::test {
namespace {

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
