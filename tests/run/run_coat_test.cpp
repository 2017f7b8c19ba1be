#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/coating/peel.h"
#include "lapwing/run/run_report.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/coat_runs.h"
#include "support/bent_tube.h"
#include "support/gpu.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Index kCoatCells = 24;
constexpr double kCoatHeight = 0.01;
constexpr double kTiny = 1e-6;

// A sheet with a fold in it, for the relief to come to.
Mesh folded_sheet(Index cells) {
  Mesh mesh = grid(cells, cells);
  for (Vector3d& p : mesh.positions) p.z() = 0.1 * p.x() * p.x();
  return mesh;
}

class RunCoat : public CoatRuns {
 protected:
  void SetUp() override {
    write(relief(kCoatCells, 4.0, kCoatHeight), "source.ply");
    write(folded_sheet(kCoatCells), "target.ply");
  }
  static std::string lift() {
    return R"({"op": "deform", "roi": {"all": true},
      "belt": {"box": {"min": [-1, -1, -1], "max": [0.2, 2, 1]}},
      "handles": [{"region": {"box": {"min": [0.9, -1, -1], "max": [2, 2, 1]}},
                   "move": {"translate": [0, 0, 0.1]}}], "settle": false})";
  }
};

TEST_F(RunCoat, ReliefOnAFoldIsAsHighAsOnItsSource) {
  const auto result = run(coat(kAll, kMiddle, kFrom + kKeep + R"(, "scale": 1)"));
  const CoatReport& report = *result->report.steps[0].coat;
  EXPECT_NEAR(report.largest_displacement, kCoatHeight, 0.5 * kCoatHeight);
  EXPECT_NEAR(report.sources[0].mean_scale, 1.0, 1e-9);
  EXPECT_LT(report.relative_residual, 1e-9);
  EXPECT_TRUE(all_finite(result->mesh.positions));
}

TEST_F(RunCoat, WithoutASourceTakesFromTheMeshItself) {
  const std::string left = R"({"disk": {"near": [0.25, 0.5, 0], "radius": 0.2}})";
  const std::string right = R"({"disk": {"near": [0.75, 0.5, 0], "radius": 0.2}})";
  write(relief(kCoatCells, 4.0, kCoatHeight), "target.ply");
  const std::string keys = R"(, "transition": {"width": 0.1})" + kKeep;
  const auto itself = run(coat(left, right, keys));
  const auto named = run(coat(left, right, keys + R"(, "source": "target.ply")"));
  EXPECT_GT(largest_distance(itself->mesh.positions, itself->original), 0.1 * kCoatHeight);
  EXPECT_EQ(itself->mesh.positions, named->mesh.positions);
}

TEST_F(RunCoat, StepsBeforeAndAfterAreThoseOfRunsOneAfterTheOther) {
  const std::string step = coat(kMiddle, kMiddle, R"(, "amplitude": 2)" + kKeep);
  write(relief(kCoatCells, 4.0, kCoatHeight), "target.ply");
  const std::array<std::array<std::string, 2>, 2> orders{{{step, lift()}, {lift(), step}}};
  for (const auto& [first, second] : orders) {
    const auto both = run(first + ", " + second);
    const Mesh before = read("target.ply");
    save_result(*run(first), folder_.path() / "target.ply");
    const auto apart = run(second);
    EXPECT_EQ(both->report.steps.size(), 2U);
    EXPECT_EQ(both->original, before.positions);
    EXPECT_LT(largest_distance(both->mesh.positions, apart->mesh.positions), kTiny);
    EXPECT_GT(largest_distance(both->mesh.positions, before.positions), 0.05);
    write(before, "target.ply");
  }
}

TEST_F(RunCoat, ReportsEachVertexUnlessTheTrianglesChanged) {
  const RunOptions measure{.measure_vertices = true};
  const auto kept = run(coat(kAll, kMiddle, kFrom + kKeep), {}, measure);
  EXPECT_EQ(kept->report.steps[0].vertices.vertices, kept->region.roi);
  write(grid(8, 8), "target.ply");
  const auto remeshed = run(coat(kAll, kMiddle, kFrom), {}, measure);
  EXPECT_GT(remeshed->report.steps[0].coat->vertices_before_remeshing, 0U);
  EXPECT_TRUE(remeshed->report.steps[0].vertices.vertices.empty());
}

TEST_F(RunCoat, ReportSaysWhatTheStepDid) {
  const auto result = run(coat(kAll, kMiddle, kFrom + R"(, "domain": "square")" + kKeep));
  const auto step = nlohmann::json::parse(to_json(result->report)).at("steps").at(0);
  EXPECT_EQ(step.at("op"), "coat");
  EXPECT_EQ(step.at("roi"), result->region.roi.size());
  EXPECT_EQ(step.at("free").get<std::size_t>() + step.at("belt").get<std::size_t>(),
            result->region.roi.size());
  const auto& report = step.at("coat");
  EXPECT_EQ(report.at("source_vertices"), (kCoatCells + 1) * (kCoatCells + 1));
  EXPECT_EQ(report.at("vertices_before_remeshing"), 0);
  EXPECT_EQ(report.at("pins").size(), 4U);
  EXPECT_EQ(report.at("flipped_source"), 0);
  EXPECT_EQ(report.at("flipped_target"), 0);
  for (const char* key : {"warp_steps", "constrained_steps", "mean_scale", "transition_width",
                          "relative_residual", "largest_displacement"}) {
    EXPECT_TRUE(report.at(key).is_number()) << key;
  }
  EXPECT_TRUE(std::binary_search(result->region.roi.begin(), result->region.roi.end(),
                                 report.at("largest_displacement_vertex").get<Index>()));
}

TEST_F(RunCoat, CancelledInAnyStageLeavesNoResult) {
  write(grid(8, 8), "target.ply");
  const std::string step = coat(kAll, kMiddle, kFrom + R"(, "smooth_target": 0.2)");
  std::set<std::string> stages;
  run(step, [&](std::string_view stage, double) {
    stages.emplace(stage);
    return true;
  });
  for (const char* stage : {"source", "peel", "map", "remesh", "frames", "sample", "solve"}) {
    EXPECT_THAT(stages, Contains(stage));
  }
  for (const std::string& stage : stages) {
    EXPECT_THROW(run(step, [&](std::string_view now, double) { return now != stage; }), Cancelled)
        << stage;
  }
}

TEST_F(RunCoat, SaysWhereTheTransitionLetsLittleThrough) {
  const auto warnings = [&](const std::string& width) {
    return run(coat(kAll, kMiddle, kFrom + kKeep + R"(, "transition": {"width": )" + width + "}"))
        ->report.warnings;
  };
  EXPECT_THAT(warnings("0.1"), ::testing::IsEmpty());
  EXPECT_THAT(warnings("0.9"),
              Contains(::testing::HasSubstr("exceeds the depth of the target patch")));
}

TEST_F(RunCoat, PairsSayWhatComesWhere) {
  // The bump in the source's middle goes to vertex `to`, off the target's middle.
  Mesh bump = grid(kCoatCells, kCoatCells);
  const Vector3d top(0.5, 0.5, 0.0);
  for (Vector3d& p : bump.positions) p.z() = 0.05 * std::exp(-(p - top).squaredNorm() / 0.004);
  write(bump, "source.ply");
  write(grid(kCoatCells, kCoatCells), "target.ply");
  constexpr Index kRow = kCoatCells + 1;
  constexpr Index kFromVertex = kRow * (kCoatCells / 2) + kCoatCells / 2;
  constexpr Index kTo = kRow * (kCoatCells / 2 + 4) + kCoatCells / 2 + 2;
  nlohmann::json pins = nlohmann::json::array();
  for (const Index v : corners(kCoatCells)) pins.push_back({v, v});
  const auto result =
      run(coat(kAll, kAll,
               kFrom + kKeep + R"(, "domain": "square", "boundary_pairs": )" + pins.dump() +
                   R"(, "inner_pairs": [[)" + std::to_string(kFromVertex) + ", " +
                   std::to_string(kTo) + "]]"));
  const auto highest =
      std::max_element(result->mesh.positions.begin(), result->mesh.positions.end(),
                       [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
  EXPECT_LT((*highest - result->original[kTo]).norm(), 2.0 / kCoatCells);
}

// A coarse target with the source's fine relief on it: what "auto" remeshes.
class RunCoatOnACoarseTarget : public CoatRuns {
 protected:
  void SetUp() override {
    write(relief(kCoatCells, 4.0, kCoatHeight), "source.ply");
    Mesh mesh = grid(10, 10);
    for (const Vector3d& p : mesh.positions) {
      mesh.edit_attributes().uvs.emplace_back(p.x(), p.y());
      mesh.edit_attributes().vertex_colors.emplace_back(p.x(), p.y(), 0.5, 1.0);
    }
    mesh.edit_attributes().corner_uvs = mesh.face_vertices();
    write(mesh, "target.ply");
    before_ = read("target.ply");
  }
  static std::set<std::array<double, 3>> places(const Positions& positions) {
    std::set<std::array<double, 3>> places;
    for (const Vector3d& p : positions) places.insert({p.x(), p.y(), p.z()});
    return places;
  }
  Mesh before_;
};

TEST_F(RunCoatOnACoarseTarget, PatchGetsFinerAndNothingElseChanges) {
  const auto result = run(coat(kAll, kMiddle, kFrom));
  const StepReport& step = result->report.steps[0];
  EXPECT_GT(step.coat->vertices_before_remeshing, 0U);
  EXPECT_GT(step.roi, 2 * step.coat->vertices_before_remeshing);
  EXPECT_EQ(result->mesh.vertex_count(), result->original.size());
  EXPECT_EQ(result->mesh.vertex_count(), result->mesh.topology().vertex_count());
  EXPECT_EQ(result->mesh.vertex_count() - step.roi,
            before_.vertex_count() - step.coat->vertices_before_remeshing);
  const auto after = places(result->mesh.positions);
  for (const Vector3d& p : before_.positions) {
    if ((p - Vector3d(0.5, 0.5, 0.0)).norm() < 0.3) continue;
    EXPECT_TRUE(after.contains({p.x(), p.y(), p.z()})) << p.transpose();
  }
}

TEST_F(RunCoatOnACoarseTarget, CarriesTextureCoordinatesAndColours) {
  const auto result = run(coat(kAll, kMiddle, kFrom + R"(, "amplitude": 0)"));
  const Mesh& mesh = result->mesh;
  ASSERT_EQ(mesh.attributes().vertex_colors.size(), mesh.vertex_count());
  ASSERT_EQ(mesh.attributes().corner_uvs.size(), mesh.face_vertices().size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(mesh.attributes().vertex_colors[v].x(), mesh.positions[v].x(), 0.01);
    EXPECT_NEAR(mesh.attributes().vertex_colors[v].y(), mesh.positions[v].y(), 0.01);
  }
  for (std::size_t corner = 0; corner < mesh.face_vertices().size(); ++corner) {
    const Vector3d& p = mesh.positions[mesh.face_vertices()[corner]];
    EXPECT_LT((mesh.attributes().uvs[mesh.attributes().corner_uvs[corner]] - p.head<2>()).norm(),
              1e-5);
  }
}

TEST_F(RunCoatOnACoarseTarget, PairsNameVerticesOfTheMeshAsItWasRead) {
  const std::vector<Index> source_corners = corners(kCoatCells);
  const std::vector<Index> target_corners = corners(10);
  nlohmann::json pins = nlohmann::json::array();
  for (std::size_t k = 0; k < 4; ++k) pins.push_back({source_corners[k], target_corners[k]});
  const Index middle = source_corners[2] / 2;
  const auto result = run(coat(kAll, kAll,
                               kFrom + R"(, "domain": "square", "boundary_pairs": )" + pins.dump() +
                                   R"(, "inner_pairs": [[)" + std::to_string(middle) + ", 60]]"));
  const CoatReport& report = *result->report.steps[0].coat;
  EXPECT_GT(report.vertices_before_remeshing, 0U);
  const Mesh source = read("source.ply");
  ASSERT_EQ(report.sources[0].pins.size(), 4U);
  for (const auto& [there, here] : report.sources[0].pins) {
    EXPECT_LT((result->mesh.positions[here] - source.positions[there]).norm(), kTiny);
  }
  EXPECT_TRUE(all_finite(result->mesh.positions));
}

TEST_F(RunCoatOnACoarseTarget, FollowingStepsWorkOnTheFinerMesh) {
  const auto result = run(coat(kAll, kMiddle, kFrom) + R"(, {"op": "deform",
      "roi": {"all": true}, "belt": {"box": {"min": [-1, -1, -1], "max": [0.1, 2, 1]}},
      "handles": [{"region": {"box": {"min": [0.9, -1, -1], "max": [2, 2, 1]}},
                   "move": {"translate": [0, 0, 0.1]}}]})");
  EXPECT_EQ(result->report.steps[1].roi, result->mesh.vertex_count());
  EXPECT_GT(result->mesh.vertex_count(), before_.vertex_count());
  EXPECT_TRUE(all_finite(result->mesh.positions));
}

TEST_F(RunCoatOnACoarseTarget, GivesTheSameBitsEachTime) {
  const std::string step = coat(kAll, kMiddle, kFrom);
  EXPECT_EQ(run(step)->mesh.positions, run(step)->mesh.positions);
}

TEST_F(RunCoat, OnTheDeviceGivesWhatTheProcessorGives) {
  LAPWING_NEEDS_GPU();
  VulkanKernels device(VulkanOptions{.frames_on_device = true});
  for (const char* sampling : {"one_ring", "linear"}) {
    const std::string step =
        coat(kAll, kMiddle, kFrom + kKeep + R"(, "sampling": ")" + sampling + '"');
    const auto there = run(step, device);
    const auto here = run(step);
    EXPECT_GT(largest_distance(here->mesh.positions, here->original), 0.1 * kCoatHeight);
    EXPECT_LT(largest_distance(there->mesh.positions, here->mesh.positions),
              1e-9 * bounds_of(here->original).diagonal());
  }
}

// Drag and settle shaders too.
TEST_F(RunCoat, ADeformStepOnTheDeviceGivesWhatTheProcessorGives) {
  LAPWING_NEEDS_GPU();
  VulkanKernels device(VulkanOptions{.frames_on_device = true});
  EXPECT_TRUE(device.device().frames);
  for (const std::string settle : {"true", "false"}) {
    const std::string step = R"({"op": "deform", "roi": {"all": true},
      "belt": {"box": {"min": [-1, -1, -1], "max": [0.2, 2, 1]}},
      "handles": [{"region": {"box": {"min": [0.9, -1, -1], "max": [2, 2, 1]}},
                   "move": {"translate": [-0.2, 0, 0.3],
                            "rotate": {"axis": [0, 1, 0], "degrees": -50}}}], "settle": )" +
                             settle + "}";
    const auto there = run(step, device);
    const auto here = run(step);
    EXPECT_TRUE(there->report.steps[0].deform->certificate.settled);
    EXPECT_GT(largest_distance(here->mesh.positions, here->original), 0.1);
    EXPECT_LT(largest_distance(there->mesh.positions, here->mesh.positions),
              1e-9 * bounds_of(here->original).diagonal());
  }
}

class RunPeel : public CoatRuns {
 protected:
  void SetUp() override { write(relief(20, 4.0, 0.01), "target.ply"); }

  static std::string step(const std::string& region) {
    return R"({"op": "peel", "region": )" + region + R"(, "detail_size": 0.5})";
  }
};

TEST_F(RunPeel, IsWhatPeelMakesBitForBit) {
  const Mesh mesh = read("target.ply");
  const Peeled peeled = peel(mesh, {{AllVertices{}}, 0.5});
  const auto result = run(step(kAll));
  EXPECT_EQ(result->mesh.positions, peeled.mesh.positions);
  EXPECT_NE(result->mesh.positions, mesh.positions);
  const StepReport& report = result->report.steps.at(0);
  EXPECT_EQ(report.op, "peel");
  EXPECT_EQ(report.free, peeled.moved.size());
  EXPECT_EQ(report.roi, mesh.vertex_count());
  EXPECT_EQ(report.peel->largest_coating, peeled.largest_coating);
  const auto json = nlohmann::json::parse(to_json(result->report));
  EXPECT_EQ(json["steps"][0]["peel"]["mean_coating"], peeled.mean_coating);
}

TEST_F(RunPeel, GoesOnFromTheStepBefore) {
  const Peeled once = peel(read("target.ply"), {{AllVertices{}}, 0.5});
  const Peeled twice = peel(once.mesh, {{AllVertices{}}, 0.5});
  EXPECT_EQ(run(step(kAll) + ", " + step(kAll))->mesh.positions, twice.mesh.positions);
}

TEST_F(RunPeel, WarnsWhereNothingCanComeOff) {
  const auto result = run(step(R"({"vertices": [5]})"));
  EXPECT_EQ(result->mesh.positions, read("target.ply").positions);
  EXPECT_THAT(result->report.warnings, ElementsAre(HasSubstr("no detail was removed")));
}

}  // namespace
}  // namespace lapwing::test
