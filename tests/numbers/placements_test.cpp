// Every operation on meshes that lie far out, that are tiny and that are huge: what comes out is
// what comes out of the plain mesh, placed there.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/remesh/quality.h"
#include "numbers/agreement.h"
#include "numbers/numbers_meshes.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

using ::testing::HasSubstr;

// Of scans in maps' coordinates, in edges.
constexpr double kFarOut = 1e7;

double mean_edge(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  return region_quality(mesh, all).mean_edge;
}

Placement far_out(const Mesh& mesh) {
  return {"far out", 1.0, kFarOut * mean_edge(mesh) * Eigen::Vector3d(1.0, -0.7, 0.3)};
}

// Which round coordinates.
std::vector<Placement> placements(const Mesh& mesh) {
  const Eigen::Vector3d far = far_out(mesh).offset;
  return {{"a hundredth of the least float", 1e-37},
          {"1e-30", 1e-30},
          {"micrometres for metres", 1e6},
          {"kilometres for millimetres", 1e-6},
          {"1e30", 1e30},
          {"near the largest float", 1e37},
          far_out(mesh),
          {"far out in micrometres", 1e6, 1e6 * far}};
}

// Which do not, so that nothing is decided otherwise, on symmetric meshes too.
std::vector<Placement> exact_placements() {
  std::vector<Placement> all;
  for (const int exponent : {-110, -20, 10, 110}) {
    all.push_back({"2^" + std::to_string(exponent), std::ldexp(1.0, exponent)});
  }
  return all;
}

// What does not come out alike, in words.
std::vector<std::string> differences(const Mesh& mesh, const std::vector<Operation>& operations,
                                     const std::vector<Placement>& placements) {
  const double diagonal = bounds_of(mesh.positions).diagonal();
  std::vector<std::string> found;
  for (const Operation& operation : operations) {
    const Outcome plain = outcome_of(operation, mesh, {});
    for (const Placement& placement : placements) {
      const Outcome placed = outcome_of(operation, mesh, placement);
      const std::string name = operation.name + ", " + placement.name + ": ";
      if (placed.refusal.empty() != plain.refusal.empty()) {
        found.push_back(name + "plain \"" + plain.refusal + "\", placed \"" + placed.refusal +
                        "\"");
      } else if (plain.refusal.empty() && !agrees(placed.mesh, plain.mesh, diagonal)) {
        found.push_back(name + "another surface");
      }
    }
  }
  return found;
}

std::vector<std::string> differences(const Mesh& mesh) {
  std::vector<Placement> all = placements(mesh);
  for (const Placement& exact : exact_placements()) all.push_back(exact);
  return differences(mesh, all_operations(), all);
}

// Those that choose nothing by comparing lengths.
std::vector<Operation> without_choices() {
  std::vector<Operation> all = all_operations();
  std::erase_if(all, [](const Operation& o) { return o.name != "deform" && o.name != "peel"; });
  return all;
}

TEST(Placements, MakeNoDifferenceToABall) {
  EXPECT_THAT(differences(bumpy_ball()), ::testing::IsEmpty());
}

TEST(Placements, MakeNoDifferenceWithNeedles) {
  EXPECT_THAT(differences(ball_with_needles(1e-4)), ::testing::IsEmpty());
}

// On which side of its edge the tip of a needle without height comes to lie is a matter of
// rounding, and with it which triangles remeshing makes; nothing else is.
TEST(Placements, MakeNoDifferenceWithNeedlesWithoutHeight) {
  const Mesh mesh = ball_with_needles(0.0);
  EXPECT_THAT(differences(mesh, all_operations(), exact_placements()), ::testing::IsEmpty());
  std::vector<Operation> operations = all_operations();
  std::erase_if(operations, [](const Operation& o) { return o.name == "transplant"; });
  EXPECT_THAT(differences(mesh, operations, placements(mesh)), ::testing::IsEmpty());
}

TEST(Placements, MakeNoDifferenceWithRepeatedFaces) {
  EXPECT_THAT(differences(ball_with_repeated_faces()), ::testing::IsEmpty());
}

TEST(Placements, BeyondFloatsAreRefusedByName) {
  for (const double scale : {1e-300, 1e-100, 1e-39, 1e40, 1e100, 1e300}) {
    for (const Operation& operation : all_operations()) {
      const Outcome outcome = outcome_of(operation, bumpy_ball(), {"", scale});
      EXPECT_THAT(outcome.refusal, HasSubstr("; scale the mesh")) << operation.name << scale;
    }
  }
}

// A few files in every run; all of them, by LAPWING_PLACED_MODELS=1000, by hand.
TEST(PlacementsOfModels, MakeNoDifference) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  const char* const wanted = std::getenv("LAPWING_PLACED_MODELS");
  const std::size_t count = wanted != nullptr ? std::strtoul(wanted, nullptr, 10) : 6;
  std::vector<std::filesystem::path> files = cgal;
  for (const auto& file : model_files("assimp")) files.push_back(file);
  const std::size_t stride =
      std::max<std::size_t>(files.size() / std::max<std::size_t>(count, 1), 1);
  for (std::size_t k = 0; k < files.size(); k += stride) {
    Mesh mesh;
    try {
      mesh = read_mesh(files[k]);
      if (mesh.topology().triangles.empty()) continue;
    } catch (const Error&) {
      continue;  // Broken on purpose.
    }
    EXPECT_THAT(differences(mesh, all_operations(), exact_placements()), ::testing::IsEmpty())
        << files[k].filename();
    EXPECT_THAT(differences(mesh, without_choices(), {far_out(mesh)}), ::testing::IsEmpty())
        << files[k].filename();
  }
}

}  // namespace
}  // namespace lapwing::test
