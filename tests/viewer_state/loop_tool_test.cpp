#include "tools/loop_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

const Vector3d kCorners[] = {Vector3d(0.4, 0.4, 0.82), Vector3d(-0.4, 0.4, 0.82),
                             Vector3d(-0.4, -0.4, 0.82), Vector3d(0.4, -0.4, 0.82)};

class ALoop : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  ToolAnswer click(const Vector3d& point) { return send(press(sphere_.pixel_of(point))); }
  void go_around() {
    for (const Vector3d& corner : kCorners) click(corner);
  }

  SphereScene sphere_;
  LoopTool tool_;
};

TEST_F(ALoop, ClickOnTheFirstCornerClosesIt) {
  go_around();
  EXPECT_FALSE(tool_.marks().line_is_done);
  send(press(sphere_.pixel_of(tool_.corners().front()) + Vector2d(4, 3)));
  EXPECT_TRUE(tool_.marks().line_is_done);
  EXPECT_EQ(tool_.marks().line.front(), tool_.marks().line.back());
}

TEST_F(ALoop, LineRunsAlongTheMesh) {
  go_around();
  send(key(kEnter));
  const auto line = tool_.marks().line;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const auto ring = sphere_.state.rest->topology().rings[line[k]];
    EXPECT_TRUE(std::binary_search(ring.begin(), ring.end(), line[k + 1]));
  }
}

TEST_F(ALoop, NextClickSaysWhichSide) {
  const std::size_t all = sphere_.state.rest->vertex_count();
  go_around();
  send(key(kEnter));
  const std::size_t loop = tool_.marks().line.size() - 1;
  sphere_.perform(click({0, 0, 1}));
  const std::size_t inside = sphere_.roi().size();
  EXPECT_TRUE(tool_.corners().empty()) << "ready for another loop";
  go_around();
  send(key(kEnter));
  sphere_.perform(click({0.85, 0, 0.5}));
  EXPECT_LT(inside, all / 3);
  EXPECT_EQ(inside + sphere_.roi().size(), all + loop) << "the loop belongs to both sides";
}

TEST_F(ALoop, FollowsTheCursorBetweenClicks) {
  click(kCorners[0]);
  send(move_to(sphere_.pixel_of(kCorners[1])));
  const auto line = tool_.marks().line;
  EXPECT_EQ(line.back(), sphere_.vertex_near(kCorners[1]));
  EXPECT_GT(line.size(), 3U);
}

TEST_F(ALoop, BackspaceTakesTheLastClickBack) {
  go_around();
  send(key(kEnter));
  send(key(kBackspace));
  EXPECT_FALSE(tool_.marks().line_is_done);
  for (int k = 0; k < 4; ++k) send(key(kBackspace));
  EXPECT_TRUE(tool_.corners().empty());
  EXPECT_FALSE(send(key(kBackspace)).taken);
  go_around();
  send(key(kEscape));
  EXPECT_TRUE(tool_.marks().line.empty()) << "Escape takes all back";
  click(kCorners[0]);
  click(kCorners[1]);
  EXPECT_FALSE(send(key(kEnter)).message.empty()) << "too few corners";
  EXPECT_FALSE(tool_.marks().line_is_done);
}

TEST_F(ALoop, ThatDoesNotSeparateIsSaidAndCanBeTakenBack) {
  click(kCorners[0]);
  click(kCorners[1]);
  click(kCorners[0]);
  send(key(kEnter));
  const ToolAnswer answer = click({0, 0, 1});
  EXPECT_FALSE(answer.command.has_value());
  EXPECT_FALSE(answer.message.empty());
  EXPECT_FALSE(tool_.corners().empty());
}

}  // namespace
}  // namespace lapwing::viewer::test
