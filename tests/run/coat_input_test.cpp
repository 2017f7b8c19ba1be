// Patches that are no patches, meshes that are broken: a coat step answers in words, or rightly.
#include <limits>

#include <gmock/gmock.h>

#include "lapwing/base/errors.h"
#include "run/coat_runs.h"
#include "support/bent_tube.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr Index kInputCells = 16;
constexpr double kInputHeight = 0.01;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::string kAtSource = "test: /steps/0/source_patch";
const std::string kAtTarget = "test: /steps/0/target_patch";
const std::string kRing = R"({"minus": [{"disk": {"near": [0.5, 0.5, 0], "radius": 0.45}},
                                        {"disk": {"near": [0.5, 0.5, 0], "radius": 0.15}}]})";

// Which of the two meshes is broken.
enum class Side { source, target };

class CoatInput : public CoatRuns {
 protected:
  void SetUp() override {
    write(relief(kInputCells, 3.0, kInputHeight), "source.ply");
    write(grid(kInputCells, kInputCells), "target.ply");
  }
  void write(const Mesh& mesh, const std::string& name) const { CoatRuns::write(mesh, name); }
  void write(const Mesh& mesh, Side side) const {
    write(mesh, side == Side::source ? "source.ply" : "target.ply");
  }
  static Mesh sound(Side side) {
    return side == Side::source ? relief(kInputCells, 3.0, kInputHeight)
                                : grid(kInputCells, kInputCells);
  }
  // The result of coating is finite, moves the patch and no more than sensible.
  void expect_a_sound_result(const std::string& step) {
    const auto result = run(step);
    EXPECT_TRUE(all_finite(result->mesh.positions));
    const double moved = result->report.steps[0].coat->largest_displacement;
    EXPECT_GT(moved, 0.1 * kInputHeight);
    EXPECT_LT(moved, 10.0 * kInputHeight);
  }
};

TEST_F(CoatInput, PatchWithAHoleIsRefusedAndADiskOffered) {
  EXPECT_THAT(refusal(coat(kRing, kMiddle, kFrom)),
              AllOf(StartsWith(kAtSource), HasSubstr("not a disk"), HasSubstr("\"disk_in\"")));
  EXPECT_THAT(refusal(coat(kMiddle, kRing, kFrom)),
              AllOf(StartsWith(kAtTarget), HasSubstr("not a disk"), HasSubstr("\"disk_in\"")));
}

TEST_F(CoatInput, PatchFromOneBoundaryOfTheMeshToTheOtherIsRefusedWhereItIsNoDisk) {
  write(cylinder(24, 20, 0.5, 2.0), Side::target);
  EXPECT_THAT(refusal(coat(kAll, kAll, kFrom)),
              AllOf(StartsWith(kAtTarget), HasSubstr("not a disk")));
  expect_a_sound_result(
      coat(kAll, R"({"box": {"min": [0, -1, -1], "max": [1, 1, 3]}})", kFrom + kKeep));
}

TEST_F(CoatInput, ClosedMeshIsNoPatch) {
  write(icosphere(3), Side::target);
  EXPECT_THAT(refusal(coat(kAll, kAll, kFrom)),
              AllOf(StartsWith(kAtTarget), HasSubstr("not a disk")));
}

TEST_F(CoatInput, PairThatFitsNoPatchIsNamed) {
  const auto with_pair = [&](const std::string& list, const std::string& pair) {
    return refusal(coat(kMiddle, kMiddle, kFrom + ", \"" + list + "\": [" + pair + "]"));
  };
  const std::string place = "test: /steps/0/boundary_pairs/0: ";
  EXPECT_THAT(with_pair("boundary_pairs", "[0, 74]"),
              AllOf(StartsWith(place), HasSubstr("vertex 0 is not in the source patch")));
  EXPECT_THAT(with_pair("boundary_pairs", "[4000000, 74]"),
              AllOf(StartsWith(place), HasSubstr("vertex 4000000 is not in the source patch")));
  EXPECT_THAT(with_pair("inner_pairs", "[144, 4000000]"),
              AllOf(StartsWith("test: /steps/0/inner_pairs/0: "),
                    HasSubstr("vertex 4000000 is not in the target patch")));
}

TEST_F(CoatInput, InnerPairsThatContradictAreNamed) {
  EXPECT_THAT(
      refusal(coat(kMiddle, kMiddle, kFrom + R"(, "inner_pairs": [[144, 144], [145, 144]])")),
      AllOf(StartsWith("test: /steps/0/inner_pairs"), HasSubstr("144")));
  EXPECT_THAT(
      refusal(coat(kMiddle, kMiddle, kFrom + R"(, "inner_pairs": [[144, 143], [144, 145]])")),
      AllOf(StartsWith("test: /steps/0/inner_pairs/1: "), HasSubstr("vertex 144")));
}

TEST_F(CoatInput, PatchWithoutAreaIsRefused) {
  for (const Side side : {Side::source, Side::target}) {
    const std::string start = side == Side::source ? "test: /steps/0: the source patch: "
                                                   : "test: /steps/0: the target patch: ";
    Mesh point = sound(side);
    for (Vector3d& p : point.positions) p = Vector3d(1.0, 2.0, 3.0);
    write(point, side);
    EXPECT_THAT(refusal(coat(kAll, kAll, kFrom)), AllOf(StartsWith(start), HasSubstr("zero area")));
    Mesh line = sound(side);
    for (Vector3d& p : line.positions) p = Vector3d(p.x(), 0.0, 0.0);
    write(line, side);
    EXPECT_THAT(refusal(coat(kAll, kAll, kFrom)), AllOf(StartsWith(start), HasSubstr("zero area")));
    write(sound(side), side);
  }
}

TEST_F(CoatInput, TrianglesWithoutAreaInsideAPatchDoNoHarm) {
  for (const Side side : {Side::source, Side::target}) {
    Mesh mesh = sound(side);
    // One on its neighbour, one on the line between two: both kinds.
    mesh.positions[144] = mesh.positions[145];
    mesh.positions[110] = 0.5 * (mesh.positions[109] + mesh.positions[92]);
    write(mesh, side);
    expect_a_sound_result(coat(kMiddle, kMiddle, kFrom + kKeep));
    expect_a_sound_result(coat(kMiddle, kMiddle, kFrom));
    write(sound(side), side);
  }
}

TEST_F(CoatInput, VertexThatIsNotFiniteIsNamedInAPatchAndDoesNoHarmBesideIt) {
  for (const Side side : {Side::source, Side::target}) {
    Mesh mesh = sound(side);
    mesh.positions[145].y() = kNan;
    write(mesh, side);
    EXPECT_THAT(refusal(coat(kAll, kAll, kFrom)),
                AllOf(StartsWith(side == Side::source ? kAtSource : kAtTarget),
                      HasSubstr("vertex 145"), HasSubstr("finite")));
    // A corner, outside the patch but well within the detail size of it.
    mesh = sound(side);
    mesh.positions[0] = Vector3d(kNan, kNan, kNan);
    write(mesh, side);
    const auto result = run(coat(kMiddle, kMiddle, kFrom + R"(, "smooth_target": 0.3)"));
    for (const Index v : result->region.roi) EXPECT_TRUE(result->mesh.positions[v].allFinite());
    EXPECT_GT(result->report.steps[0].coat->largest_displacement, 0.1 * kInputHeight);
    write(sound(side), side);
  }
}

TEST_F(CoatInput, VertexThatIsNotFiniteRightBesideAPatchDoesNoHarm) {
  // The neighbour of a border vertex: rings of the border reach it.
  const std::string box = R"({"box": {"min": [0.24, 0.24, -1], "max": [0.76, 0.76, 1]}})";
  for (const Side side : {Side::source, Side::target}) {
    Mesh mesh = sound(side);
    mesh.positions[3 * (kInputCells + 1) + 8] = Vector3d(kNan, kNan, kNan);
    write(mesh, side);
    const auto result = run(coat(box, box, kFrom));
    for (const Index v : result->region.roi) EXPECT_TRUE(result->mesh.positions[v].allFinite());
    EXPECT_GT(result->report.steps[0].coat->largest_displacement, 0.1 * kInputHeight);
    write(sound(side), side);
  }
}

TEST_F(CoatInput, SourceWithOneInnerVertexGivesAHillWithoutSpikes) {
  Mesh tent = grid(2, 2);
  tent.positions[4].z() = 0.1;
  write(tent, Side::source);
  constexpr Index kFine = 60;
  write(grid(kFine, kFine), Side::target);
  for (const char* sampling : {"one_ring", "linear"}) {
    const auto result =
        run(coat(kAll, kAll,
                 kFrom + R"(, "transition": {"width": 0.1}, "sampling": ")" + sampling + '"', 3.0));
    const Positions& p = result->mesh.positions;
    ASSERT_EQ(p.size(), (kFine + 1) * (kFine + 1));
    const double height = result->report.steps[0].coat->largest_displacement;
    EXPECT_GT(height, 0.01);
    EXPECT_LT(height, 0.2);
    // Nowhere bent more than the tent is at its top.
    for (Index v = 0; v < p.size(); ++v) {
      const auto ring = result->mesh.topology().rings[v];
      if (on_mesh_boundary(v, result->mesh.topology())) continue;
      Vector3d mean = Vector3d::Zero();
      for (const Index j : ring) mean += p[j] / static_cast<double>(ring.size());
      EXPECT_LT((p[v] - mean).norm(), 0.06 * height) << v;
    }
  }
}

TEST_F(CoatInput, SourceWithoutInnerVerticesHasNoCoatingToGive) {
  write(grid(1, 1), Side::source);
  const auto result = run(coat(kAll, kMiddle, kFrom));
  EXPECT_LT(result->report.steps[0].coat->largest_displacement, 1e-9);
}

TEST_F(CoatInput, TargetWithoutInnerVerticesIsRefused) {
  const std::string flake = R"({"vertices": [144, 145, 161, 162]})";
  EXPECT_THAT(refusal(coat(kAll, flake, kFrom + kKeep)),
              AllOf(StartsWith(kAtTarget), HasSubstr("no inner vertices")));
}

TEST_F(CoatInput, SourceThatIsMissingIsNamed) {
  EXPECT_THAT(refusal<IoError>(coat(kAll, kAll, R"(, "source": "nothing.ply")")),
              HasSubstr("nothing.ply"));
}

TEST_F(CoatInput, RegionOfAVertexThatTheMeshDoesNotHaveIsNamedByItsPlace) {
  EXPECT_THAT(refusal(coat(R"({"vertices": [3, 999999]})", kAll, kFrom)),
              AllOf(StartsWith(kAtSource), HasSubstr("999999")));
}

TEST_F(CoatInput, SmallerDetailThanAnyEdgeLeavesNextToNothing) {
  const auto result = run(coat(kAll, kMiddle, kFrom + kKeep, 1e-5));
  EXPECT_TRUE(all_finite(result->mesh.positions));
  EXPECT_LT(result->report.steps[0].coat->largest_displacement, kInputHeight);
}

TEST_F(CoatInput, CoatingOnAHornIsHeldToASensibleSizeWithANote) {
  // A disk whose middle is drawn out to a needle: its tip is laid on next to nothing.
  Mesh horn = grid(kInputCells, kInputCells);
  for (Vector3d& p : horn.positions) {
    const double x = std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) / 0.5;
    const double share = std::clamp(2.5 * x, 0.05, 1.0);
    p = Vector3d(0.5 + share * (p.x() - 0.5), 0.5 + share * (p.y() - 0.5), 8.0 * (1.0 - x));
  }
  write(horn, Side::target);
  const auto result = run(coat(kAll, kAll, kFrom + kKeep));
  const StepReport& step = result->report.steps[0];
  EXPECT_LT(step.coat->largest_displacement, 30.0 * kInputHeight);
  EXPECT_THAT(result->report.warnings, ::testing::Contains(HasSubstr("horns")));
  const auto scaled = run(coat(kAll, kAll, kFrom + kKeep + R"(, "scale": 1)"));
  EXPECT_THAT(scaled->report.warnings, Not(::testing::Contains(HasSubstr("horns"))));
}

TEST_F(CoatInput, AmplitudeBeyondAllNumbersIsRefused) {
  EXPECT_THAT(refusal<SolverError>(
                  coat(kAll, kMiddle, kFrom + kKeep + R"(, "scale": 1e200, "amplitude": 1e200)")),
              AllOf(StartsWith("test: /steps/0: "), HasSubstr("non-finite")));
}

TEST_F(CoatInput, DetailLargerThanTheMeshIsFinite) {
  const auto result = run(coat(kAll, kMiddle, kFrom + kKeep, 1e6));
  EXPECT_TRUE(all_finite(result->mesh.positions));
}

}  // namespace
}  // namespace lapwing::test
