#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {

struct Outcome {
  int exit_code = -1;
  std::string output;  ///< of both streams
};

/// The program in a temporary folder with a tube in it.
class CommandLine : public ::testing::Test {
 protected:
  /// Lifts the tube's head.
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
