// A person edits a scan from the first click to the saved file, by events alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/run/run_recipe.h"
#include "support/models.h"
#include "tools/disk_tool.h"
#include "tools/gizmo_tool.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"
#include "work/edit_session.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;

// Clicks and types; the view looks at the whole mesh along z.
class Person {
 public:
  explicit Person(EditSession& session)
      : session_(session), view_(view_of(session.state().rest->positions)) {}

  void choose_disk(const Part& part, const Vector3d& center, const Vector3d& rim) {
    const Positions positions = positions_of(session_.state());
    const Topology& topology = session_.state().rest->topology();
    const auto pick = [&](const Vector2d& pixel) {
      return pick_surface(topology, positions, view_.ray_through(pixel));
    };
    const ToolScene scene{session_.state(), positions, view_, pick, {}, part};
    DiskTool tool;
    tool.handle(press(*view_.to_pixel(center)), scene);
    tool.handle(move_to(*view_.to_pixel(rim)), scene);
    perform(tool.handle(release(*view_.to_pixel(rim)), scene));
  }

  void move_handle(std::initializer_list<InputEvent> events) {
    for (const InputEvent& event : events) {
      perform(gizmo_.handle(event, {session_.state(), {}, view_}));
    }
    wait_until([&] {
      EXPECT_EQ(session_.preparation().status().message, "");
      return session_.take_result() || ::testing::Test::HasFailure();
    });
  }

 private:
  static Projection view_of(const Positions& positions) {
    const Bounds bounds = bounds_of(positions);
    const double size = bounds.diagonal();
    return parallel(bounds.center() - Vector3d(0, 0, size), bounds.center(), size);
  }
  void perform(const ToolAnswer& answer) {
    EXPECT_EQ(answer.message, "");
    if (answer.command) session_.perform(*answer.command);
  }

  EditSession& session_;
  Projection view_;
  GizmoTool gizmo_;
};

TEST(ScriptedPerson, BendsTheArmOfTheArmadillo) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const auto armadillo = lapwing::test::models_folder() / "cgal" / "meshes" / "armadillo.off";
  const TemporaryFolder folder;
  EditSession session(History(open_state(read_mesh(armadillo))), stamp_of(armadillo),
                      folder / "cache", cpu_kernels);
  Person person(session);
  const AppState& state = session.state();
  const Bounds bounds = bounds_of(state.rest->positions);
  // The hand is what lies farthest to one side.
  const Vector3d hand =
      *std::max_element(state.rest->positions.begin(), state.rest->positions.end(),
                        [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); });
  const Vector3d inward(-1, 0, 0);
  const double size = bounds.diagonal();
  person.choose_disk(kRoi, hand + 0.01 * size * inward, hand + 0.15 * size * inward);
  person.choose_disk(kHandle, hand + 0.01 * size * inward, hand + 0.04 * size * inward);
  ASSERT_EQ(state.selection.handles.size(), 1U);
  const std::size_t roi = state.selection.roi.vertices.size();
  EXPECT_GT(roi, 300U);

  person.move_handle({key('R'), key('Z'), typed('6'), typed('0'), key(kEnter)});
  person.move_handle({key('G'), key('Y'), typed('0'), typed('.'), typed('1'), key(kEnter)});
  const Positions settled = positions_of(state);
  EXPECT_GT(largest_distance(settled, state.rest->positions), 0.02 * size);
  session.undo();
  session.undo();
  EXPECT_NE(positions_of(state), settled);
  session.redo();
  session.redo();
  EXPECT_EQ(positions_of(state), settled);
  EXPECT_TRUE(session.history().unsaved());

  session.save(folder / "saved.ply");
  EXPECT_FALSE(session.history().unsaved());
  EXPECT_LT(largest_distance(read_mesh(folder / "saved.ply").positions, settled), 1e-5 * size);
  session.save_recipe(folder / "recipe.json");
  CpuKernels kernels;
  const auto replayed = run_recipe(read_recipe(folder / "recipe.json"), kernels);
  EXPECT_LT(largest_distance(replayed->mesh.positions, settled), 1e-9 * size);
}

}  // namespace
}  // namespace lapwing::viewer::test
