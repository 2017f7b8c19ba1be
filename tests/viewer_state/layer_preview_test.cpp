// A coat or mix in the making: what is missing, what changes at once, and that what is shown is
// what comes of it.
#include "work/layer_preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "state/whole_step.h"
#include "support/error_message.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;
using ::testing::HasSubstr;

LayerDraft coat_draft(const SheetAndRelief& files, Remeshing remesh = Remeshing::none) {
  return *layer_draft_of(files.coat(1.0, remesh));
}

LayerDraft mix_draft(const SheetAndRelief& files) {
  LayerDraft draft = coat_draft(files);
  draft.operation = LayerDraft::Operation::mix;
  draft.sources[1] = draft.sources[0];
  draft.sources[1].amplitude = -1.0;
  draft.parameters.domain = Domain::square;
  return draft;
}

TEST(LayerDraft, IsTheStepThatItWasTakenFrom) {
  const SheetAndRelief files;
  const Step coat = files.coat(0.5);
  EXPECT_EQ(step_of(*layer_draft_of(coat)), coat);
  const Step mix = step_of(mix_draft(files));
  EXPECT_TRUE(std::holds_alternative<MixStep>(mix));
  EXPECT_EQ(step_of(*layer_draft_of(mix)), mix);
  EXPECT_FALSE(layer_draft_of(SheetAndRelief::lift()));
}

TEST(LayerDraft, SaysWhatIsMissing) {
  const SheetAndRelief files;
  LayerDraft draft;
  const auto missing = [&] { return error_message<InputError>([&] { step_of(draft); }); };
  EXPECT_THAT(missing(), HasSubstr("patch of the source"));
  draft.sources[0] = coat_draft(files).sources[0];
  EXPECT_THAT(missing(), HasSubstr("region that gets the detail"));
  draft.target_patch = coat_draft(files).target_patch;
  EXPECT_EQ(missing(), "");
  draft.sources[0].detail_size = 0.0;
  EXPECT_THAT(missing(), HasSubstr("detail size"));
  draft.operation = LayerDraft::Operation::mix;
  draft.sources[0].detail_size = 0.5;
  EXPECT_THAT(missing(), HasSubstr("the second source"));
}

TEST(LayerDraft, KnowsWhatIsASlider) {
  const SheetAndRelief files;
  const LayerDraft coat = coat_draft(files);
  LayerDraft other = coat;
  other.sources[0].amplitude = 2.0;
  other.sources[0].detail_size = 0.25;
  EXPECT_TRUE(same_but_for_sliders(coat, other));
  other.parameters.smooth_target = 0.1;
  EXPECT_FALSE(same_but_for_sliders(coat, other));
  LayerDraft mix = mix_draft(files);
  const LayerDraft before = mix;
  mix.sources[1].amplitude = 0.5;
  EXPECT_FALSE(same_but_for_sliders(before, mix)) << "amplitudes of two are in one solve";
}

TEST(LayerDraft, PairsOnTheBorderAreThere) {
  const Mesh sheet = grid(8, 8);
  const Topology& topology = sheet.topology();
  const VertexSet patch = resolve({GeodesicDisk{Index{40}, 0.3}}, sheet);
  const VertexSet border = border_of(disk_patch(patch, topology, sheet.positions, "patch"));
  const Index nearest = nearest_on_border(40, patch, sheet);
  EXPECT_TRUE(std::binary_search(border.begin(), border.end(), nearest));
  EXPECT_EQ(nearest_on_border(border.front(), patch, sheet), border.front());
}

class APreview : public ::testing::Test {
 protected:
  APreview() : preview_(cpu_kernels), target_(open_state(read_mesh(files_.sheet()))) {}

  // Until what is wanted is shown, or cannot be.
  void show(const LayerDraft& draft) {
    preview_.follow(target_.rest, draft);
    preview_.update();
    wait_until([&] {
      preview_.update();
      return !preview_.is_behind();
    });
  }
  Mesh applied(const LayerDraft& draft) {
    CpuKernels kernels;
    const Step step = step_of(draft);
    return mesh_of(apply(target_, Apply{step, apply_step(target_, step, {}, kernels).result}));
  }

  SheetAndRelief files_;
  LayerPreview preview_;
  AppState target_;
};

TEST_F(APreview, ShowsWhatTheStepComesTo) {
  for (const Remeshing remesh : {Remeshing::none, Remeshing::automatic}) {
    const LayerDraft draft = coat_draft(files_, remesh);
    show(draft);
    ASSERT_TRUE(preview_.has_result()) << preview_.message();
    const Mesh expected = applied(draft);
    EXPECT_EQ(preview_.positions(), expected.positions);
    EXPECT_EQ(preview_.mesh()->face_vertices(), expected.face_vertices());
    EXPECT_EQ(preview_.mesh()->shares_faces_with(*target_.rest), remesh == Remeshing::none);
  }
}

TEST_F(APreview, OfAMixShowsWhatTheStepComesTo) {
  const LayerDraft draft = mix_draft(files_);
  show(draft);
  ASSERT_TRUE(preview_.has_result()) << preview_.message();
  EXPECT_EQ(preview_.positions(), applied(draft).positions);
  EXPECT_GT(largest_distance(preview_.positions(), target_.rest->positions), 1e-4);
}

TEST_F(APreview, FollowsTheAmplitudeAtOnce) {
  LayerDraft draft = coat_draft(files_);
  show(draft);
  draft.sources[0].amplitude = 0.25;
  preview_.follow(target_.rest, draft);
  EXPECT_TRUE(preview_.update()) << "without the worker";
  EXPECT_EQ(preview_.positions(), applied(draft).positions);
  draft.sources[0].amplitude = 0.0;
  preview_.follow(target_.rest, draft);
  EXPECT_TRUE(preview_.update());
  EXPECT_EQ(preview_.positions(), target_.rest->positions);
}

TEST_F(APreview, FollowsTheDetailSizeAtOnceAndThenExactly) {
  LayerDraft draft = coat_draft(files_, Remeshing::automatic);
  show(draft);
  const auto mesh = preview_.mesh();
  const Positions before = preview_.positions();
  draft.sources[0].detail_size = 0.25;
  preview_.follow(target_.rest, draft);
  wait_until([&] { return preview_.update(); });
  EXPECT_EQ(preview_.mesh(), mesh) << "what was prepared";
  EXPECT_GT(largest_distance(preview_.positions(), before), 1e-5);
  show(draft);
  EXPECT_EQ(preview_.positions(), applied(draft).positions);
}

TEST_F(APreview, WhatIsAskedForMeanwhileIsWhatComes) {
  LayerDraft draft = coat_draft(files_);
  preview_.follow(target_.rest, draft);
  preview_.update();
  for (const double amplitude : {0.5, 0.75}) {
    draft.sources[0].amplitude = amplitude;
    preview_.follow(target_.rest, draft);
    preview_.update();
  }
  draft.target_patch = {GeodesicDisk{Eigen::Vector3d(0.4, 0.5, 0.016), 0.25}};
  show(draft);
  EXPECT_EQ(preview_.positions(), applied(draft).positions);
}

TEST_F(APreview, ThatCannotBeSaysWhyAndGoesOnWithTheNext) {
  LayerDraft draft = coat_draft(files_);
  draft.sources[0].mesh = "nowhere.ply";
  show(draft);
  EXPECT_FALSE(preview_.has_result());
  EXPECT_THAT(preview_.message(), HasSubstr("nowhere.ply"));
  show(coat_draft(files_));
  EXPECT_TRUE(preview_.has_result());
  EXPECT_EQ(preview_.message(), "");
}

TEST_F(APreview, StoppedHasNothing) {
  show(coat_draft(files_));
  preview_.stop();
  EXPECT_FALSE(preview_.has_result());
  EXPECT_FALSE(preview_.is_behind());
  EXPECT_FALSE(preview_.update());
}

}  // namespace
}  // namespace lapwing::viewer::test
