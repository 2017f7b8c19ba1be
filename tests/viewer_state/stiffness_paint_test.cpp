#include "tools/stiffness_paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "state/draft.h"
#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class PaintingStiffness : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  void stroke(Modifiers modifiers = {}) {
    send(press(left_, modifiers));
    send(move_to(right_, modifiers));
    sphere_.perform(send(release(right_, modifiers)));
  }
  double factor_at(const Vector3d& place) const {
    const auto found =
        resolve_stiffness(stiffness(), {sphere_.vertex_near(place)}, *sphere_.state.rest);
    return found.empty() ? 1.0 : found[0].factor;
  }
  const std::vector<StiffnessSpec>& stiffness() const { return sphere_.state.selection.stiffness; }

  SphereScene sphere_;
  StiffnessPaint tool_;
  Vector2d left_ = sphere_.pixel_of(Vector3d(-0.3, 0, 0.95));
  Vector2d right_ = sphere_.pixel_of(Vector3d(0.3, 0, 0.95));
  const Vector3d middle_{0.0, 0.0, 1.0};
  const Vector3d beside_{0.0, 0.7, 0.71};
};

TEST_F(PaintingStiffness, AStrokeSetsTheFactorOfWhatItTouches) {
  stroke();
  EXPECT_EQ(factor_at(middle_), kRigidStiffness);
  EXPECT_EQ(factor_at(beside_), 1.0);
  tool_.is_rigid = false;
  tool_.factor = 0.5;
  stroke();
  EXPECT_EQ(factor_at(middle_), 0.5);
  EXPECT_THAT(stiffness(), SizeIs(1));
}

TEST_F(PaintingStiffness, ControlErases) {
  stroke();
  stroke({.control = true});
  EXPECT_THAT(stiffness(), IsEmpty());
}

TEST_F(PaintingStiffness, EachFactorIsOneList) {
  const auto painted = [](std::vector<StiffnessSpec> before, const VertexSet& set, double factor) {
    return painted_stiffness(std::move(before), set, factor);
  };
  auto parts = painted({}, {1, 2}, 3.0);
  parts = painted(parts, {5, 6}, kRigidStiffness);
  parts = painted(parts, {2, 4}, 3.0);
  ASSERT_THAT(parts, SizeIs(2));
  EXPECT_EQ(std::get<ListedVertices>(parts[0].region.form).vertices, (VertexSet{1, 2, 4}));
  EXPECT_EQ(painted(parts, {1, 2, 4}, 1.0), (std::vector<StiffnessSpec>{parts[1]}));
  // Erasing overrides a region of a recipe.
  const auto erased = painted({{{AllVertices{}}, 2.0}}, {7}, 1.0);
  EXPECT_EQ(resolve_stiffness(erased, {6, 7}, *sphere_.state.rest),
            (std::vector<VertexStiffness>{{6, 2.0}}));
}

TEST_F(PaintingStiffness, AStrokeUnderWayIsShownAndNotYetDone) {
  send(press(left_));
  send(move_to(right_));
  EXPECT_TRUE(tool_.is_dragging());
  EXPECT_THAT(stiffness(), IsEmpty());
  EXPECT_THAT(tool_.live_stiffness(sphere_.state), SizeIs(1));
}

TEST_F(PaintingStiffness, IsKeptByTheRecipeTheDraftAndTheNextEdit) {
  stroke();
  const std::vector<StiffnessSpec> painted = stiffness();
  EXPECT_EQ(open_step(sphere_.state).stiffness, painted);
  const Draft draft = draft_of(sphere_.state);
  const History restored = from_draft(open_state(sphere_.state.rest), draft, {});
  EXPECT_EQ(restored.state().selection.stiffness, painted);
  sphere_.state = apply(sphere_.state, NewEdit{});
  EXPECT_EQ(stiffness(), painted);
}

TEST_F(PaintingStiffness, CanBeUndone) {
  History history(sphere_.state);
  history.perform(SetStiffness{{{{ListedVertices{{1, 2}}}, 5.0}}});
  EXPECT_EQ(history.state().selection.stiffness.size(), 1U);
  history.undo();
  EXPECT_THAT(history.state().selection.stiffness, IsEmpty());
  EXPECT_THROW(history.perform(SetStiffness{{{{ListedVertices{{1}}}, 0.0}}}), InputError);
}

}  // namespace
}  // namespace lapwing::viewer::test
