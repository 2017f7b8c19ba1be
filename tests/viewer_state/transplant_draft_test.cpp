#include "tools/transplant_draft.h"

#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "state/draft.h"
#include "viewer_state/part_scene.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_state/tube_edit.h"
#include "work/transplant_preview.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;

class ATransplantDraft : public ::testing::Test {
 protected:
  ATransplantDraft() : draft_(scene_.draft()) {}

  // What a preview of the step comes to, or why it comes to nothing.
  void preview(const AppState& host, const TransplantStep& step) {
    preview_.follow(host, step);
    wait_until([&] {
      preview_.update();
      return !preview_.is_behind();
    });
  }
  // As `lapwing run` does, from a folder beside the others.
  Mesh run_headless(const AppState& state) const {
    const auto folder = scene_.folder() / "recipes";
    std::filesystem::create_directories(folder);
    const Recipe recipe = to_recipe(state, "../targets/sphere.ply", folder);
    CpuKernels kernels;
    return run_recipe(parse_recipe(to_json(recipe), folder, "test"), kernels)->mesh;
  }

  SphereAndFinger scene_;
  TransplantDraft draft_;
  TransplantPreview preview_{cpu_kernels};
};

TEST_F(ATransplantDraft, StandsWithItsLoopAtThePointAlongTheNormal) {
  EXPECT_FALSE(draft_.stands);
  const Vector3d point = Vector3d(1.0, 2.0, -1.0).normalized();
  draft_.stand_at(point, 3.0 * point);
  EXPECT_TRUE(draft_.stands);
  EXPECT_LT((draft_.frame().center - point).norm(), 1e-12);
  EXPECT_LT((draft_.frame().normal - point).norm(), 1e-12);
}

TEST_F(ATransplantDraft, TurnsAboutItsNormalAndScalesAboutTheMiddleOfItsLoop) {
  draft_.stand_at(Vector3d::UnitX(), Vector3d::UnitX());
  const LoopFrame before = draft_.frame();
  const Eigen::Affine3d placement = draft_.placement;
  draft_.turn_by(90.0);
  draft_.turn_by(-90.0);
  EXPECT_LT((draft_.placement.matrix() - placement.matrix()).norm(), 1e-12);
  draft_.turn_by(30.0);
  draft_.scale_by(1.5);
  EXPECT_LT((draft_.frame().center - before.center).norm(), 1e-12);
  EXPECT_LT((draft_.frame().normal - before.normal).norm(), 1e-12);
  EXPECT_NEAR(draft_.frame().radius, 1.5 * before.radius, 1e-12);
}

TEST_F(ATransplantDraft, FollowsAPathWithoutJumpsOrSpinning) {
  const int steps = 100;
  for (int k = 0; k <= steps; ++k) {
    const double angle = std::numbers::pi * k / steps;
    const Vector3d point(std::sin(angle), 0.0, std::cos(angle));
    const Eigen::Affine3d before = draft_.placement;
    draft_.stand_at(point, point);
    if (k == 0) continue;
    EXPECT_LT((draft_.placement.matrix() - before.matrix()).norm(), 0.1) << k;
    EXPECT_LT((draft_.placement.linear() * Vector3d::UnitY() - Vector3d::UnitY()).norm(), 1e-9)
        << "the axis that the path turns about stays";
  }
}

TEST_F(ATransplantDraft, KeepsItsSizeUnlessThatIsOutOfProportion) {
  EXPECT_EQ(draft_.placement.matrix(), Eigen::Affine3d::Identity().matrix());
  for (const double diagonal : {1e-3, 1e5}) {
    const double radius = draft_with(draft_.part, diagonal).frame().radius;
    EXPECT_GT(radius, 0.03 * diagonal);
    EXPECT_LT(radius, 0.1 * diagonal);
  }
}

TEST_F(ATransplantDraft, ReplaysHeadlessToWhatWasPreviewed) {
  draft_.stand_at(Vector3d::UnitX(), Vector3d::UnitX());
  draft_.turn_by(17.0);
  draft_.scale_by(1.2);
  draft_.parameters.transition = Transition{0.1, Transition::Profile::linear};
  preview(scene_.host.state, draft_.step());
  ASSERT_NE(preview_.result(), nullptr) << preview_.message();
  History history(scene_.host.state);
  history.perform(Apply{draft_.step(), preview_.result()->carried_out.result});
  EXPECT_TRUE(same_mesh(run_headless(history.state()), mesh_of(history.state())));
  EXPECT_GT(history.state().rest->vertex_count(), scene_.host.state.rest->vertex_count());

  std::set<std::array<double, 3>> surface;
  for (const Vector3d& p : scene_.host.state.rest->positions) surface.insert({p.x(), p.y(), p.z()});
  ASSERT_FALSE(preview_.result()->hole.empty());
  for (const Vector3d& p : preview_.result()->hole) {
    EXPECT_EQ(surface.count({p.x(), p.y(), p.z()}), 1U) << "the hole is one of the surface";
  }
}

TEST_F(ATransplantDraft, TakenUpAgainSaysTheSameStep) {
  draft_.stand_at(Vector3d::UnitY(), Vector3d::UnitY());
  draft_.hole_share = 1.4;
  draft_.parameters.sampling = MappedSampling::one_ring;
  const TransplantStep step = draft_.step();
  TransplantDraft again = taken_up(step, scene_.host.state);
  EXPECT_TRUE(again.stands);
  EXPECT_EQ(again.placement.matrix(), draft_.placement.matrix());
  EXPECT_NEAR(again.hole_share, 1.4, 1e-12);
  EXPECT_FALSE(again.chosen_hole);
  EXPECT_EQ(again.parameters, step.parameters);
  EXPECT_LT((again.frame().center - draft_.frame().center).norm(), 1e-9);
}

TEST_F(ATransplantDraft, TakesUpAStepThatFitsItsPartByItselfWhereThatCameTo) {
  TransplantStep step;
  step.part = scene_.finger();
  step.target_region = {GeodesicDisk{Vector3d(0.0, 0.0, 1.0), 0.3}};
  const TransplantDraft draft = taken_up(step, scene_.host.state);
  EXPECT_EQ(draft.chosen_hole, step.target_region);
  EXPECT_GT(draft.frame().normal.z(), 0.99);
  preview(scene_.host.state, step);
  ASSERT_NE(preview_.result(), nullptr) << preview_.message();
  const Mesh fitted =
      *std::get<std::shared_ptr<const Mesh>>(*preview_.result()->carried_out.result);
  preview(scene_.host.state, draft.step());
  ASSERT_NE(preview_.result(), nullptr) << preview_.message();
  const auto& placed =
      std::get<std::shared_ptr<const Mesh>>(*preview_.result()->carried_out.result);
  EXPECT_EQ(placed->positions, fitted.positions);
}

TEST_F(ATransplantDraft, WhosePartIsTooSmallForTheSurfaceSaysSo) {
  draft_.stand_at(Vector3d::UnitX(), Vector3d::UnitX());
  draft_.scale_by(1e-3);
  preview(scene_.host.state, draft_.step());
  EXPECT_EQ(preview_.result(), nullptr);
  EXPECT_FALSE(preview_.message().empty());
  preview_.stop();
  EXPECT_TRUE(preview_.message().empty());
  EXPECT_FALSE(preview_.is_behind());
}

TEST(NormalAround, IsThatOfWhatLiesThere) {
  const AppState sphere = open_state(icosphere(4));
  const Triangle& t = sphere.rest->topology().triangles[1234];
  const auto& p = sphere.rest->positions;
  const Vector3d middle = (p[t[0]] + p[t[1]] + p[t[2]]) / 3.0;
  const SurfacePoint point = surface_point(sphere.rest->topology(), p, 1234, middle);
  EXPECT_GT(normal_around(point, 0.3, sphere.rest->topology(), p).dot(middle.normalized()), 0.999);
  EXPECT_GT(normal_around(point, 1e-9, sphere.rest->topology(), p).dot(middle.normalized()), 0.999);
}

}  // namespace
}  // namespace lapwing::viewer::test
