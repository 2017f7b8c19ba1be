#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {

struct Outcome {
  int exit_code = -1;
  std::string output;  ///< standard output and standard error
};

/// Runs the program in a temporary folder that contains a tube.
class CommandLine : public ::testing::Test {
 protected:
  static inline const std::string kLiftFlags =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.8,1,1,4 "
      "--translate 0,0,0.5 ";

  void SetUp() override { write_mesh(cylinder(12, 20, 0.5, 3.0), file("tube.obj")); }

  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// Runs `lapwing ARGUMENTS` in the temporary folder; `environment` is set before it.
  Outcome lapwing(const std::string& arguments, const std::string& environment = "") const {
    const std::string command = "cd '" + folder_.path().string() + "' && " + environment + " '" +
                                LAPWING_CLI + "' " + arguments + " 2>&1 </dev/null";
    Outcome outcome;
    std::FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const std::size_t got = fread(buffer.data(), 1, buffer.size(), pipe)) {
      outcome.output.append(buffer.data(), got);
    }
    const int status = pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return outcome;
  }

  /// Runs a command that must succeed. Returns its output.
  std::string succeed(const std::string& arguments, const std::string& environment = "") const {
    const Outcome outcome = lapwing(arguments, environment);
    EXPECT_EQ(outcome.exit_code, 0) << environment << " " << arguments << "\n" << outcome.output;
    return outcome.output;
  }

  /// Runs a command that must end with `exit_code`, print all `words` and change no file.
  void expect_refused(const std::string& arguments, int exit_code,
                      const std::vector<std::string>& words = {}) const {
    const test::Files before = test::files_in(folder_.path());
    const Outcome outcome = lapwing(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.output;
    for (const std::string& word : words) {
      EXPECT_THAT(outcome.output, ::testing::HasSubstr(word)) << arguments;
    }
    EXPECT_TRUE(test::files_in(folder_.path()) == before) << arguments << " changed files";
  }

  /// Runs `recipe`, which was written together with the result `mesh`. Expects the same bytes.
  void expect_recipe_repeats(const std::string& recipe, const std::string& mesh) const {
    const std::string again = "again" + std::filesystem::path(mesh).extension().string();
    EXPECT_EQ(succeed("run " + recipe + " --device cpu --quiet --save " + again), "");
    EXPECT_TRUE(read(again) == read(mesh)) << recipe;
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(file(name)).rdbuf();
    return text.str();
  }

  TemporaryFolder folder_;
};

}  // namespace lapwing
