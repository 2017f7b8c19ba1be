#include "tools/gizmo_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/failing_new.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::FailingNew;
using ::testing::HasSubstr;
using ::testing::Not;

class AGizmoTool : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) {
    return tool_.handle(event, {state_, {}, view_, {}, {}, {}, 0, keys_});
  }
  void type(std::string_view text) {
    for (const char c : text) send(typed(static_cast<char32_t>(c)));
  }
  Move performed(const ToolAnswer& answer) {
    if (!answer.command) return SimilarityMove{};
    state_ = apply(state_, *answer.command);
    return state_.moves[0].move;
  }
  std::string readout() const {
    std::string text;
    tool_.read_out(text);
    return text;
  }
  Vector3d translation(const Move& move) { return std::get<SimilarityMove>(move).translate; }

  AppState state_ = chosen_tube();
  Vector3d center_ = handle_centroid(state_, 0);
  Projection view_ = perspective(center_ + Vector3d(4, 3, 5), center_);
  Vector2d middle_ = *view_.to_pixel(center_);
  GizmoKeys keys_ = GizmoKeys::blender;
  GizmoTool tool_;
};

TEST_F(AGizmoTool, DragOfAnArmMovesTheHandleAlongIt) {
  const Vector2d arm =
      *view_.to_pixel(center_ + Vector3d(0.7 * kArmPt * view_.length_of_pixel(center_), 0, 0));
  send(move_to(arm));
  EXPECT_EQ(tool_.part(), GizmoPart::x);
  EXPECT_TRUE(send(press(arm)).taken);
  send(move_to(arm + 0.5 * (arm - middle_)));
  EXPECT_TRUE(tool_.move().has_value());
  const Vector3d moved = translation(performed(send(release(arm + (arm - middle_)))));
  EXPECT_GT(moved.x(), 0.1);
  EXPECT_NEAR(moved.tail<2>().norm(), 0.0, 1e-12);
  EXPECT_FALSE(tool_.is_dragging());
}

TEST_F(AGizmoTool, ClickBesideTheGizmoIsPassedOn) {
  EXPECT_FALSE(send(press({5, 5})).taken);
  EXPECT_FALSE(send(key('S', {.control = true})).taken) << "nor is Control with a letter its key";
  EXPECT_FALSE(send(key('G', {.shift = true})).taken) << "this key belongs to the Grab tool";
  EXPECT_FALSE(tool_.is_dragging());
}

TEST_F(AGizmoTool, KeysAxisAndNumberSayTheMove) {
  send(move_to(middle_));
  send(key('G'));
  send(key('Z'));
  type("-1.25");
  type("7");
  send(key(kBackspace));
  EXPECT_LT((translation(performed(send(key(kEnter)))) - Vector3d(0, 0, -1.25)).norm(), 1e-12);
}

TEST_F(AGizmoTool, TypedNumberMayHaveAnExponent) {
  send(key('G'));
  send(key('X'));
  type("e2e-1");
  EXPECT_LT((translation(performed(send(key(kEnter)))) - Vector3d(0.2, 0, 0)).norm(), 1e-12)
      << "a number does not begin with an exponent";
}

TEST_F(AGizmoTool, TypedTurnKeepsWholeTurns) {
  send(key('R'));
  send(key('Z'));
  type("400");
  EXPECT_THAT(readout(), HasSubstr("Rotate 400° about Z"));
  EXPECT_THAT(readout(), Not(HasSubstr("commit"))) << "made in parts";
  EXPECT_NEAR(turn_of(performed(send(key(kEnter)))).degrees, 400.0, 1e-9);
  EXPECT_TRUE(state_.moves[0].path.empty());
  send(key('R'));
  send(key('Z'));
  type("-100");
  EXPECT_NEAR(turn_of(performed(send(key(kEnter)))).degrees, 300.0, 1e-9);
}

TEST_F(AGizmoTool, ScaleByANumber) {
  send(key('S'));
  type("2");
  EXPECT_NEAR(std::get<SimilarityMove>(performed(send(key(kEnter)))).scale.x(), 2.0, 1e-12);
  send(key('S'));
  send(key('X'));
  type("3");
  const auto scaled = std::get<SimilarityMove>(performed(send(key(kEnter))));
  EXPECT_LT((scaled.scale - Eigen::Vector3d(6.0, 2.0, 2.0)).norm(), 1e-12);
}

TEST_F(AGizmoTool, ShiftHoldsToThePlane) {
  send(move_to(middle_));
  send(key('G'));
  send(key('Y', {.shift = true}));
  send(move_to(middle_ + Vector2d(40, 25)));
  EXPECT_EQ(tool_.part(), GizmoPart::without_y);
  EXPECT_NEAR(translation(*tool_.move()).y(), 0.0, 1e-9);
}

TEST_F(AGizmoTool, TheSameAxisAgainIsTheHandlesOwnAndThenSetsItFree) {
  send(key('G'));
  send(key('Y'));
  EXPECT_EQ(tool_.part(), GizmoPart::y);
  EXPECT_THAT(readout(), HasSubstr("along Y"));
  send(key('Y'));
  EXPECT_EQ(tool_.part(), GizmoPart::y);
  EXPECT_THAT(readout(), HasSubstr("along local Y"));
  send(key('Y'));
  EXPECT_EQ(tool_.part(), GizmoPart::view);
  send(key('Y'));
  EXPECT_THAT(readout(), HasSubstr("along Y"));
  send(key('X'));
  EXPECT_THAT(readout(), HasSubstr("along X"));
}

TEST_F(AGizmoTool, KeysGoAlongTheAxesThatAreChosen) {
  tool_.set_choices({.axes = GizmoAxes::local});
  const Eigen::Matrix3d axes = gizmo_axes(GizmoAxes::local, state_, 0, Eigen::Affine3d::Identity());
  send(move_to(middle_));
  send(key('G'));
  send(key('X'));
  type("0.5");
  EXPECT_LT((translation(performed(send(key(kEnter)))) - 0.5 * axes.col(0)).norm(), 1e-12);
}

TEST_F(AGizmoTool, TurnsAboutTheChosenPivotWhichStays) {
  tool_.set_choices({.pivot = GizmoPivot::origin});
  send(key('R'));
  send(key('Y'));
  type("90");
  const Move move = performed(send(key(kEnter)));
  const Eigen::Affine3d motion = to_affine(move, center_);
  EXPECT_LT((motion * Vector3d::Zero()).norm(), 1e-9);
  EXPECT_LT((motion * Vector3d::UnitZ() - Vector3d::UnitX()).norm(), 1e-9);
}

TEST_F(AGizmoTool, SticksToTheSurfaceWhereThereIsOne) {
  tool_.set_choices({.sticks_to_surface = true});
  const Vector3d wall(0.3, -0.4, 0.2);
  bool is_there = true;
  const auto pick_still = [&](const Vector2d&) -> std::optional<SurfacePoint> {
    if (!is_there) return {};
    return SurfacePoint{0, 0, wall};
  };
  const auto send_there = [&](const InputEvent& event) {
    return tool_.handle(event, {state_, {}, view_, {}, {}, {}, 0, keys_, pick_still});
  };
  send_there(move_to(middle_));
  send_there(key('G'));
  send_there(move_to(middle_ + Vector2d(30.0, 10.0)));
  EXPECT_LT((center_ + translation(*tool_.move()) - wall).norm(), 1e-12);
  send_there(key('Z'));
  EXPECT_LT((translation(*tool_.move()) - Vector3d(0, 0, wall.z() - center_.z())).norm(), 1e-12)
      << "as far as the axis lets it";
  send_there(key('Z'));
  send_there(key('Z'));
  is_there = false;
  send_there(move_to(middle_));
  EXPECT_LT(translation(*tool_.move()).norm(), 1e-9) << "beside it as without";
}

TEST_F(AGizmoTool, EscapeAndTheRightButtonGiveUp) {
  send(move_to(middle_));
  for (const InputEvent& end : {key(kEscape), at(InputKind::press, middle_, MouseButton::right)}) {
    send(key('G'));
    send(move_to(middle_ + Vector2d(40, 25)));
    EXPECT_FALSE(send(end).command.has_value());
    EXPECT_FALSE(tool_.move().has_value());
  }
}

// What rounding makes of a move would be another step of the history.
TEST_F(AGizmoTool, TakenHoldOfAgainTheMoveIsTheSameBitForBit) {
  SimilarityMove before;
  before.translate = {0.1, -1.0 / 3.0, 0.7};
  before.rotate = {Vector3d(1.0, 2.0, 3.0), 400.0};
  before.scale.setConstant(1.1);
  state_ = apply(state_, MoveHandle{0, before});
  for (const char mode : {'G', 'R', 'S'}) {
    send(key(mode));
    EXPECT_EQ(*tool_.move(), state_.moves[0]);
    EXPECT_FALSE(send(key(kEnter)).command.has_value());
  }
}

TEST_F(AGizmoTool, ControlSnaps) {
  send(move_to(middle_ + Vector2d(100, 0)));
  send(key('R'));
  send(move_to(middle_ + Vector2d(90, -60), {.control = true}));
  EXPECT_NEAR(std::remainder(turn_of(*tool_.move()).degrees, 15.0), 0.0, 1e-9);
  EXPECT_GT(turn_of(*tool_.move()).degrees, 1.0);
}

TEST_F(AGizmoTool, KeysOfMayaChooseWhatIsShown) {
  keys_ = GizmoKeys::maya;
  send(key('E'));
  EXPECT_EQ(tool_.mode(), GizmoMode::rotate);
  send(key('R'));
  EXPECT_EQ(tool_.mode(), GizmoMode::scale);
  EXPECT_FALSE(tool_.is_dragging());
  send(key('W'));
  EXPECT_EQ(tool_.mode(), GizmoMode::translate);
}

TEST_F(AGizmoTool, SaysWhenTheHandleHasTurnedTooFar) {
  send(key('R'));
  send(key('Z'));
  type("180");
  EXPECT_THAT(readout(), Not(HasSubstr("in total")));
  performed(send(key(kEnter)));
  send(key('R'));
  send(key('Z'));
  type("20");
  EXPECT_THAT(readout(), HasSubstr("200° in total")) << "the turns add up";
  EXPECT_THAT(readout(), HasSubstr("Rotate in several steps"));
}

TEST_F(AGizmoTool, APullLetsTheHandleTurnUnlessItWasTurnedByHand) {
  const auto pulled = [&] {
    tool_.take_hold(middle_, {state_, {}, view_, {}, {}, {}, 0, keys_});
    for (int k = 1; k <= 20; ++k) send(move_to(middle_ + Vector2d(0.0, -15.0 * k)));
    performed(send(release(middle_ + Vector2d(0.0, -300.0))));
    return state_.moves[0];
  };
  const HandleMove free = pulled();
  EXPECT_EQ(free.orientation, HandleOrientation::free);
  EXPECT_FALSE(free.path.empty()) << "waypoints of the way";
  state_ = apply(state_, MoveHandle{0, twisted(30.0)});
  EXPECT_EQ(pulled().orientation, HandleOrientation::kept);
}

TEST_F(AGizmoTool, WithCommitsOnTheWayNoTurnIsTooFar) {
  state_ = apply(state_, SetParameters{{.commit_every = 90.0}});
  send(key('R'));
  send(key('Z'));
  type("300");
  EXPECT_THAT(readout(), Not(HasSubstr("commit")));
}

TEST_F(AGizmoTool, FrameOfADragAllocatesNothing) {
  send(move_to(middle_ + Vector2d(100, 0)));
  std::vector<Eigen::Affine3d> motions(state_.moves.size());
  for (const int drag : {'G', 'R', 'S'}) {
    send(key(drag));
    const FailingNew counted(-1);
    for (int k = 0; k < 50; ++k) {
      send(move_to(middle_ + Vector2d(90 - k, 3 * k)));
      maps_of(state_, 0, *tool_.move(), motions);
    }
    EXPECT_EQ(FailingNew::calls(), 0) << static_cast<char>(drag);
    send(key(kEscape));
  }
}

TEST_F(AGizmoTool, MotionsOfADragAreThoseOfItsMovePerformed) {
  state_ = apply(state_, Choose{kSecondHandle, box(2.0, 2.3)});
  state_ = apply(state_, MoveHandle{1, bent()});
  std::vector<Eigen::Affine3d> motions;
  maps_of(state_, 0, twisted(30.0), motions);
  const auto expected = motions_of(apply(state_, MoveHandle{0, twisted(30.0)})).maps;
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_EQ(motions[0].matrix(), expected[0].matrix());
  EXPECT_EQ(motions[1].matrix(), expected[1].matrix());
}

TEST_F(AGizmoTool, GoesWithItsHandle) {
  send(key('G'));
  send(key('X'));
  type("1.5");
  EXPECT_LT((tool_.gizmo(state_, 0).center - center_ - Vector3d(1.5, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace lapwing::viewer::test
