#pragma once

#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_recipe.h"
#include "support/error_message.h"

namespace lapwing::test {

/// Runs recipes that edit the mesh file `mesh` in a temporary folder.
class RecipeRuns : public ::testing::Test {
 protected:
  explicit RecipeRuns(std::string mesh) : mesh_(std::move(mesh)) {}

  void write(const Mesh& mesh, const std::string& name) const {
    write_mesh(mesh, folder_.path() / name);
  }
  Mesh read(const std::string& name) const { return read_mesh(folder_.path() / name); }

  Recipe recipe(const std::string& steps) const {
    return parse_recipe(R"({"lapwing": 1, "mesh": ")" + mesh_ + R"(", "steps": [)" + steps + "]}",
                        folder_.path(), "test");
  }
  std::unique_ptr<RunResult> run(const std::string& steps, Kernels& kernels,
                                 const Progress& progress = {},
                                 const RunOptions& options = {}) const {
    return run_recipe(recipe(steps), kernels, progress, options);
  }
  std::unique_ptr<RunResult> run(const std::string& steps, const Progress& progress = {},
                                 const RunOptions& options = {}) {
    return run(steps, cpu_, progress, options);
  }

  /// Runs a recipe that must fail. Returns the error message.
  template <class Error = InputError>
  std::string refusal(const std::string& steps) {
    return error_message<Error>([&] { run(steps); });
  }

  TemporaryFolder folder_;
  CpuKernels cpu_;

 private:
  std::string mesh_;
};

}  // namespace lapwing::test
