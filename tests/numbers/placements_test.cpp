// Tests that every operation commutes with scaling a mesh and with moving it far from the origin.
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/remesh/remesh.h"
#include "numbers/operations.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

using ::testing::HasSubstr;

// Returns a ball whose edges all have different lengths, so that no choice depends on rounding.
Mesh bumpy_ball() {
  Mesh ball = icosphere(3);
  for (std::size_t v = 0; v < ball.vertex_count(); ++v) {
    ball.positions[v] *= 1.0 + 0.05 * std::sin(static_cast<double>(7 * v));
  }
  return ball;
}

// Returns a ball with a needle triangle at every 40th face. The needle connects an edge of the face
// to a new vertex near the edge's midpoint. The height of the needle is `height` times that of the
// face.
Mesh ball_with_needles(double height) {
  const Mesh whole = bumpy_ball();
  Mesh mesh;
  mesh.positions = whole.positions;
  for (std::size_t f = 0; f < whole.face_count(); ++f) {
    const auto face = whole.face(f);
    if (f % 40 != 0) {
      mesh.add_face(face);
      continue;
    }
    const auto middle = static_cast<Index>(mesh.vertex_count());
    const Eigen::Vector3d& a = whole.positions[face[0]];
    const Eigen::Vector3d& b = whole.positions[face[1]];
    const Eigen::Vector3d& c = whole.positions[face[2]];
    mesh.positions.push_back(0.6 * a + 0.4 * b + height * (c - 0.6 * a - 0.4 * b));
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corners[] = {face[k], face[(k + 1) % 3], middle};
      mesh.add_face(corners);
    }
  }
  return mesh;
}

// Returns a ball in which every 40th face exists twice.
Mesh ball_with_repeated_faces() {
  const Mesh whole = bumpy_ball();
  Mesh mesh = whole;
  for (std::size_t f = 0; f < whole.face_count(); f += 40) mesh.add_face(whole.face(f));
  return mesh;
}

// The distance from the origin in edge lengths. Scans in map coordinates have such distances.
constexpr double kFarOut = 1e7;

double mean_edge(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  return region_quality(mesh, all).mean_edge;
}

Placement far_out(const Mesh& mesh) {
  return {"far out", 1.0, kFarOut * mean_edge(mesh) * Eigen::Vector3d(1.0, -0.7, 0.3)};
}

// Placements that round coordinates.
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

// Placements that do not round coordinates. Results must agree even on symmetric meshes.
std::vector<Placement> exact_placements() {
  std::vector<Placement> all;
  for (const int exponent : {-110, -20, 10, 110}) {
    all.push_back({"2^" + std::to_string(exponent), std::ldexp(1.0, exponent)});
  }
  return all;
}

// Returns a description of each result that differs.
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

// Returns the operations in which no decision depends on a comparison of lengths.
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

// If a needle has no height, rounding determines on which side of the edge its tip lies, and
// therefore which triangles remeshing creates.
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

// Tests a few files in every run, and all of them with LAPWING_PLACED_MODELS=1000.
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
