// Every key that a person needs for an edit, a coat, a mix or a transplant stands on the screen
// when it is needed: in the guide, at the control that does the same, or in a menu.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::Environment;

class Guides : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    add_finger(folder_.path());
    write_mesh(rippled_cylinder(24, 41), folder_ / "tube.obj");
    viewer_ =
        std::make_unique<ShownViewer>(std::make_shared<gpu::Context>(), Look{}, folder_.path());
    viewer_->open(folder_ / "tube.obj");
  }

  // Where the mesh is, right of the panels and of a source.
  Eigen::Vector2d middle() const {
    const auto& [width, height] = viewer_->look().size;
    const bool has_source = viewer_->app().document()->desk.is_open();
    return {(has_source ? 0.82 : 0.65) * width, 0.55 * height};
  }
  void drag_disk(double radius) {
    viewer_->drag(middle(), middle() + Eigen::Vector2d(radius, 0.0));
  }
  void choose_roi() {
    viewer_->key('I');
    drag_disk(60.0);
    ASSERT_FALSE(roi().vertices.empty());
  }
  // Until it has settled.
  void move_handle() {
    viewer_->key('G');
    viewer_->type(U'1');
    viewer_->key(kEnter);
    const Editor& editor = viewer_->app().document()->editor;
    viewer_->wait_for([&] { return editor.state().settled && !editor.waits(); }, "it settles");
  }
  const ChosenRegion& roi() const {
    return viewer_->app().document()->editor.state().selection.roi;
  }

  // Without doing anything.
  void expect_says(const std::string& words) {
    viewer_->look_at();
    EXPECT_TRUE(viewer_->says(words)) << "nothing says " << words;
  }
  // While the mouse is over a control, whose name others may have, too.
  void expect_at(const std::string& control, const std::string& words) {
    bool said = false;
    const std::vector<ShownText> texts = viewer_->look_at();
    for (const ShownText& text : texts) {
      if (text.words != control || said) continue;
      move_to({text.middle().x, text.middle().y});
      said = viewer_->says(words);
    }
    EXPECT_TRUE(said) << control << " does not say " << words;
    move_to({1.0, 1.0});
  }
  void move_to(const Eigen::Vector2d& place) {
    viewer_->send({.kind = InputKind::move, .position = place});
    viewer_->look_at();
  }
  void expect_in_menu(const std::string& menu, const std::string& keys) {
    viewer_->click(menu);
    EXPECT_TRUE(viewer_->says(keys)) << menu << " does not say " << keys;
    viewer_->click(menu);
  }

  TemporaryFolder folder_;
  Environment data_{"XDG_DATA_HOME", (folder_ / "data").string()};
  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(Guides, NameTheKeysOfAnEdit) {
  expect_says("drag from the middle of the region to edit to its rim");
  expect_at("ROI", "key I");
  expect_at("Disk", "key D");
  choose_roi();
  expect_at("Handle", "key H");
  viewer_->key('H');
  drag_disk(20.0);
  expect_at("Move", "key M");
  viewer_->key('M');
  expect_says("G");
  move_handle();
  expect_says("Ctrl+N begins another edit");
  expect_at("Undo", "Ctrl+Z");
  expect_at("Redo", "Ctrl+Shift+Z");
  expect_at("Save recipe", "Ctrl+E");
  expect_at("shape", "Shift+M");
  for (const char* keys : {"Ctrl+O", "Ctrl+S", "Ctrl+Shift+S", "Ctrl+P", "Ctrl+Q"}) {
    expect_in_menu("File", keys);
  }
  for (const char* keys : {"Home", "Tab"}) expect_in_menu("View", keys);
}

TEST_F(Guides, NameTheKeysOfACoat) {
  viewer_->click("Coat");
  expect_at("Begin a coat", "Ctrl+K");
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("source: "); }, "the coat begins");
  expect_says("press I");
  choose_roi();
  expect_says("Ctrl+Shift+K takes another mesh");
  expect_at("Apply", "Ctrl+Enter");
  viewer_->click("the whole source");
  expect_says("K picks corresponding points");
}

// It stays what it was in each frame, so that what is chosen on it stays, too.
TEST_F(Guides, LeadFromADragToACoatOfWhatWasMoved) {
  choose_roi();
  viewer_->key('H');
  drag_disk(20.0);
  move_handle();
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("source: "); }, "the coat begins");
  viewer_->click("the whole source");
  expect_says("source patch: 984 vertices");
  const auto& preview = viewer_->app().document()->desk.preview();
  viewer_->wait_for([&] { return !preview.message().empty(); }, "the preview says what it misses");
  EXPECT_THAT(preview.message(), ::testing::HasSubstr("disk"));
  viewer_->look_at();
  EXPECT_FALSE(preview.is_behind()) << "it is not computed again and again";
}

TEST_F(Guides, NameTheKeysOfAMix) {
  viewer_->click("Mix");
  expect_at("Begin a mix", "Ctrl+M");
  viewer_->key('M', kControl);
  viewer_->wait_for([&] { return viewer_->says("source: "); }, "the mix begins");
  choose_roi();
  viewer_->click("the whole source");
  expect_says("Shift+K shows the other source");
  expect_at("Apply", "Ctrl+Enter");
}

TEST_F(Guides, NameTheKeysOfATransplant) {
  viewer_->click("Transplant");
  expect_at("finger", "key N");
  viewer_->key('N');
  viewer_->wait_for([&] { return viewer_->says("Shift + wheel turns"); }, "the part is in hand");
  expect_says("click");
  viewer_->drag(middle(), middle());
  expect_says("Enter");
  expect_at("Apply", "Enter");
  expect_at("Take up (G)", "G");
}

}  // namespace
}  // namespace lapwing::viewer::test
