// The mesh as it was opened, shown in the place of what steps have made of it.
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "viewer_editing/an_editor.h"

namespace lapwing::viewer::test {
namespace {

// A step has made other triangles than the mesh was opened with.
class Before : public AnEditor {
 protected:
  void SetUp() override {
    AnEditor::SetUp();
    if (IsSkipped()) return;
    editor_.emplace(
        EditStart{History(chosen_tube()), opened_, {}, {}, folder_.path()}, context_,
        [](const Message&) {}, [] {});
    wait_until_ready();
  }

  const std::shared_ptr<const Mesh> opened_ = std::make_shared<const Mesh>(icosphere(1));
};

TEST_F(Before, ShowsTheMeshThatWasOpened) {
  editor_->show_before(true);
  editor_->update();
  EXPECT_EQ(on_screen().size(), opened_->vertex_count());
  editor_->show_before(false);
  editor_->update();
  EXPECT_EQ(on_screen().size(), rest().size());
}

TEST_F(Before, ADragThatBeginsThereShowsTheSurfaceThatItMoves) {
  editor_->show_before(true);
  editor_->update();
  begin_drag(kRight);
  editor_->update();
  ASSERT_EQ(on_screen().size(), rest().size());
  EXPECT_GT(head_moved(), 0.0);
}

}  // namespace
}  // namespace lapwing::viewer::test
