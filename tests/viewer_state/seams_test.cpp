// A mesh whose vertices are split along seams, edited by hand as the surface that it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "state/history.h"
#include "support/split_meshes.h"
#include "tools/selection_edits.h"
#include "viewer_state/tube_edit.h"
#include "work/preparation.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::Each;
using ::testing::Lt;

class SeamState : public ::testing::Test {
 protected:
  AppState chosen() const {
    AppState state = open_state(split_.mesh);
    state = apply(std::move(state), Choose{kRoi, box(0.3, 4.0)});
    return apply(std::move(state), Choose{kHandle, box(2.8, 4.0)});
  }
  AppState settled() const {
    CpuKernels kernels;
    const AppState state = apply(chosen(), MoveHandle{0, bent()});
    return apply(state, Settle{solve_open_step(state, kernels)});
  }
  bool is_closed(const Positions& positions) const {
    for (Index v = 0; v < positions.size(); ++v) {
      if (positions[v] != positions[split_.sources[v]]) return false;
    }
    return true;
  }

  const lapwing::test::SplitMesh split_ = lapwing::test::halves(bumpy_tube());
};

TEST_F(SeamState, IsChosenAndHeldAsTheMeshWithoutIt) {
  const AppState state = chosen();
  const AppState whole = chosen_tube();
  EXPECT_EQ(state.selection, whole.selection);
  EXPECT_EQ(edit_region(state).roi, edit_region(whole).roi);
  EXPECT_EQ(edit_region(state).belt, edit_region(whole).belt);
  EXPECT_EQ(handle_centroid(state, 0), handle_centroid(whole, 0));
  EXPECT_EQ(surface_of(state)->face_vertices(), whole.rest->face_vertices());
  EXPECT_EQ(state.rest->face_vertices(), split_.mesh.face_vertices());
}

TEST_F(SeamState, SettlesToWhatItsRecipeSays) {
  const AppState dragged = apply(chosen(), MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels, [] {});
  preparation.follow(dragged);
  preparation.settle(dragged);
  const SettledResult result = awaited([&] { return preparation.take_result(); });
  const AppState state = apply(dragged, Settle{result.moved});
  EXPECT_TRUE(is_closed(positions_of(state)));
  EXPECT_EQ(*state.settled, *settled().settled);
}

TEST_F(SeamState, StaysClosedThroughCommitUndoAndRedo) {
  History history(settled());
  const auto topology = surface_of(history.state())->shared_topology();
  history.perform(Choose{kRoi, {GeodesicDisk{Index{125}, 0.8}}});
  history.perform(Choose{kHandle, {GeodesicDisk{Index{125}, 0.2}}});
  const VertexSet chosen = history.state().selection.roi.vertices;
  EXPECT_THAT(chosen, Each(Lt(bumpy_tube().vertex_count())));
  EXPECT_GT(chosen.size(), 40U);
  EXPECT_EQ(surface_of(history.state())->positions, history.state().rest->positions);
  EXPECT_EQ(surface_of(history.state())->shared_topology(), topology);
  history.undo();
  history.undo();
  EXPECT_EQ(surface_of(history.state())->positions, split_.mesh.positions);
  history.redo();
  EXPECT_EQ(history.state().selection.roi.vertices, chosen);
  EXPECT_TRUE(is_closed(surface_of(history.state())->positions));
  EXPECT_EQ(surface_of(history.state())->shared_topology(), topology);
}

TEST_F(SeamState, IsInvertedAndGrownByItsLeaders) {
  AppState state = chosen();
  const AppState whole = chosen_tube();
  for (const auto& edit : {invert, grow, shrink}) {
    const AppState after = viewer::apply(state, *edit(state, kRoi));
    const AppState expected = viewer::apply(whole, *edit(whole, kRoi));
    EXPECT_EQ(after.selection.roi.vertices, expected.selection.roi.vertices);
  }
}

TEST_F(SeamState, IsABoundaryWhereItIsToBeLeft) {
  AppState state = chosen();
  const VertexSet joined = state.selection.roi.vertices;
  EditParameters parameters = state.parameters;
  parameters.seams = SeamPolicy::leave;
  state = apply(state, SetParameters{parameters});
  EXPECT_EQ(surface_of(state), state.rest);
  EXPECT_GT(state.selection.roi.vertices.size(), joined.size());
  EXPECT_EQ(edit_region(state).roi, state.selection.roi.vertices);
  parameters.seams = SeamPolicy::join;
  state = apply(state, SetParameters{parameters});
  EXPECT_EQ(state.selection.roi.vertices, joined);
}

TEST_F(SeamState, ThatIsNotThereLeavesTheMeshItself) {
  const AppState state = chosen_tube();
  EXPECT_EQ(state.joined, nullptr);
  EXPECT_EQ(surface_of(state), state.rest);
}

}  // namespace
}  // namespace lapwing::viewer::test
