#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/coating/coat.h"
#include "lapwing/recipe/step.h"
#include "lapwing/run/run_report.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/coat_runs.h"
#include "support/bent_tube.h"
#include "support/gpu.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Index kMixCells = 24;
constexpr double kMixHeight = 0.01;
constexpr double kMixDetail = 0.5;

const std::string kByDistance =
    R"(, "weight": {"distance_to": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.1}}, "width": 0.2})";

// Two reliefs and a folded sheet to mix them on.
class RunMix : public CoatRuns {
 protected:
  void SetUp() override {
    write(relief(kMixCells, 4.0, kMixHeight), "fine.ply");
    write(relief(kMixCells, 2.0, 2.0 * kMixHeight), "coarse.ply");
    Mesh mesh = grid(kMixCells, kMixCells);
    for (Vector3d& p : mesh.positions) p.z() = 0.1 * p.x() * p.x();
    write(mesh, "target.ply");
  }

  // `file` empty: the target itself. `keys` begins with a comma.
  static std::string source(const std::string& file, const std::string& patch,
                            double detail = kMixDetail, const std::string& keys = "") {
    const std::string mesh = file.empty() ? "" : R"("mesh": ")" + file + R"(", )";
    return "{" + mesh + R"("patch": )" + patch + R"(, "detail_size": )" + std::to_string(detail) +
           keys + "}";
  }
  static std::string mix(const std::string& first, const std::string& second,
                         const std::string& target, const std::string& keys) {
    return R"({"op": "mix", "sources": [)" + first + ", " + second + R"(], "target_patch": )" +
           target + keys + "}";
  }
  static std::string field(std::size_t count, double w) {
    return R"(, "weight": {"field": )" + nlohmann::json(std::vector<double>(count, w)).dump() + "}";
  }
  static std::size_t all_vertices() { return (kMixCells + 1) * (kMixCells + 1); }
};

TEST_F(RunMix, OfASurfaceWithItselfReturnsIt) {
  write(relief(kMixCells, 4.0, kMixHeight), "target.ply");
  const Mesh before = read("target.ply");
  const double diagonal = bounds_of(before.positions).diagonal();
  const std::string own = source("", kAll);
  for (const char* keys : {R"(, "take": "shape")", R"(, "smooth_target": 0.5)"}) {
    const auto result =
        run(mix(own, own, kAll, kByDistance + kKeep + keys + R"(, "transition": {"width": 0})"));
    EXPECT_LT(largest_distance(result->mesh.positions, before.positions), 1e-6 * diagonal) << keys;
  }
}

TEST_F(RunMix, WithAllOfOneSourceIsACoatWithIt) {
  const auto coated = [&](const std::string& file, double detail, double amplitude) {
    return run(coat(kAll, kMiddle,
                    R"(, "source": ")" + file + R"(", "amplitude": )" + std::to_string(amplitude) +
                        kKeep,
                    detail))
        ->mesh.positions;
  };
  const std::string fine = source("fine.ply", kAll, 0.3, R"(, "amplitude": 2)");
  const std::string coarse = source("coarse.ply", kAll, 0.6);
  const auto mixed = [&](double w) {
    return run(mix(fine, coarse, kMiddle, field(all_vertices(), w) + kKeep))->mesh.positions;
  };
  EXPECT_LT(largest_distance(mixed(0.0), coated("fine.ply", 0.3, 2.0)), 1e-9);
  EXPECT_LT(largest_distance(mixed(1.0), coated("coarse.ply", 0.6, 1.0)), 1e-9);
  EXPECT_GT(largest_distance(mixed(0.0), mixed(1.0)), 0.5 * kMixHeight);
}

TEST_F(RunMix, IsTheSameWithSourcesAndWeightExchanged) {
  std::vector<double> w;
  for (const Vector3d& p : read("target.ply").positions) w.push_back(std::clamp(p.y(), 0.0, 1.0));
  std::vector<double> complement;
  for (const double share : w) complement.push_back(1.0 - share);
  const std::string fine = source("fine.ply", kAll, 0.3);
  const std::string coarse = source("coarse.ply", kAll, 0.6);
  const auto weighed = [&](const std::vector<double>& shares) {
    return R"(, "weight": {"field": )" + nlohmann::json(shares).dump() + "}" + kKeep;
  };
  const auto one = run(mix(fine, coarse, kMiddle, weighed(w)));
  const auto other = run(mix(coarse, fine, kMiddle, weighed(complement)));
  EXPECT_GT(largest_distance(one->mesh.positions, one->original), 0.2 * kMixHeight);
  EXPECT_LT(largest_distance(one->mesh.positions, other->mesh.positions), 1e-9);
}

TEST_F(RunMix, HandlesTakeTheSurfaceAlongWhateverIsMixed) {
  const std::string handle =
      R"(, "handles": [{"region": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.1}},
                       "move": {"translate": [0, 0, 0.2]}}])";
  for (const char* take : {"coating", "shape"}) {
    const std::string keys =
        kByDistance + kKeep + R"(, "transition": {"width": 0.1}, "take": ")" + take + '"';
    const std::string fine = source("fine.ply", kMiddle);
    const std::string coarse = source("coarse.ply", kMiddle);
    const auto still = run(mix(fine, coarse, kMiddle, keys));
    const auto moved = run(mix(fine, coarse, kMiddle, keys + handle));
    ASSERT_EQ(moved->region.handles.size(), 1U);
    EXPECT_EQ(moved->report.steps[0].handles,
              (std::vector<std::size_t>{moved->region.handles[0].size()}));
    for (const Index v : moved->region.handles[0]) {
      const Vector3d way = moved->mesh.positions[v] - moved->original[v];
      EXPECT_NEAR(way.z(), 0.2, 0.02) << take << ", vertex " << v;
    }
    // Between it and the border the surface has come a part of the way.
    const Index half = (kMixCells + 1) * (kMixCells / 2) + kMixCells / 2 + 5;
    const double followed = moved->mesh.positions[half].z() - still->mesh.positions[half].z();
    EXPECT_GT(followed, 0.03) << take;
    EXPECT_LT(followed, 0.15) << take;
  }
}

TEST_F(RunMix, ReportsBothSources) {
  const auto result = run(
      mix(source("fine.ply", kAll), source("coarse.ply", kMiddle), kMiddle, kByDistance + kKeep));
  const auto step = nlohmann::json::parse(to_json(result->report)).at("steps").at(0);
  EXPECT_EQ(step.at("op"), "mix");
  const auto& sources = step.at("mix").at("sources");
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0].at("source_vertices"), all_vertices());
  EXPECT_LT(sources[1].at("source_vertices"), all_vertices());
  EXPECT_LT(step.at("mix").at("relative_residual"), 1e-9);
  EXPECT_EQ(result->region.roi.size(), step.at("roi"));
}

TEST_F(RunMix, PaintedFieldAndHandleAreCarriedThroughARemeshing) {
  const Mesh coarse_target = grid(8, 8);
  write(coarse_target, "target.ply");
  // All of the fine source on the left, of none on the right.
  std::vector<double> w;
  for (const Vector3d& p : coarse_target.positions) w.push_back(p.x() < 0.5 ? 0.0 : 1.0);
  const std::string flat = source("fine.ply", kAll, kMixDetail, R"(, "amplitude": 0)");
  const std::string keys =
      R"(, "transition": {"width": 0.05}, "weight": {"field": )" + nlohmann::json(w).dump() + "}";
  const auto result = run(mix(source("fine.ply", kAll), flat, kAll, keys));
  EXPECT_GT(result->report.steps[0].coat->vertices_before_remeshing, 0U);
  EXPECT_GT(result->mesh.vertex_count(), 2 * coarse_target.vertex_count());
  EXPECT_TRUE(result->mesh.attributes().vertex_extras.empty());
  double left = 0.0;
  double right = 0.0;
  for (const Vector3d& p : result->mesh.positions) {
    if (p.x() < 0.3) left = std::max(left, std::abs(p.z()));
    if (p.x() > 0.7) right = std::max(right, std::abs(p.z()));
  }
  EXPECT_GT(left, 0.5 * kMixHeight);
  EXPECT_LT(right, 0.1 * left);
  const auto moved = run(mix(source("fine.ply", kAll), flat, kAll,
                             keys + R"(, "handles": [{"region": {"vertices": [40]},
                                        "move": {"translate": [0, 0, 0.1]}}])"));
  ASSERT_EQ(moved->region.handles.at(0).size(), 1U);
  const Index handle = moved->region.handles[0][0];
  EXPECT_LT((moved->original[handle] - coarse_target.positions[40]).norm(), 0.05);
  EXPECT_GT(moved->mesh.positions[handle].z(), 0.05);
}

TEST_F(RunMix, SaysWhatDoesNotFit) {
  const std::string fine = source("fine.ply", kAll);
  const auto said = [&](const std::string& keys) {
    return refusal(mix(fine, fine, kMiddle, keys + kKeep));
  };
  EXPECT_THAT(said(field(3, 0.5)),
              AllOf(StartsWith("test: /steps/0/weight/field: "), HasSubstr("got 3")));
  EXPECT_THAT(said(R"(, "weight": {"distance_to": {"vertices": [99999]}, "width": 1})"),
              AllOf(StartsWith("test: /steps/0/weight/distance_to"), HasSubstr("99999")));
  EXPECT_THAT(said(R"(, "weight": {"distance_to": {"vertices": []}, "width": 1})"),
              AllOf(StartsWith("test: /steps/0/weight/distance_to: "), HasSubstr("no vertices")));
  const auto with_handle = [&](const std::string& handles) {
    return said(kByDistance + R"(, "handles": [)" + handles + "]");
  };
  EXPECT_THAT(with_handle(R"({"region": {"vertices": [0]}, "move": {}})"),
              AllOf(StartsWith("test: /steps/0/handles/0/region: "),
                    HasSubstr("leaves the target patch at vertex 0")));
  const std::string middle = R"({"region": {"vertices": [312]}, "move": {}})";
  EXPECT_THAT(with_handle(middle + ", " + middle),
              AllOf(StartsWith("test: /steps/0/handles/1/region: "), HasSubstr("312")));
  EXPECT_THAT(
      refusal(mix(fine, source("coarse.ply", R"({"minus": [{"all": true}, )" + kMiddle + "]}"),
                  kMiddle, kByDistance)),
      AllOf(StartsWith("test: /steps/0/sources/1/patch"), HasSubstr("not a disk")));
  EXPECT_THAT(refusal<IoError>(mix(fine, source("nothing.ply", kAll), kMiddle, kByDistance)),
              HasSubstr("nothing.ply"));
}

TEST_F(RunMix, OnTheDeviceGivesWhatTheProcessorGives) {
  LAPWING_NEEDS_GPU();
  VulkanKernels device(VulkanOptions{.frames_on_device = true});
  for (const char* take : {"coating", "shape"}) {
    const std::string step = mix(source("fine.ply", kAll), source("coarse.ply", kAll), kMiddle,
                                 kByDistance + kKeep + R"(, "take": ")" + take + '"');
    const auto there = run(step, device);
    const auto here = run(step);
    EXPECT_GT(largest_distance(here->mesh.positions, here->original), 0.1 * kMixHeight);
    EXPECT_LT(largest_distance(there->mesh.positions, here->mesh.positions),
              1e-9 * bounds_of(here->original).diagonal());
  }
}

class APreparedCoat : public RunMix {
 protected:
  CoatStep step(double detail, double amplitude, const std::string& keys) const {
    const std::string text =
        coat(kAll, kMiddle,
             R"(, "source": "fine.ply", "amplitude": )" + std::to_string(amplitude) + keys, detail);
    const Recipe recipe = parse_recipe(
        R"({"lapwing": 1, "mesh": "target.ply", "steps": [)" + text + "]}", folder_.path(), "test");
    return std::get<CoatStep>(recipe.steps.at(0));
  }

  PreparedCoat prepare(const CoatStep& step, const Mesh& mesh) {
    return {{step.source, step.target_patch, step.parameters},
            mesh,
            read_source_meshes({&step.source, 1}, folder_.path(), {}).front(),
            cpu_};
  }
};

TEST_F(APreparedCoat, GivesForEveryAmplitudeWhatTheStepGives) {
  for (const std::string& keys : {kKeep, std::string()}) {
    write(grid(keys.empty() ? 8 : kMixCells, keys.empty() ? 8 : kMixCells), "target.ply");
    const Mesh mesh = read("target.ply");
    const PreparedCoat prepared = prepare(step(kMixDetail, 1.0, keys), mesh);
    EXPECT_EQ(prepared.layers().remeshed() != nullptr, keys.empty());
    for (const double amplitude : {1.0, 0.0, -0.5}) {
      const CoatStep whole = step(kMixDetail, amplitude, keys);
      const auto result = run_recipe({"target.ply", {whole}, "", folder_.path()}, cpu_);
      EXPECT_EQ(prepared.positions(amplitude), result->mesh.positions);
    }
  }
}

TEST_F(APreparedCoat, TakesAnotherDetailSizeWithoutPreparingAnew) {
  const Mesh mesh = read("target.ply");
  // A transition of its own, since that of the step's follows the detail size.
  const std::string keys = kKeep + R"(, "transition": {"width": 0.1})";
  PreparedCoat prepared = prepare(step(0.5, 1.0, keys), mesh);
  const Positions before = prepared.positions(1.0);
  prepared.set_detail_size(0.2);
  const Positions smaller = prepared.positions(1.0);
  const PreparedCoat anew = prepare(step(0.2, 1.0, keys), mesh);
  EXPECT_GT(largest_distance(before, smaller), 0.1 * kMixHeight);
  EXPECT_LT(largest_distance(smaller, anew.positions(1.0)),
            0.25 * largest_distance(before, smaller));
  prepared.set_detail_size(0.5);
  EXPECT_EQ(prepared.positions(1.0), before);
  EXPECT_THROW(prepared.set_detail_size(0.0), InputError);
}

TEST_F(APreparedCoat, ShowsBothPatchesInTheDomain) {
  const Mesh mesh = read("target.ply");
  const PreparedCoat prepared = prepare(step(kMixDetail, 1.0, kKeep), mesh);
  const LayeredCoat& layers = prepared.layers();
  EXPECT_EQ(layers.map(0).source.points.size(), layers.source_patch(0).size());
  EXPECT_EQ(layers.map(0).target.points.size(), layers.target_patch().size());
  for (const auto& point : layers.map(0).target.points) EXPECT_LT(point.norm(), 1.0 + 1e-9);
}

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
