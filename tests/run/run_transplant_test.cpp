#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/transition.h"
#include "lapwing/run/run_report.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/transplant_runs.h"
#include "support/gpu.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

// A sphere with hills on it.
Mesh hilly_sphere(int subdivisions) {
  Mesh mesh = icosphere(subdivisions);
  for (Vector3d& p : mesh.positions) {
    p *= 1.0 + 0.02 * std::sin(9.0 * p.x()) * std::sin(8.0 * p.y() + 1.0) * std::sin(7.0 * p.z());
  }
  return mesh;
}

Eigen::Affine3d some_similarity() {
  return Eigen::Translation3d(3.0, -2.0, 5.0) *
         Eigen::AngleAxisd(2.0, Vector3d(1.0, 2.0, -0.5).normalized()) * Eigen::Scaling(2.5);
}

// The vertices of a region of `mesh` by their numbers, wherever the mesh is moved to.
std::string list_of(const Mesh& mesh, const RegionSpec& region) {
  return nlohmann::json{{"vertices", resolve(region, mesh)}}.dump();
}

// From the unit sphere.
double largest_radius_error(const Positions& positions) {
  double largest = 0.0;
  for (const Vector3d& p : positions) largest = std::max(largest, std::abs(p.norm() - 1.0));
  return largest;
}

class RunTransplant : public TransplantRuns {};

TEST_F(RunTransplant, PutsAPartBackWhereItWasAndReturnsTheSurface) {
  const Mesh host = hilly_sphere(4);
  write(host, "host.ply");
  for (const std::string sampling : {"one_ring", "linear"}) {
    for (const std::string weights : {"uniform", "cotangent"}) {
      const auto result =
          run(transplant(R"({"region": )" + kPole + "}", kPole,
                         R"(, "place": {"translate": [0, 0, 0]}, "transition": {"width": 0.2},
                             "sampling": ")" +
                             sampling + R"(", "weights": ")" + weights + '"'));
      const TransplantReport& report = *result->report.steps[0].transplant;
      EXPECT_EQ(report.welded, report.part_loop);
      EXPECT_EQ(report.flipped, 0U);
      EXPECT_GT(result->report.steps[0].free, 100U);
      EXPECT_LT(report.largest_displacement, 1e-6 * diagonal_of(host)) << sampling << weights;
      expect_whole(*result);
    }
  }
}

TEST_F(RunTransplant, FindsWhereAPartWasCutFromByItself) {
  // No hole of another shape fits as well.
  const std::string region = R"({"box": {"min": [-0.5, -0.3, 0.5], "max": [0.6, 0.45, 2]}})";
  const Mesh host = hilly_sphere(4);
  write(host, "host.ply");
  Mesh moved = host;
  transform(moved, some_similarity().inverse());
  write(moved, "moved.ply");
  const std::string listed = list_of(host, RegionSpec{Box{{-0.5, -0.3, 0.5}, {0.6, 0.45, 2.0}}});
  const auto result = run(
      transplant(from_region("moved.ply", listed), region, R"(, "transition": {"width": 0.1})"));
  EXPECT_LT(result->report.steps[0].transplant->largest_displacement, 1e-6 * diagonal_of(host));
  expect_whole(*result);
}

TEST_F(RunTransplant, AnotherTriangulationOfTheSameSurfaceComesOutAsThatSurface) {
  const Mesh host = icosphere(4);
  write(host, "host.ply");
  Mesh other = icosphere(4);
  transform(other, Eigen::Affine3d(Eigen::AngleAxisd(0.7, Vector3d(0.2, 0.5, 1.0).normalized())));
  write(other, "other.ply");
  const double edge = mean_edge_length(host.topology().rings, host.positions);
  for (const std::string sampling : {"one_ring", "linear"}) {
    // With a gap around of about an edge, and of half of one. Loops that cross each other many
    // times make a strip that is folded, and come out twice as far off.
    const std::map<std::string, double> tolerances{{"0.44", 0.1}, {"0.47", 0.1}, {"0.5", 0.2}};
    for (const auto& [radius, tolerance] : tolerances) {
      const std::string part = R"({"disk": {"near": [0, 0, 1], "radius": )" + radius + "}}";
      const auto result = run(transplant(from_region("other.ply", part), kPole,
                                         R"(, "place": {"translate": [0, 0, 0]},
                                             "transition": {"width": 0.2}, "sampling": ")" +
                                             sampling + '"'));
      EXPECT_LT(largest_radius_error(result->mesh.positions), tolerance * edge)
          << sampling << radius;
      expect_whole(*result);
    }
  }
}

// The same vertices, every so many edges turned to the other diagonal of their two triangles.
Mesh with_edges_flipped(const Mesh& mesh, std::size_t every) {
  std::vector<Triangle> triangles = mesh.topology().triangles;
  const Adjacency edges = sides_by_edge(triangles, mesh.vertex_count());
  std::vector<char> done(triangles.size(), 0);
  for (std::size_t e = 0; e < edges.row_count(); e += every) {
    const Index left = edges[e][0] / 3;
    const Index right = edges[e][1] / 3;
    if (done[left] != 0 || done[right] != 0) continue;
    done[left] = done[right] = 1;
    const auto corner = [&](std::size_t side, Index step) {
      return triangles[edges[e][side] / 3][(edges[e][side] + step) % 3];
    };
    const std::array<Index, 4> quad{corner(0, 0), corner(1, 2), corner(0, 1), corner(0, 2)};
    triangles[left] = {quad[3], quad[0], quad[1]};
    triangles[right] = {quad[1], quad[2], quad[3]};
  }
  Mesh result;
  result.positions = mesh.positions;
  for (const Triangle& t : triangles) result.add_face(t);
  return result;
}

TEST_F(RunTransplant, AnotherTriangulationOfTheHolesBorderComesOutAsTheSurface) {
  const Mesh host = icosphere(4);
  write(host, "host.ply");
  const double edge = mean_edge_length(host.topology().rings, host.positions);
  for (const std::size_t every :
       {std::size_t{6}, std::size_t{7}, std::size_t{8}, std::size_t{9}, std::size_t{11},
        std::size_t{13}, std::size_t{17}, std::size_t{25}}) {
    write(with_edges_flipped(host, every), "other.ply");
    const auto result = run(transplant(from_region("other.ply", kPole), kPole,
                                       R"(, "place": {"translate": [0, 0, 0]},
                                           "transition": {"width": 0.2})"));
    EXPECT_LT(largest_radius_error(result->mesh.positions), 0.1 * edge) << every;
    expect_whole(*result);
  }
}

TEST_F(RunTransplant, LeavesWhatIsFartherAwayBitForBit) {
  const Mesh host = hilly_sphere(4);
  write(host, "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  const auto result = run(transplant(from_file("finger.ply"), kPole));
  const std::vector<char> moved = vertex_mask(result->mesh.vertex_count(), result->region.roi);
  std::map<std::array<double, 3>, int> before;
  for (const Vector3d& p : host.positions) ++before[{p.x(), p.y(), p.z()}];
  std::size_t kept = 0;
  for (Index v = 0; v < result->mesh.vertex_count(); ++v) {
    if (moved[v] != 0) continue;
    const Vector3d& p = result->mesh.positions[v];
    EXPECT_EQ(p, result->original[v]);
    kept += before.count({p.x(), p.y(), p.z()});
  }
  EXPECT_GT(kept, host.vertex_count() / 2);
  expect_whole(*result);
}

TEST_F(RunTransplant, MovesWithHostAndPartAsAWhole) {
  const Mesh host = hilly_sphere(4);
  Mesh part = finger(24, 30, 0.3, 1.0);
  transform(part, Eigen::Affine3d(Eigen::Translation3d(0.02, 0.0, 0.95)));
  // Of equally short cuts across the transition any may be taken.
  for (Vector3d& p : part.positions)
    p += 0.01 * Vector3d(std::sin(7.0 * p.y()), std::sin(9.0 * p.z()), std::sin(11.0 * p.x()));
  const std::string list = list_of(host, RegionSpec{GeodesicDisk{Vector3d(0.0, 0.0, 1.0), 0.5}});
  const auto result_of = [&](const Eigen::Affine3d& motion) {
    Mesh moved_host = host;
    Mesh moved_part = part;
    transform(moved_host, motion);
    transform(moved_part, motion);
    write(moved_host, "host.ply");
    write(moved_part, "part.ply");
    return run(transplant(from_file("part.ply"), list,
                          R"(, "remesh": "none", "place": {"translate": [0, 0, 0]})"))
        ->mesh;
  };
  const Mesh still = result_of(Eigen::Affine3d::Identity());
  const Mesh moved = result_of(some_similarity());
  ASSERT_EQ(moved.face_vertices(), still.face_vertices());
  for (std::size_t v = 0; v < still.vertex_count(); ++v) {
    EXPECT_LT((moved.positions[v] - some_similarity() * still.positions[v]).norm(),
              1e-6 * diagonal_of(moved))
        << v;
  }
}

// How wide the blend came out between a flat host and a part with waves on it: where the waves are
// a tenth and nine tenths as high as on the part.
class BlendWidth : public RunTransplant, public ::testing::WithParamInterface<double> {};

TEST_P(BlendWidth, IsTheOneThatWasAsked) {
  const double width = GetParam();
  constexpr Index kCells = 160;
  constexpr double kHeight = 0.002;
  const double wave = 2.0 * std::numbers::pi / 0.04;
  Mesh flat = grid(kCells, kCells);
  Mesh wavy = flat;
  for (Vector3d& p : wavy.positions) p.z() = kHeight * std::sin(wave * p.y());
  write(flat, "host.ply");
  write(wavy, "wavy.ply");
  const std::string box = R"({"box": {"min": [0.1, 0.1, -1], "max": [0.9, 0.9, 1]}})";
  for (const auto profile : {Transition::Profile::linear, Transition::Profile::smooth}) {
    const std::string name = profile == Transition::Profile::linear ? "linear" : "smooth";
    const auto result =
        run(transplant(from_region("wavy.ply", box), box,
                       R"(, "place": {"translate": [0, 0, 0]}, "remesh": "none",
                                           "transition": {"width": )" +
                           std::to_string(width) + R"(, "profile": ")" + name + "\"}"));
    // Along x from the seam at x = 0.1, halfway up: the waves' height by least squares.
    const double cell = 1.0 / kCells;
    std::map<long, std::array<double, 2>> sums;
    for (const Vector3d& p : result->mesh.positions) {
      if (p.x() < 0.1 || p.x() > 0.4 || p.y() < 0.42 || p.y() > 0.58) continue;
      auto& [product, square] = sums[std::lround(p.x() / cell)];
      product += p.z() * std::sin(wave * p.y());
      square += std::pow(std::sin(wave * p.y()), 2);
    }
    const auto passes = [&](double share) {
      double before = 0.0;
      for (const auto& [column, sum] : sums) {
        const double height = sum[0] / sum[1] / kHeight;
        if (height >= share) {
          return (static_cast<double>(column) - (height - share) / (height - before)) * cell;
        }
        before = height;
      }
      return 1.0;
    };
    const Transition asked{width, profile};
    const auto asked_at = [&](double share) {
      double x = 0.0;
      while (fade(asked, x) < share) x += 1e-5;
      return x;
    };
    const double measured = passes(0.9) - passes(0.1);
    const double wanted = asked_at(0.9) - asked_at(0.1);
    EXPECT_NEAR(measured, wanted, 0.1 * wanted) << name;
  }
}
INSTANTIATE_TEST_SUITE_P(Widths, BlendWidth, ::testing::Values(0.1, 0.14, 0.18));

TEST_F(RunTransplant, APartThatIsInsideOutIsTurnedAndReported) {
  write(hilly_sphere(4), "host.ply");
  Mesh part = finger(24, 30, 0.3, 1.0);
  write(part, "right.ply");
  turn_inside_out(part);
  write(part, "wrong.ply");
  const auto right = run(transplant(from_file("right.ply"), kPole));
  const auto wrong = run(transplant(from_file("wrong.ply"), kPole));
  EXPECT_FALSE(right->report.steps[0].transplant->turned);
  EXPECT_TRUE(wrong->report.steps[0].transplant->turned);
  EXPECT_THAT(wrong->report.warnings, ::testing::Contains(HasSubstr("so they were flipped")));
  expect_whole(*right);
  expect_whole(*wrong);
}

TEST_F(RunTransplant, AMirroredPartStaysOutside) {
  write(hilly_sphere(4), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "part.ply");
  const auto result =
      run(transplant(from_file("part.ply"), kPole,
                     R"(, "place": {"matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.95]})"));
  EXPECT_FALSE(result->report.steps[0].transplant->turned);
  expect_whole(*result);
}

TEST_F(RunTransplant, KeepsGroupsAndNamesThePart) {
  Mesh host = hilly_sphere(3);
  host.edit_attributes().groups = {"body"};
  host.edit_attributes().face_groups.assign(host.face_count(), 0);
  write_mesh(host, folder_.path() / "host.obj");
  write_mesh(finger(24, 30, 0.3, 1.0), folder_.path() / "horn.obj");
  const auto result = run_recipe(parse_recipe(R"({"lapwing": 1, "mesh": "host.obj", "steps": [)" +
                                                  transplant(from_file("horn.obj"), kPole) + "]}",
                                              folder_.path(), "test"),
                                 cpu_);
  EXPECT_THAT(result->mesh.attributes().groups, ::testing::UnorderedElementsAre("body", "horn"));
}

// Loops of few and of many vertices on a hole of about 80.
class LoopCounts : public RunTransplant, public ::testing::WithParamInterface<Index> {};

TEST_P(LoopCounts, AllComeOutClosed) {
  const Mesh host = hilly_sphere(5);
  write(host, "host.ply");
  const Index around = GetParam();
  write(finger(around, around > 1000 ? 12 : 16, 0.3, 1.0), "finger.ply");
  const auto result = run(transplant(from_file("finger.ply"), kPole));
  expect_whole(*result);
  EXPECT_LE(result->report.steps[0].transplant->relative_residual, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Counts, LoopCounts, ::testing::Values(3, 4, 7, 50, 400, 4000));

TEST_F(RunTransplant, ATinyHoleAndAPartLargerThanItsHoleComeOutClosed) {
  write(hilly_sphere(4), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  // One triangle's corners; then a part twice as wide as its hole.
  const Mesh host = read("host.ply");
  const auto face = host.face(17);
  const std::string triangle = R"({"vertices": [)" + std::to_string(face[0]) + ", " +
                               std::to_string(face[1]) + ", " + std::to_string(face[2]) + "]}";
  const auto tiny = run(transplant(from_file("finger.ply"), triangle));
  expect_whole(*tiny);
  EXPECT_THAT(tiny->report.warnings, ::testing::Contains(HasSubstr("the seam is only smooth")));
  const auto large =
      run(transplant(from_file("finger.ply"), R"({"disk": {"near": [0, 0, 1], "radius": 0.15}})",
                     R"(, "place": {"translate": [0, 0, 1.1]})"));
  expect_whole(*large);
}

TEST_F(RunTransplant, ABrokenRequestIsAnsweredInWords) {
  write(hilly_sphere(4), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  write(icosphere(2), "closed.ply");
  write(cylinder(24, 20, 0.3, 1.0), "tube.ply");
  const std::string finger_part = from_file("finger.ply");
  const std::string ring = R"({"minus": [{"disk": {"near": [0, 0, 1], "radius": 0.6}},
                                         {"disk": {"near": [0, 0, 1], "radius": 0.2}}]})";
  EXPECT_THAT(refusal(transplant(finger_part, ring)), HasSubstr("must have one boundary loop"));
  EXPECT_THAT(refusal(transplant(finger_part, R"({"all": true})")), HasSubstr("target_region"));
  EXPECT_THAT(refusal(transplant(finger_part, R"({"vertices": [4]})")), HasSubstr("target_region"));
  EXPECT_THAT(refusal(transplant(from_file("closed.ply"), kPole)),
              ::testing::AllOf(HasSubstr("closed"), HasSubstr("lapwing cut")));
  EXPECT_THAT(refusal(transplant(from_file("tube.ply"), kPole, R"(, "loop": 2)")),
              ::testing::AllOf(HasSubstr("/loop"), HasSubstr("24 vertices")));
  EXPECT_THAT(refusal(transplant(finger_part, kPole,
                                 R"(, "place": {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0]})")),
              HasSubstr("flattens"));
  EXPECT_THAT(refusal<IoError>(transplant(from_file("none.ply"), kPole)), HasSubstr("none.ply"));
  // Two sheets that touch in one vertex.
  Mesh pinched;
  pinched.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  pinched.add_face(std::array<Index, 3>{0, 1, 2});
  pinched.add_face(std::array<Index, 3>{0, 3, 4});
  write(pinched, "pinched.ply");
  EXPECT_THAT(refusal(transplant(from_file("pinched.ply"), kPole)), HasSubstr("vertex 0"));
}

TEST_F(RunTransplant, ARegionAtTheHostsOwnBoundaryIsRefused) {
  write(grid(20, 20), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  EXPECT_THAT(refusal(transplant(from_file("finger.ply"),
                                 R"({"disk": {"near": [0, 0.5, 0], "radius": 0.2}})")),
              HasSubstr("reaches the boundary of the mesh"));
}

TEST_F(RunTransplant, AWidthThatThePartIsTooShortForIsNarrowedAndTold) {
  write(hilly_sphere(4), "host.ply");
  write(finger(24, 30, 0.3, 0.3), "stub.ply");
  const auto result =
      run(transplant(from_file("stub.ply"), kPole, R"(, "transition": {"width": 2})"));
  EXPECT_LT(result->report.steps[0].transplant->transition_width, 0.7);
  EXPECT_THAT(result->report.warnings, ::testing::Contains(HasSubstr("extends only")));
  expect_whole(*result);
}

TEST_F(RunTransplant, IsTheSameOnTheDeviceAsOnTheCpu) {
  LAPWING_NEEDS_GPU();
  write(hilly_sphere(4), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  const std::string step = transplant(from_file("finger.ply"), kPole);
  const auto on_cpu = run(step);
  VulkanKernels kernels(VulkanOptions{.frames_on_device = true});
  const auto on_device = run(step, kernels);
  ASSERT_EQ(on_device->mesh.vertex_count(), on_cpu->mesh.vertex_count());
  for (std::size_t v = 0; v < on_cpu->mesh.vertex_count(); ++v) {
    EXPECT_LT((on_device->mesh.positions[v] - on_cpu->mesh.positions[v]).norm(),
              1e-9 * diagonal_of(on_cpu->mesh));
  }
}

TEST_F(RunTransplant, ReportsAsJson) {
  write(hilly_sphere(3), "host.ply");
  write(finger(24, 30, 0.3, 1.0), "finger.ply");
  const auto result = run(transplant(from_file("finger.ply"), kPole));
  const auto json = nlohmann::json::parse(to_json(result->report));
  EXPECT_EQ(json["steps"][0]["op"], "transplant");
  EXPECT_EQ(json["steps"][0]["transplant"]["place"].size(), 12U);
  EXPECT_GT(json["steps"][0]["transplant"]["strip_triangles"], 0);
}

}  // namespace
}  // namespace lapwing::test
