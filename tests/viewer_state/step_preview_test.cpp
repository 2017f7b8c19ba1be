#include "work/step_preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "state/command.h"
#include "state/history.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;

// Waits for the preview of `step` on a closed ball.
std::shared_ptr<const Mesh> previewed(StepPreview& preview, const AppState& state,
                                      const Step& step) {
  preview.start(state, step);
  wait_until([&] { return preview.update(); });
  return preview.mesh();
}

TEST(StepPreview, HasTheMeshThatApplyAdds) {
  StepPreview preview(cpu_kernels);
  History history(open_state(icosphere(3)));
  const SubdivideRequest step;
  const auto mesh = previewed(preview, history.state(), step);
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(mesh->face_count(), 4U * icosphere(3).face_count());
  history.perform(Apply{step, preview.result()->result});
  EXPECT_EQ(history.state().rest->positions, mesh->positions);
  EXPECT_EQ(history.state().steps.size(), 1U);
  history.undo();
  EXPECT_EQ(history.state().rest->positions, icosphere(3).positions);
  EXPECT_TRUE(history.state().steps.empty());
}

TEST(StepPreview, HasNoMeshIfTheStepChangesNothing) {
  StepPreview preview(cpu_kernels);
  EXPECT_EQ(previewed(preview, open_state(icosphere(2)), FillRequest{}), nullptr);
  EXPECT_NE(preview.result(), nullptr);
}

TEST(StepPreview, TellsWhyTheStepFailed) {
  StepPreview preview(cpu_kernels);
  EXPECT_EQ(previewed(preview, open_state(icosphere(2)), SubdivideRequest{.times = 40}), nullptr);
  EXPECT_THAT(preview.message(), HasSubstr("triangles"));
  preview.stop();
  EXPECT_TRUE(preview.message().empty());
}

TEST(WholeStep, FillHolesHasANameInTheHistory) {
  EXPECT_EQ(describe(Step(FillRequest{})), "Fill holes");
}

}  // namespace
}  // namespace lapwing::viewer::test
