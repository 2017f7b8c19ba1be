#pragma once

#include <algorithm>
#include <string>

#include "coating/coating_scenes.h"
#include "run/recipe_runs.h"

namespace lapwing::test {

inline const std::string kAll = R"({"all": true})";

/// A patch well inside the unit square.
inline const std::string kMiddle = R"({"disk": {"near": [0.5, 0.5, 0], "radius": 0.3}})";

/// Keys of a step, each with its comma: another mesh as the source, and the triangles as they are.
inline const std::string kFrom = R"(, "source": "source.ply")";
inline const std::string kKeep = R"(, "remesh": "none")";

/// Runs recipes with coat steps.
class CoatRuns : public RecipeRuns {
 protected:
  CoatRuns() : RecipeRuns("target.ply") {}

  /// A coat step with these patches; `keys` begins with a comma.
  static std::string coat(const std::string& source_patch, const std::string& target_patch,
                          const std::string& keys = "", double detail_size = 0.5) {
    return R"({"op": "coat", "source_patch": )" + source_patch + R"(, "target_patch": )" +
           target_patch + R"(, "detail_size": )" + std::to_string(detail_size) + keys + "}";
  }
};

inline bool all_finite(const Positions& positions) {
  return std::all_of(positions.begin(), positions.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

}  // namespace lapwing::test
