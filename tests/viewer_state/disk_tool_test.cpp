#include "tools/disk_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viewer_state/sphere_scene.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

const Vector3d kFront(0, 0, 1);

class ADisk : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  GeodesicDisk disk_of(const ToolAnswer& answer) {
    return std::get<GeodesicDisk>(std::get<Choose>(*answer.command).region.form);
  }

  SphereScene sphere_;
  DiskTool tool_;
  Vector2d front_ = sphere_.pixel_of(sphere_.vertex_near(kFront));
};

TEST_F(ADisk, DragsItsRimAlongTheSurface) {
  send(press(front_));
  const Vector3d rim(std::sin(0.7), 0, std::cos(0.7));
  send(move_to(sphere_.pixel_of(rim)));
  const VertexSet live = tool_.live();
  const ToolAnswer answer = send(release(sphere_.pixel_of(rim)));
  EXPECT_NEAR(disk_of(answer).radius, 0.7, 0.06) << "an arc of the sphere, not its chord";
  sphere_.perform(answer);
  EXPECT_EQ(sphere_.roi(), live) << "what was shown is what is chosen";
  EXPECT_GT(live.size(), 100U);
}

TEST_F(ADisk, ClickChoosesAtOnceAndTheWheelWithControlSizesIt) {
  send(press(front_));
  const ToolAnswer clicked = send(release(front_));
  EXPECT_FALSE(clicked.resizes);
  const double first = disk_of(clicked).radius;
  EXPECT_GT(first, 0.0);
  const ToolAnswer sized = send(scrolled(front_, 2.0, kSizes));
  EXPECT_TRUE(sized.resizes);
  EXPECT_NEAR(disk_of(sized).radius, first * 1.21, 1e-9);
  EXPECT_NEAR(disk_of(send(scrolled(front_, -2.0, kSizes))).radius, first, 1e-9);
  EXPECT_NEAR(disk_of(send(key(']'))).radius, first * 1.1, 1e-9);
  EXPECT_NEAR(disk_of(send(key('['))).radius, first, 1e-9);
}

TEST_F(ADisk, LeavesTheWheelToTheCamera) {
  EXPECT_FALSE(send(scrolled(front_, 1.0)).taken);
  send(press(front_));
  EXPECT_FALSE(send(scrolled(front_, 1.0)).taken);
  send(release(front_));
  EXPECT_FALSE(send(scrolled(front_, 1.0)).taken) << "whatever was chosen";
  EXPECT_FALSE(send(scrolled(front_, 1.0, {.shift = true})).taken);
}

TEST_F(ADisk, SizingChangesItsOwnPartWhenTheSceneHasGoneOn) {
  send(press(front_));
  sphere_.perform(send(release(front_)));
  const std::size_t clicked = sphere_.roi().size();
  sphere_.part = {Part::Role::handle, 0};
  sphere_.perform(send(scrolled(front_, 3.0, kSizes)));
  EXPECT_GT(sphere_.roi().size(), clicked);
  EXPECT_TRUE(sphere_.state.selection.handles.empty());
  send(press(front_));
  sphere_.perform(send(release(front_)));
  EXPECT_EQ(sphere_.state.selection.handles.size(), 1U) << "the next one is for the next part";
}

TEST_F(ADisk, SaysWhetherItWasClicked) {
  EXPECT_FALSE(tool_.may_change_choice());
  send(press(front_));
  EXPECT_FALSE(tool_.may_change_choice());
  send(release(front_));
  EXPECT_TRUE(tool_.may_change_choice());
  send(press(front_));
  send(move_to(front_ + Vector2d(60, 0)));
  send(release(front_ + Vector2d(60, 0)));
  EXPECT_FALSE(tool_.may_change_choice());
}

TEST_F(ADisk, RimBesideTheSurfaceIsMeasuredStraight) {
  send(press(front_));
  const Vector2d beside = front_ + Vector2d(390, 0);
  send(move_to(beside));
  EXPECT_GT(disk_of(send(release(beside))).radius, 1.2);
}

TEST_F(ADisk, ClickBesideTheSurfaceIsPassedOn) {
  EXPECT_FALSE(send(press({3, 3})).taken);
  EXPECT_FALSE(send(scrolled({3, 3}, 1.0, kSizes)).taken);
}

TEST_F(ADisk, EscapeGivesUp) {
  send(press(front_));
  EXPECT_TRUE(send(key(kEscape)).taken);
  EXPECT_FALSE(send(release(front_)).command.has_value());
  EXPECT_TRUE(tool_.live().empty());
}

// A disk of the front, chosen, and the grips on its rim.
class ADiskWithGrips : public ADisk {
 protected:
  void SetUp() override {
    send(press(front_));
    const Vector2d rim = sphere_.pixel_of(Vector3d(std::sin(0.7), 0, std::cos(0.7)));
    send(move_to(rim));
    sphere_.perform(send(release(rim)));
    send(move_to(front_));
  }
  std::vector<RimGrip> grips() const { return tool_.marks().grips; }
  // The one farthest to the right, and where it shows.
  Vector2d right_grip() const {
    Vector2d right = front_;
    for (const RimGrip& grip : grips()) {
      const Vector2d pixel = sphere_.pixel_of(grip.position);
      if (pixel.x() > right.x()) right = pixel;
    }
    return right;
  }
};

TEST_F(ADiskWithGrips, HasThemOnItsRimAllAround) {
  ASSERT_EQ(grips().size(), 8U);
  const auto disk = std::get<GeodesicDisk>(sphere_.state.selection.roi.made.form);
  Vector3d sum = Vector3d::Zero();
  for (const RimGrip& grip : grips()) {
    EXPECT_NEAR(std::acos(grip.position.normalized().z()), disk.radius, 0.05);
    EXPECT_GT(grip.normal.dot(grip.position), 0.9);
    sum += grip.position;
  }
  EXPECT_LT(sum.head<2>().norm(), 0.8) << "on all sides";
}

TEST_F(ADiskWithGrips, ADragOfOneSizesTheDiskAboutItsMiddle) {
  const Vector2d grip = right_grip();
  send(move_to(grip));
  EXPECT_TRUE(tool_.marks().grip.has_value());
  EXPECT_STREQ(tool_.hint(sphere_.state, kRoi), "Drag the dot to resize the disk.");
  send(press(grip));
  const Vector2d rim = sphere_.pixel_of(Vector3d(std::sin(0.9), 0, std::cos(0.9)));
  send(move_to(rim));
  const VertexSet live = tool_.live();
  const ToolAnswer answer = send(release(rim));
  EXPECT_TRUE(answer.resizes);
  EXPECT_NEAR(disk_of(answer).radius, 0.9, 0.06);
  sphere_.perform(answer);
  EXPECT_EQ(sphere_.roi(), live);
  send(move_to(front_));
  EXPECT_EQ(grips().size(), 8U) << "on its rim as it is now";
}

TEST_F(ADiskWithGrips, AClickOnOneAndEscapeChangeNothing) {
  const Vector2d grip = right_grip();
  send(press(grip));
  EXPECT_FALSE(send(release(grip)).command);
  send(press(grip));
  send(move_to(grip + Vector2d(40.0, 0.0)));
  EXPECT_NE(tool_.live(), sphere_.roi());
  send(key(kEscape));
  EXPECT_FALSE(tool_.is_dragging());
  send(move_to(front_));
  EXPECT_FALSE(grips().empty()) << "of the disk that is chosen";
}

TEST_F(ADiskWithGrips, HasNoneWhileASurfaceThatMovesHasNotSettledOrOnceSomethingElseIsChosen) {
  const AppState before = sphere_.state;
  const Choose handle{{Part::Role::handle, 0}, {ListedVertices{{sphere_.roi().front()}}}};
  SimilarityMove move;
  move.translate = Vector3d::UnitZ();
  sphere_.state = apply(std::move(sphere_.state), handle);
  sphere_.state = apply(std::move(sphere_.state), MoveHandle{0, move});
  send(move_to(front_));
  EXPECT_TRUE(grips().empty());
  sphere_.state = apply(before, Paint{kRoi, {}, {sphere_.roi().front()}});
  send(move_to(front_));
  EXPECT_TRUE(grips().empty());
}

}  // namespace
}  // namespace lapwing::viewer::test
