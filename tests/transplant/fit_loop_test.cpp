#include "lapwing/transplant/fit_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/transplant/cut.h"
#include "support/error_message.h"
#include "transplant/loops.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::circle_points;
using test::difference;
using test::moved;
using test::similarity;
using ::testing::AllOf;
using ::testing::HasSubstr;

using Points = std::vector<Vector3d>;

// An angular region without symmetry on hilly ground, cut out.
struct CutHills : testing::Test {
  Mesh mesh = bumpy_plane(24, 3, 0.1);
  VertexSet region = [this] {
    VertexSet corner;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vector3d& p = mesh.positions[v];
      if (p.x() > 0.15 && p.x() < 0.8 && p.y() > 0.2 && p.y() < (p.x() < 0.4 ? 0.85 : 0.45)) {
        corner.push_back(v);
      }
    }
    return corner;
  }();
  Points part = test::first_loop(cut_out(mesh, region, "region").mesh);
  Points hole{part.rbegin(), part.rend()};
};

// A closed curve without symmetry in `count` points, counter-clockwise around z.
Points wavy_loop(std::size_t count, double phase = 0.0) {
  Points points;
  for (std::size_t k = 0; k < count; ++k) {
    const double a =
        2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count) + phase;
    const double r = 1.0 + 0.3 * std::cos(2.0 * a) + 0.15 * std::sin(3.0 * a);
    points.emplace_back(r * std::cos(a), r * std::sin(a), 0.1 * std::cos(3.0 * a));
  }
  return points;
}

Points reversed(const Points& points) {
  return {points.rbegin(), points.rend()};
}

const std::array kMotions{Affine3d(Affine3d::Identity()),
                          similarity(40.0, {1, 2, 3}, 2.5, {4, -3, 2}),
                          similarity(180.0, {1, 0, 0}, 0.2, {-1, 0, 7}),
                          similarity(175.0, {1, 1, -1}, 1.0, {0, 0, 0}),
                          similarity(90.0, {0, 0, 1}, 30.0, {100, 100, 0}),
                          similarity(-120.0, {3, -1, 1}, 0.01, {2, 2, 2})};

TEST_F(CutHills, PartThatWasMovedGoesBackWhereItWasCut) {
  for (const Affine3d& motion : kMotions) {
    const Affine3d placed = fit_loop(moved(motion, part), hole, {}, "fit") * motion;
    EXPECT_LT(difference(placed, Affine3d::Identity()), 1e-6);
  }
}

TEST_F(CutHills, ItDoesNotMatterWhereTheLoopsStart) {
  std::rotate(hole.begin(), hole.begin() + 17, hole.end());
  EXPECT_LT(difference(fit_loop(part, hole, {}, "fit"), Affine3d::Identity()), 1e-6);
}

TEST(FitLoop, FollowsTheHoleAndForgetsWhereThePartWas) {
  const Points part = wavy_loop(50);
  const Points hole =
      reversed(moved(Eigen::Affine3d(Eigen::Scaling(1.2, 0.9, 2.0)), wavy_loop(64)));
  const Affine3d placed = fit_loop(part, hole, {}, "fit");
  for (const Affine3d& motion : kMotions) {
    const Affine3d follows = fit_loop(part, moved(motion, hole), {}, "fit");
    EXPECT_LT(difference(motion.inverse() * follows, placed), 1e-6);
    const Affine3d forgets = fit_loop(moved(motion, part), hole, {}, "fit");
    EXPECT_LT(difference(forgets * motion, placed), 1e-6);
  }
}

TEST(FitLoop, LoopsOfOtherCountsMeetWithinAHundredth) {
  for (const std::size_t count : {24U, 57U, 400U, 5000U}) {
    const Points part = moved(kMotions[1], wavy_loop(count, 1.0));
    const Points hole = reversed(wavy_loop(100));
    const Affine3d placed = fit_loop(part, hole, {}, "fit") * kMotions[1];
    // What the part's loop was sampled from lies on the curve again.
    for (const Vector3d& p : wavy_loop(90)) EXPECT_LT((placed * p - p).norm(), 0.01 * 3.0);
  }
}

TEST(FitLoop, ADomeStandsOutOfTheHole) {
  const Mesh sphere = icosphere(4);
  VertexSet region;
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    if (sphere.positions[v].x() > 0.2) region.push_back(v);
  }
  const Mesh dome = cut_out(sphere, region, "region").mesh;
  const Mesh ground = grid(20, 20);
  VertexSet hole;
  for (Index v = 0; v < ground.vertex_count(); ++v) {
    if ((ground.positions[v] - Vector3d(0.5, 0.5, 0.0)).norm() < 0.25) hole.push_back(v);
  }
  // The grid's outer border is cut off too, so that the hole has the one loop left.
  Points loop = test::first_loop(cut_out(ground, hole, "hole").mesh);
  std::ranges::reverse(loop);
  const Affine3d placed = fit_loop(test::first_loop(dome), loop, {}, "fit");
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : dome.positions) mean += placed * p;
  mean /= static_cast<double>(dome.vertex_count());
  EXPECT_NEAR(mean.x(), 0.5, 0.02);
  EXPECT_NEAR(mean.y(), 0.5, 0.02);
  EXPECT_GT(mean.z(), 0.05);
}

TEST(FitLoop, NeverMirrors) {
  const Affine3d mirror(Eigen::Scaling(-1.0, 1.0, 1.0));
  const Points loop = wavy_loop(60);
  for (const Points& hole : {loop, reversed(loop), moved(mirror, loop)}) {
    const Affine3d placed = fit_loop(loop, hole, {}, "fit");
    EXPECT_GT(placed.linear().determinant(), 0.0);
    const double scale = std::cbrt(placed.linear().determinant());
    EXPECT_LT((placed.linear() * placed.linear().transpose() -
               scale * scale * Eigen::Matrix3d::Identity())
                  .norm(),
              1e-9);
  }
}

TEST(FitLoop, RoundPartTurnsNoMoreThanItMust) {
  const Affine3d tilt = similarity(30.0, {1, 1, 0}, 2.0, {5, 0, 0});
  for (const std::size_t count : {24U, 60U, 333U}) {
    // Where the points on the circles are says little, and nothing for other counts.
    const Points part = moved(tilt, circle_points(count, 0.02));
    const Affine3d placed = fit_loop(part, reversed(circle_points(60, 0.02)), {}, "fit");
    EXPECT_LT((placed.rotation() - tilt.rotation().transpose()).norm(), 1e-6) << count;
  }
}

TEST(FitLoop, CornersMeetCornersByTheLeastTurn) {
  const Affine3d motion = similarity(20.0, {0, 0, 1}, 1.0, {1, 2, 3});
  const Affine3d placed =
      fit_loop(moved(motion, circle_points(6)), reversed(circle_points(6)), {}, "fit");
  EXPECT_LT(difference(placed * motion, Affine3d::Identity()), 1e-6);
}

TEST(FitLoop, TurnAndScaleAreAboutTheHolesNormalAndCentre) {
  const Points part = wavy_loop(60);
  const Points hole = reversed(moved(kMotions[1], part));
  const Affine3d placed = fit_loop(part, hole, {}, "fit");
  LoopFit fit;
  fit.rotate_degrees = 35.0;
  fit.scale = 1.5;
  const Affine3d turned = fit_loop(part, hole, fit, "fit");
  // The loop's plane is z = 0 on the part's side.
  const Affine3d own = placed.inverse() * turned;
  const Eigen::AngleAxisd turn((own.linear() / 1.5).eval());
  EXPECT_NEAR(turn.angle() * 180.0 / std::numbers::pi, 35.0, 1e-6);
  EXPECT_GT(turn.axis().z(), 0.99);
  fit = {};
  fit.keep_size = true;
  EXPECT_NEAR(fit_loop(part, hole, fit, "fit").linear().determinant(), 1.0, 1e-12);
}

TEST(FitLoop, WhatCannotBePlacedIsNamed) {
  const Points good = circle_points(12);
  const auto message = [](const Points& part, const Points& host, const LoopFit& fit = {}) {
    return error_message<InputError>([&] { fit_loop(part, host, fit, "place"); });
  };
  EXPECT_THAT(message({good[0], good[1]}, good),
              AllOf(HasSubstr("place"), HasSubstr("the part's")));
  EXPECT_THAT(message(good, {}), HasSubstr("the hole's boundary loop has 0 vertices"));
  Points broken = good;
  broken[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(good, broken), AllOf(HasSubstr("the hole's"), HasSubstr("non-finite")));
  EXPECT_THAT(message({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, good), HasSubstr("collinear"));
  EXPECT_THAT(message({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, good), HasSubstr("collinear"));
  LoopFit fit;
  fit.scale = 0.0;
  EXPECT_THAT(message(good, good, fit), HasSubstr("above 0"));
  fit = {};
  fit.rotate_degrees = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(good, good, fit), HasSubstr("degrees"));
  fit = {};
  fit.keep_size = true;
  fit.scale = 2.0;
  EXPECT_THAT(message(good, good, fit),
              HasSubstr("place: \"keep_size\" and \"scale\" exclude each other"));
}

}  // namespace
}  // namespace lapwing
