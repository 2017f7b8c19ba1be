#pragma once

#include "lapwing/io/mesh_file.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_window/window_test.h"

namespace lapwing {

// The source takes the left half of the window once the panels are hidden.
inline constexpr double kSourceWidth = 640.0;
inline constexpr double kSourceHeight = 800.0;

/// A sheet, and a relief whose detail it gets.
class Layers : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    sheet_ = read_mesh(files_.sheet());
    relief_ = read_mesh(files_.relief());
    open(files_.sheet());
    person_->look_from(View::front, sheet_.positions);
  }

  // A disk around the middle becomes the ROI, which is the target patch.
  void choose_target() {
    person_->keys("d i");
    person_->drag_between({0.5, 0.5, 0.025}, {0.85, 0.5, 0.07});
    ASSERT_TRUE(has_disk_as_roi());
  }

  // Begins with these keys; the source is beside the mesh then.
  void begin(const std::string& keys) {
    const Image before = desktop_->settled_picture();
    person_->keys(keys);
    EXPECT_TRUE(differs_from(before, 1.0));
    desktop_->settled_picture();
  }

  void take_from_relief() {
    person_->open_dialog("ctrl+shift+k");
    person_->type(files_.relief().string());
    const Image before = desktop_->settled_picture();
    person_->keys("Return");
    EXPECT_TRUE(differs_from(before, 1.0));
    desktop_->settled_picture();
  }

  // Where a place of the source shows.
  static Eigen::Vector2d source_pixel(const Mesh& source, const Eigen::Vector3d& place) {
    const Camera camera =
        fit(source.positions, view_axes(View::three_quarter), kSourceWidth / kSourceHeight);
    const viewer::Projection projection{
        camera.projection(kSourceWidth / kSourceHeight) * camera.view(),
        {kSourceWidth, kSourceHeight}};
    return projection.to_pixel(place).value();
  }

  void choose_source(const Mesh& source) {
    const Eigen::Vector2d middle = source_pixel(source, {0.5, 0.5, 0.02});
    const Eigen::Vector2d rim = source_pixel(source, {0.85, 0.5, 0.05});
    person_->drag({middle, 0.5 * (middle + rim), rim});
    desktop_->settled_picture();
  }

  // A coat that takes from the relief, up to what applies it.
  void choose_coat() {
    begin("ctrl+k");
    take_from_relief();
    choose_source(relief_);
  }
  // A mix of the relief with the sheet itself, likewise.
  void choose_mix() {
    begin("ctrl+m");
    take_from_relief();
    choose_source(relief_);
    person_->keys("shift+k");
    desktop_->settled_picture();
    choose_source(sheet_);
  }

  viewer::test::SheetAndRelief files_;
  Mesh sheet_;
  Mesh relief_;
};

}  // namespace lapwing
