// The Mesh tab: holes are listed and filled, and the mesh is remeshed, decimated and subdivided.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

// A ball with two holes, opened in the viewer on the Mesh tab.
class MeshSteps : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    open({1280, 1400});
  }
  void open(VkExtent2D size) {
    viewer_.reset();
    Look look;
    look.size = size;
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>(), look);
    Mesh ball = icosphere(3);
    KeepMask keep(ball.vertex_count());
    for (std::size_t v = 0; v < keep.size(); ++v) {
      keep[v] = ball.positions[v].z() < 0.8 && ball.positions[v].x() < 0.97;
    }
    keep_vertices(ball, keep);
    write_mesh(ball, viewer_->folder() / "ball.obj");
    viewer_->open(viewer_->folder() / "ball.obj");
    viewer_->click("Mesh");
  }

  const Mesh& mesh() { return *viewer_->app().document()->editor.state().rest; }
  std::size_t steps() { return viewer_->app().document()->editor.state().steps.size(); }
  void wait_for_preview() {
    viewer_->wait_for([&] { return viewer_->says("Preview: "); }, "the preview");
  }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(MeshSteps, AllHolesAreFilledAfterAPreviewAndUndone) {
  const std::size_t open = mesh().face_count();
  viewer_->click("Holes");
  EXPECT_TRUE(viewer_->says("rim vertices"));
  const float below = find_text(viewer_->texts(), "Show")->middle().y;
  EXPECT_LT(find_text(viewer_->texts(), "Fill all")->middle().y, below) << "above a long list";
  lapwing::test::keep_picture(viewer_->picture(), "mesh-holes");
  viewer_->click("Fill all");
  wait_for_preview();
  EXPECT_EQ(mesh().face_count(), open);
  lapwing::test::keep_picture(viewer_->picture(), "mesh-holes-filled");
  viewer_->click("Apply");
  viewer_->wait_for([&] { return viewer_->says("The surface is closed."); }, "no hole");
  EXPECT_EQ(viewer_->app().document()->mesh_steps.report()->statistics.boundary_loops, 0U);
  EXPECT_GT(mesh().face_count(), open);
  EXPECT_EQ(steps(), 1U);
  EXPECT_TRUE(viewer_->says("Fill holes"));
  viewer_->key('Z', kControl);
  viewer_->wait_for([&] { return mesh().face_count() == open; }, "the undo");
  EXPECT_EQ(steps(), 0U);
}

TEST_F(MeshSteps, BoundariesAndHolesAreBothCountedIfTheyDiffer) {
  // Two missing triangles that share a corner: one loop, which is split into two holes.
  Mesh sheet;
  sheet.positions = grid(6, 6).positions;
  std::size_t at = 0;
  const Mesh whole = grid(6, 6);
  for (Index f = 0; f < whole.face_count(); ++f) {
    const auto corners = whole.face(f);
    const bool at_middle = std::ranges::find(corners, Index{24}) != corners.end();
    if (at_middle && (at++ == 0 || at == 4)) continue;
    sheet.add_face(corners);
  }
  write_mesh(sheet, viewer_->folder() / "sheet.obj");
  viewer_->open(viewer_->folder() / "sheet.obj");
  viewer_->click("Mesh");
  EXPECT_TRUE(viewer_->says("(holes: "));
}

TEST_F(MeshSteps, APreviewIsAppliedWithoutScrollingInALowWindow) {
  open({1280, 800});
  viewer_->click("Holes");
  viewer_->click("Fill all");
  wait_for_preview();
  EXPECT_TRUE(viewer_->shows("Apply"));
  EXPECT_TRUE(viewer_->shows("Cancel"));
}

TEST_F(MeshSteps, OneHoleIsFilled) {
  viewer_->click("Holes");
  viewer_->click("Fill");
  wait_for_preview();
  viewer_->click("Apply");
  viewer_->wait_for([&] { return steps() == 1U; }, "the step");
  EXPECT_EQ(find_holes(mesh()).size(), 1U);
}

TEST_F(MeshSteps, ACancelledPreviewChangesNothing) {
  viewer_->click("Subdivision");
  viewer_->click("Subdivide");
  wait_for_preview();
  EXPECT_TRUE(viewer_->app().document()->editor.view().shown().previews());
  viewer_->click("Cancel");
  viewer_->look_at();
  EXPECT_FALSE(viewer_->app().document()->editor.view().shown().previews());
  EXPECT_EQ(steps(), 0U);
}

TEST_F(MeshSteps, EscapeDiscardsThePreview) {
  viewer_->click("Subdivision");
  viewer_->click("Subdivide");
  wait_for_preview();
  viewer_->key(kEscape);
  viewer_->look_at();
  EXPECT_FALSE(viewer_->app().document()->mesh_steps.is_open());
  EXPECT_FALSE(viewer_->app().document()->editor.view().shown().previews());
}

TEST_F(MeshSteps, ShowFramesTheRimOfAHole) {
  viewer_->click("Holes");
  viewer_->click("Show");
  viewer_->look_at();
  const Document& document = *viewer_->app().document();
  std::vector<std::vector<Index>> rims;
  for (const Hole& hole : document.mesh_steps.report()->holes) rims.push_back(hole.rim);
  EXPECT_THAT(rims, ::testing::Contains(document.editor.view().pointed_at()));
}

TEST_F(MeshSteps, TheMeshIsDecimatedSubdividedAndRemeshed) {
  const std::size_t vertices = mesh().vertex_count();
  viewer_->click("Decimation");
  viewer_->click("Decimate");
  wait_for_preview();
  lapwing::test::keep_picture(viewer_->picture(), "mesh-decimated");
  viewer_->click("Apply");
  viewer_->wait_for([&] { return steps() == 1U; }, "the decimation");
  EXPECT_LT(mesh().vertex_count(), vertices);
  viewer_->click("Decimation");
  viewer_->click("Subdivision");
  viewer_->click("Subdivide");
  wait_for_preview();
  viewer_->click("Apply");
  viewer_->wait_for([&] { return steps() == 2U; }, "the subdivision");
  EXPECT_GT(mesh().vertex_count(), vertices);
  viewer_->click("Subdivision");
  viewer_->click("Remeshing");
  viewer_->click("Remesh");
  wait_for_preview();
  lapwing::test::keep_picture(viewer_->picture(), "mesh-remeshed");
  viewer_->click("Apply");
  viewer_->wait_for([&] { return steps() == 3U; }, "the remeshing");
}

}  // namespace
}  // namespace lapwing::viewer::test
