// How wide the blend of two surfaces is in the result, beside the width asked: ridges on one
// source, nothing on the other, and a plane to mix them on.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "session/coat_runs.h"
#include "support/bent_tube.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

constexpr Index kWidthCells = 120;
constexpr double kRidges = 20.0;  // along x
constexpr double kWidthHeight = 0.004;
constexpr double kWidthDetail = 0.2;

// Where the profiles pass 10% and 90%, in widths.
constexpr double kBetweenOfLinear = 0.8;
constexpr double kBetweenOfSmooth = 0.6084;

class MixWidth : public CoatRuns {
 protected:
  void SetUp() override {
    Mesh ridges = grid(kWidthCells, kWidthCells);
    for (Vector3d& p : ridges.positions) p.z() = kWidthHeight * wave(p.x());
    write(ridges, "ridges.ply");
    write(grid(kWidthCells, kWidthCells), "target.ply");
  }
  static double wave(double x) { return std::sin(2.0 * std::numbers::pi * kRidges * x); }

  // The target itself, which is flat, mixed with the ridges; `keys` begins with a comma.
  std::unique_ptr<RunResult> mixed(const std::string& keys) {
    nlohmann::json pins = nlohmann::json::array();
    for (const Index v : corners(kWidthCells)) pins.push_back({v, v});
    const std::string common = R"("patch": {"all": true}, "detail_size": )" +
                               std::to_string(kWidthDetail) + R"(, "boundary_pairs": )" +
                               pins.dump();
    return run(R"({"op": "mix", "target_patch": {"all": true}, "domain": "square",
                   "remesh": "none", "transition": {"width": 0}, "sources": [{)" +
               common + R"(}, {"mesh": "ridges.ply", )" + common + "}]" + keys + "}");
  }

  // The height of the ridges at each y, their waves of the middle fitted, over the largest.
  static std::map<double, double> heights(const Positions& positions) {
    std::map<double, double> products;
    std::map<double, double> squares;
    const Mesh flat = grid(kWidthCells, kWidthCells);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Vector3d& p = flat.positions[v];
      if (p.x() < 0.2 || p.x() > 0.8 || p.y() < 0.08 || p.y() > 0.92) continue;
      products[p.y()] += wave(p.x()) * positions[v].z();
      squares[p.y()] += wave(p.x()) * wave(p.x());
    }
    double highest = 0.0;
    for (auto& [y, height] : products) {
      height /= squares[y];
      highest = std::max(highest, height);
    }
    EXPECT_GT(highest, 0.8 * kWidthHeight);
    for (auto& [y, height] : products) height /= highest;
    return products;
  }

  // The y at which the height passes `share`.
  static double passes(const std::map<double, double>& heights, double share) {
    auto before = heights.begin();
    for (auto at = std::next(before); at != heights.end(); before = at++) {
      if ((before->second - share) * (at->second - share) > 0.0) continue;
      const double t = (share - before->second) / (at->second - before->second);
      return before->first + t * (at->first - before->first);
    }
    ADD_FAILURE() << "nowhere " << share;
    return 0.0;
  }

  double between_10_and_90_percent(const std::string& keys) {
    const auto result = mixed(keys);
    const auto all = heights(result->mesh.positions);
    return std::abs(passes(all, 0.9) - passes(all, 0.1));
  }

  static std::string along_v(double width, const std::string& profile) {
    return R"(, "weight": {"domain_v": [)" + std::to_string(0.5 - 0.5 * width) + ", " +
           std::to_string(0.5 + 0.5 * width) + R"(]}, "profile": ")" + profile + '"';
  }
  static std::string by_distance(double width, const std::string& profile) {
    return R"(, "weight": {"distance_to": {"box": {"min": [-1, -1, -1], "max": [2, 0.3, 1]}},
                           "width": )" +
           std::to_string(width) + R"(}, "profile": ")" + profile + '"';
  }
};

TEST_F(MixWidth, IsTheOneAsked) {
  for (const double width : {0.1, 0.2, 0.4}) {
    for (const auto& weight : {along_v, by_distance}) {
      const double linear = between_10_and_90_percent(weight(width, "linear"));
      EXPECT_NEAR(linear / (kBetweenOfLinear * width), 1.0, 0.1) << width;
      const double smooth = between_10_and_90_percent(weight(width, "smooth"));
      EXPECT_NEAR(smooth / (kBetweenOfSmooth * width), 1.0, 0.1) << width;
    }
  }
}

TEST_F(MixWidth, OfASharpTransitionIsThatOfAWave) {
  EXPECT_LT(between_10_and_90_percent(by_distance(0.0, "smooth")), 1.0 / kRidges);
}

TEST_F(MixWidth, StandsWhereItWasAsked) {
  const auto along = heights(mixed(along_v(0.3, "smooth"))->mesh.positions);
  EXPECT_NEAR(passes(along, 0.5), 0.5, 0.01);
  const auto by = heights(mixed(by_distance(0.3, "smooth"))->mesh.positions);
  EXPECT_NEAR(passes(by, 0.5), 0.3 + 0.15, 0.01);
}

}  // namespace
}  // namespace lapwing::test
