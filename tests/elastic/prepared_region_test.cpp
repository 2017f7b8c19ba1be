#include "lapwing/elastic/prepared_region.h"

#include <array>
#include <functional>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/dragged.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

struct Edit {
  EditRegion region;
  DeformOptions options;
};

// The vertices of `mesh` between two heights.
VertexSet slab(const Mesh& mesh, double from_z, double to_z) {
  VertexSet vertices;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double z = mesh.positions[v].z();
    if (z >= from_z && z < to_z) vertices.push_back(v);
  }
  return vertices;
}

// The factorization of this mesh has several fronts, so that a change leaves some of them
// unchanged.
Mesh tube() {
  return rippled_cylinder(24, 61);
}

Edit first_edit(const Mesh& mesh) {
  Edit edit;
  edit.region = {slab(mesh, 0.3, 7.0), slab(mesh, 0.3, 0.8), {slab(mesh, 5.4, 7.0)}};
  return edit;
}

// Returns an edit without settling, for which all systems are prepared at once.
Edit linear_edit(const Mesh& mesh) {
  Edit edit = first_edit(mesh);
  edit.options.settle.reset();
  return edit;
}

std::vector<Affine3d> motions_for(const Edit& edit) {
  std::vector<Affine3d> motions(edit.region.handles.size());
  for (std::size_t h = 0; h < motions.size(); ++h) {
    motions[h] = Eigen::Translation3d(0.4, -0.1 * static_cast<double>(h), -0.2) *
                 Eigen::AngleAxisd(0.3, Vector3d::UnitY());
  }
  return motions;
}

std::vector<std::string> stages_of(const StageTimings& timings) {
  std::vector<std::string> names;
  for (const auto& [name, ms] : timings.stages()) names.push_back(name);
  return names;
}

class PreparedTube : public ::testing::Test {
 protected:
  DeformSolver prepare(const Edit& edit, const Progress& progress = {}) {
    return {prepared_, mesh_.positions, edit.region, edit.options, kernels_, progress};
  }
  // Returns the result of a new DeformSolver, which reuses no prepared data.
  Positions expected(const Edit& edit) {
    const DeformSolver alone(mesh_.positions, topology_, edit.region, edit.options, kernels_);
    return alone.solve(motions_for(edit)).positions;
  }
  Positions solved(const DeformSolver& deformer, const Edit& edit) {
    return deformer.solve(motions_for(edit)).positions;
  }

  Edit with_other_handle(Edit edit) const {
    edit.region.handles[0] = slab(mesh_, 3.0, 3.5);
    return edit;
  }

  Mesh mesh_ = tube();
  Topology topology_ = mesh_.topology();
  CpuKernels kernels_;
  PreparedRegion prepared_{topology_};
};

struct Change {
  const char* name;
  std::function<void(Edit&, const Mesh&)> make;
  std::vector<std::string> stages;  // of the preparation after it
};

const std::vector<std::string> kFactored{"constraints", "laplacian", "factor", "shares"};
const std::vector<std::string> kAssembled{"constraints",   "laplacian", "assemble",
                                          "normal_matrix", "factor",    "shares"};
const std::vector<std::string> kSameFactor{"constraints", "laplacian", "shares"};
const std::vector<std::string> kSettles{"constraints", "laplacian", "shares"};

class SameRoi : public PreparedTube, public ::testing::WithParamInterface<Change> {};

TEST_P(SameRoi, OrdersAndAnalyzesNothingAnewAndGivesTheBitsOfAFullPreparation) {
  Edit edit = linear_edit(mesh_);
  prepare(edit);
  GetParam().make(edit, mesh_);
  const DeformSolver next = prepare(edit);
  EXPECT_EQ(stages_of(next.timings()), GetParam().stages);
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_P(SameRoi, GivesTheBitsOfAFullPreparationSettled) {
  Edit edit = first_edit(mesh_);
  prepare(edit).response();
  GetParam().make(edit, mesh_);
  const DeformSolver next = prepare(edit);
  EXPECT_EQ(stages_of(next.timings()), kSettles);
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
  const DeformSolver alone(mesh_.positions, topology_, edit.region, edit.options, kernels_);
  EXPECT_TRUE(same_bits(test::dragged(next.response(), motions_for(edit)),
                        test::dragged(alone.response(), motions_for(edit))));
}

INSTANTIATE_TEST_SUITE_P(
    Changes, SameRoi,
    ::testing::Values(
        Change{"Nothing", [](Edit&, const Mesh&) {}, kSameFactor},
        Change{"Handle",
               [](Edit& edit, const Mesh& mesh) { edit.region.handles[0] = slab(mesh, 3.0, 3.5); },
               kFactored},
        Change{"SeveralHandles",
               [](Edit& edit, const Mesh& mesh) {
                 edit.region.handles.push_back(slab(mesh, 2.0, 2.5));
                 edit.region.handles.push_back(slab(mesh, 3.0, 3.5));
               },
               kFactored},
        Change{"Belt",
               [](Edit& edit, const Mesh& mesh) { edit.region.belt = slab(mesh, 0.3, 1.7); },
               kFactored},
        Change{"Weight", [](Edit& edit, const Mesh&) { edit.options.constraint_weight = 3.0; },
               kFactored},
        Change{"Target",
               [](Edit& edit, const Mesh& mesh) {
                 const Index v = slab(mesh, 3.0, 3.5).front();
                 edit.region.targets.push_back(
                     {{v, v, v}, {1.0, 0.0, 0.0}, mesh.positions[v] + Vector3d(0.1, 0.2, 0.0)});
               },
               kAssembled},
        Change{"LaplacianWeights",
               [](Edit& edit, const Mesh&) { edit.options.weights = LaplacianWeights::uniform; },
               kAssembled},
        Change{"DetailLength", [](Edit& edit, const Mesh&) { edit.options.detail_length = 0.1; },
               kAssembled},
        Change{"Settling", [](Edit& edit, const Mesh&) { edit.options.settle = SettleOptions(); },
               kSettles}),
    [](const auto& test) { return test.param.name; });

TEST_F(PreparedTube, PositionsMayChangeToo) {
  Edit edit = linear_edit(mesh_);
  mesh_.positions = solved(prepare(edit), edit);
  const DeformSolver next = prepare(edit);
  EXPECT_EQ(stages_of(next.timings()), kAssembled);
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_F(PreparedTube, PreviewSharesWhatIsKept) {
  Edit edit = first_edit(mesh_);
  prepare(edit);
  edit.region.handles[0] = slab(mesh_, 3.0, 3.5);
  const DragPreview preview(prepared_, mesh_.positions, edit.region, edit.options);
  EXPECT_THAT(stages_of(preview.timings()), ElementsAre("constraints", "laplacian", "preview"));
  const DragPreview alone(mesh_.positions, topology_, edit.region, edit.options);
  EXPECT_TRUE(same_bits(test::dragged(preview.response(), motions_for(edit)),
                        test::dragged(alone.response(), motions_for(edit))));
  const DeformSolver exact(preview, kernels_);
  EXPECT_EQ(stages_of(exact.timings()), kSettles);
  EXPECT_TRUE(same_bits(solved(exact, edit), expected(edit)));
}

TEST_F(PreparedTube, ExactOneFollowsItsPreviewThroughAnother) {
  const Edit edit = first_edit(mesh_);
  const Edit other = with_other_handle(edit);
  const DragPreview preview(prepared_, mesh_.positions, edit.region, edit.options);
  const DragPreview after(prepared_, mesh_.positions, other.region, other.options);
  EXPECT_TRUE(same_bits(solved(DeformSolver(preview, kernels_), edit), expected(edit)));
}

TEST_F(PreparedTube, AnotherRoiIsPreparedInFull) {
  Edit edit = first_edit(mesh_);
  prepare(edit);
  edit.region.roi = slab(mesh_, 0.2, 7.0);
  const DeformSolver next = prepare(edit);
  EXPECT_THAT(stages_of(next.timings()), ElementsAre("pattern", "order", "laplacian", "shares"));
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_F(PreparedTube, HardConstraintsOnAnotherHandleArePreparedInFull) {
  Edit edit = first_edit(mesh_);
  edit.options.hard = true;
  prepare(edit);
  edit.options.weights = LaplacianWeights::uniform;
  EXPECT_THAT(stages_of(prepare(edit).timings()), Not(Contains("order"))) << "the same unknowns";
  edit.region.handles[0] = slab(mesh_, 3.0, 3.5);
  const DeformSolver next = prepare(edit);
  EXPECT_THAT(stages_of(next.timings()), Contains("order"));
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_F(PreparedTube, LooseVertexInAHandleIsAnotherUnknown) {
  mesh_.positions.emplace_back(7, 7, 7);
  mesh_.edit_faces();
  const Topology& topology = mesh_.topology();
  PreparedRegion prepared(topology);
  Edit edit = first_edit(mesh_);
  const auto loose = static_cast<Index>(mesh_.vertex_count() - 1);
  edit.region.roi.push_back(loose);
  const DeformSolver first(prepared, mesh_.positions, edit.region, edit.options, kernels_);
  edit.region.handles[0].push_back(loose);
  const DeformSolver next(prepared, mesh_.positions, edit.region, edit.options, kernels_);
  EXPECT_THAT(stages_of(next.timings()), Contains("order"));
  EXPECT_LT((solved(next, edit)[loose] - motions_for(edit)[0] * Vector3d(7, 7, 7)).norm(), 1e-9);
}

TEST_F(PreparedTube, CancelledPreparationLosesNothing) {
  const Edit first = linear_edit(mesh_);
  Edit other = with_other_handle(first);
  other.options.weights = LaplacianWeights::uniform;
  prepare(first);
  for (const std::string& stop : kAssembled) {
    EXPECT_THROW(prepare(other, [&](std::string_view stage, double) { return stage != stop; }),
                 Cancelled)
        << stop;
    const DeformSolver next = prepare(first);
    EXPECT_THAT(stages_of(next.timings()), Not(Contains("order"))) << stop;
    EXPECT_THAT(stages_of(next.timings()), Not(Contains("analyze"))) << stop;
    EXPECT_TRUE(same_bits(solved(next, first), expected(first))) << stop;
  }
}

TEST_F(PreparedTube, FirstPreparationCancelledKeepsWhatItFound) {
  const Edit edit = linear_edit(mesh_);
  EXPECT_THROW(prepare(edit, [](std::string_view stage, double) { return stage != "factor"; }),
               Cancelled);
  const DeformSolver next = prepare(edit);
  EXPECT_EQ(stages_of(next.timings()), kFactored);
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_F(PreparedTube, FailedPreparationLosesNothing) {
  Edit edit = first_edit(mesh_);
  edit.region.roi = slab(mesh_, 0.0, 7.0);  // which nothing holds but belt and handle
  prepare(edit);
  Edit unheld = edit;
  unheld.region.belt.clear();
  unheld.region.handle_weights = {1e-200};  // whose square is 0
  EXPECT_THROW(prepare(unheld), SolverError);
  Edit unanchored = edit;
  unanchored.region.belt.clear();
  unanchored.region.handles[0].resize(2);
  EXPECT_THROW(prepare(unanchored), InputError);
  const DeformSolver next = prepare(edit);
  EXPECT_EQ(stages_of(next.timings()), kSettles);
  EXPECT_TRUE(same_bits(solved(next, edit), expected(edit)));
}

TEST_F(PreparedTube, MemoryThatIsThereIsNotAskedForAgain) {
  Edit edit = first_edit(mesh_);
  prepare(edit).response();
  edit.options.memory_limit_bytes = 1000;
  const DeformSolver again = prepare(edit);
  EXPECT_EQ(again.response()->why_not_exact(), "");
}

TEST_F(PreparedTube, RegionThatDidNotFitIsExactOnceItMayBe) {
  Edit edit = first_edit(mesh_);
  edit.options.memory_limit_bytes = 1000;
  const DeformSolver without = prepare(edit);
  EXPECT_NE(without.response()->why_not_exact(), "");
  const DeformSolver again = prepare(edit);
  EXPECT_EQ(stages_of(again.timings()), kSettles);
  edit.options.memory_limit_bytes = 0;
  const DeformSolver exact = prepare(edit);
  EXPECT_EQ(exact.response()->why_not_exact(), "");
  EXPECT_TRUE(same_bits(solved(exact, edit), expected(edit)));
  EXPECT_LT((solved(without, edit)[500] - solved(exact, edit)[500]).norm(), 1e-2);
}

TEST_F(PreparedTube, ResponseAskedForBeforeChangesNoBitOfWhatSettles) {
  const std::array far{
      Affine3d(Eigen::Translation3d(1.8, 0.0, 0.0) * Eigen::AngleAxisd(0.5, Vector3d::UnitY()))};
  for (const bool turns_freely : {false, true}) {
    Edit edit = first_edit(mesh_);
    edit.region.turns_freely = turns_freely;
    const DeformSolver asked(mesh_.positions, topology_, edit.region, edit.options, kernels_);
    asked.response();
    const DeformSolver alone(mesh_.positions, topology_, edit.region, edit.options, kernels_);
    EXPECT_TRUE(same_bits(asked.solve(far).positions, alone.solve(far).positions)) << turns_freely;
  }
}

TEST_F(PreparedTube, EarlierSolverIsDraggedWhileTheNextIsPrepared) {
  const Edit first = first_edit(mesh_);
  Edit other = with_other_handle(first);
  const DeformSolver earlier = prepare(first);
  const Positions before = test::dragged(earlier.response(), motions_for(first));
  std::unique_ptr<DeformSolver> next;
  CpuKernels own_kernels;
  std::thread preparing([&] {
    next = std::make_unique<DeformSolver>(prepared_, mesh_.positions, other.region, other.options,
                                          own_kernels);
  });
  for (int frame = 0; frame < 50; ++frame) {
    EXPECT_TRUE(same_bits(test::dragged(earlier.response(), motions_for(first)), before));
  }
  preparing.join();
  EXPECT_TRUE(same_bits(solved(*next, other), expected(other)));
}

TEST_F(PreparedTube, EarlierSolverFollowsADragOnThroughAnotherPreparation) {
  const Edit first = first_edit(mesh_);
  Edit other = with_other_handle(first);
  other.options.detail_length = 0.1;
  const auto shared = [](DeformSolver solver) {
    return std::make_shared<const DeformSolver>(std::move(solver));
  };
  DragSession alone(shared({mesh_.positions, topology_, first.region, first.options, kernels_}));
  DragSession earlier(shared(prepare(first)));
  std::optional<DeformSolver> next;
  for (int frame = 1; frame <= 3; ++frame) {
    const std::array motions{
        Affine3d(Eigen::AngleAxisd(0.1 * frame, Vector3d(1, 2, 3).normalized()))};
    EXPECT_TRUE(same_bits(earlier.step(motions).displacement, alone.step(motions).displacement))
        << "frame " << frame;
    next.emplace(prepare(other));
  }
}

TEST_F(PreparedTube, SolvesOnSeveralThreadsAtOnce) {
  const Edit edit = first_edit(mesh_);
  const DeformSolver solver = prepare(edit);
  const Positions alone = solved(solver, edit);
  std::array<Positions, 4> results;
  std::vector<std::thread> threads;
  for (Positions& result : results) {
    threads.emplace_back([&] { result = solved(solver, edit); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Positions& result : results) EXPECT_TRUE(same_bits(result, alone));
}

TEST_F(PreparedTube, SolversOutliveIt) {
  const Edit edit = first_edit(mesh_);
  std::unique_ptr<DeformSolver> deformer;
  {
    PreparedRegion prepared(topology_);
    deformer = std::make_unique<DeformSolver>(prepared, mesh_.positions, edit.region, edit.options,
                                              kernels_);
  }
  EXPECT_TRUE(same_bits(solved(*deformer, edit), expected(edit)));
}

}  // namespace
}  // namespace lapwing
