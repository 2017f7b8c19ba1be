#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "run/recipe_runs.h"

namespace lapwing::test {

/// Around the north pole of the unit sphere.
inline const std::string kPole = R"({"disk": {"near": [0, 0, 1], "radius": 0.5}})";

/// A finger that stands on z = 0: a tube with a round end, open below, of `around` times `rings`
/// vertices and as many again on its end.
inline Mesh finger(Index around, Index rings, double radius, double height) {
  Mesh mesh = cylinder(around, rings, radius, height);
  const Index top_rings = std::max<Index>(2, around / 4);
  Index below = (rings - 1) * around;
  for (Index r = 1; r < top_rings; ++r) {
    const double angle = 0.5 * std::numbers::pi * r / top_rings;
    const auto first = static_cast<Index>(mesh.vertex_count());
    for (Index a = 0; a < around; ++a) {
      const Eigen::Vector3d foot = mesh.positions[(rings - 1) * around + a];
      mesh.positions.emplace_back(foot.x() * std::cos(angle), foot.y() * std::cos(angle),
                                  height + radius * std::sin(angle));
    }
    for (Index a = 0; a < around; ++a) {
      const Index next = (a + 1) % around;
      mesh.add_face(std::array{below + a, below + next, first + next});
      mesh.add_face(std::array{below + a, first + next, first + a});
    }
    below = first;
  }
  mesh.positions.emplace_back(0.0, 0.0, height + radius);
  const auto tip = static_cast<Index>(mesh.vertex_count() - 1);
  for (Index a = 0; a < around; ++a) {
    mesh.add_face(std::array{below + a, below + (a + 1) % around, tip});
  }
  return mesh;
}

/// Runs recipes with transplant steps.
class TransplantRuns : public RecipeRuns {
 protected:
  TransplantRuns() : RecipeRuns("host.ply") {}

  /// `keys` begins with a comma.
  static std::string transplant(const std::string& part, const std::string& target_region,
                                const std::string& keys = "") {
    return R"({"op": "transplant", "part": )" + part + R"(, "target_region": )" + target_region +
           keys + "}";
  }
  static std::string from_file(const std::string& name) { return '"' + name + '"'; }
  static std::string from_region(const std::string& mesh, const std::string& region) {
    return R"({"mesh": ")" + mesh + R"(", "region": )" + region + "}";
  }
};

/// One oriented piece without handles, closed but for so many holes, and nothing wrong with it.
inline void expect_whole(const RunResult& result, std::size_t holes = 0) {
  const CheckReport report = check(result.mesh);
  EXPECT_EQ(report.statistics.boundary_loops, holes);
  EXPECT_EQ(report.statistics.component_sizes.size(), 1U);
  EXPECT_EQ(report.statistics.euler_characteristic, 2 - static_cast<long>(holes));
  for (const Defect& defect : report.defects) {
    EXPECT_EQ(describe(defect.kind).severity, Severity::info) << describe(defect.kind).name;
  }
}

inline double diagonal_of(const Mesh& mesh) {
  return bounds_of(mesh.positions).diagonal();
}

}  // namespace lapwing::test
