#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/session/run_recipe.h"
#include "support/error_message.h"

namespace lapwing::test {

inline const std::string kAll = R"({"all": true})";

/// A patch well inside the unit square.
inline const std::string kMiddle = R"({"disk": {"near": [0.5, 0.5, 0], "radius": 0.3}})";

/// Keys of a step, each with its comma: another mesh as the source, and the triangles as they are.
inline const std::string kFrom = R"(, "source": "source.ply")";
inline const std::string kKeep = R"(, "remesh": "none")";

/// Runs recipes with coat steps on meshes in a folder of its own.
class CoatRuns : public ::testing::Test {
 protected:
  void write(const Mesh& mesh, const std::string& name) const {
    write_mesh(mesh, folder_.path() / name);
  }
  Mesh read(const std::string& name) const { return read_mesh(folder_.path() / name); }

  /// A coat step with these patches; `keys` begins with a comma.
  static std::string coat(const std::string& source_patch, const std::string& target_patch,
                          const std::string& keys = "", double detail_size = 0.5) {
    return R"({"op": "coat", "source_patch": )" + source_patch + R"(, "target_patch": )" +
           target_patch + R"(, "detail_size": )" + std::to_string(detail_size) + keys + "}";
  }

  std::unique_ptr<RunResult> run(const std::string& steps, Kernels& kernels,
                                 const Progress& progress = {},
                                 const RunOptions& options = {}) const {
    return run_recipe(
        parse_recipe(R"({"lapwing": 1, "mesh": "target.ply", "steps": [)" + steps + "]}",
                     folder_.path(), "test"),
        kernels, progress, options);
  }
  std::unique_ptr<RunResult> run(const std::string& steps, const Progress& progress = {},
                                 const RunOptions& options = {}) {
    return run(steps, cpu_, progress, options);
  }

  /// What the run says that must fail.
  template <class Error = InputError>
  std::string refusal(const std::string& steps) {
    return error_message<Error>([&] { run(steps); });
  }

  TemporaryFolder folder_;
  CpuKernels cpu_;
};

inline bool all_finite(const Positions& positions) {
  return std::all_of(positions.begin(), positions.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

}  // namespace lapwing::test
