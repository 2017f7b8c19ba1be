// Tests that killing the program at any time leaves either the complete old file or the complete
// new file. A temporary file has a name only between two system calls. If the program is killed
// between them, the next run removes the file.
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using std::chrono::microseconds;
using test::Files;

constexpr int kKillsBySigkill = 150;
constexpr int kKillsByOtherSignals = 30;
constexpr int kMostRoundsPerKill = 8;
// The time of the signal is random up to a limit, which grows with each kill and shrinks with each
// run that ends before its signal. About a quarter of the runs then end first, on a machine of any
// load.
constexpr double kGrowth = 1.03;
constexpr double kShrinkage = 1.1;

class Killed : public ::testing::TestWithParam<int> {
 protected:
  pid_t start(const std::vector<std::string>& arguments) const {
    std::vector<char*> words;
    std::string program = LAPWING_CLI;
    std::vector<std::string> copies = arguments;
    words.push_back(program.data());
    for (std::string& word : copies) words.push_back(word.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    const int nowhere = open("/dev/null", O_WRONLY);
    if (dup2(nowhere, STDOUT_FILENO) < 0 || dup2(nowhere, STDERR_FILENO) < 0) _exit(9);
    if (chdir(folder_.path().c_str()) == 0) execv(program.c_str(), words.data());
    _exit(9);
  }

  // Returns whether the signal terminated the program.
  bool kill_after(microseconds time, const std::vector<std::string>& arguments) const {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(time);
    kill(child, GetParam());
    int status = 0;
    waitpid(child, &status, 0);
    return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  }

  microseconds time_of(const std::vector<std::string>& arguments) const {
    const auto begin = std::chrono::steady_clock::now();
    int status = 0;
    waitpid(start(arguments), &status, 0);
    EXPECT_EQ(status, 0);
    return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now() - begin);
  }

  // Repeatedly runs the program on the files that `prepare` writes, until signals have terminated
  // it at enough random times.
  template <class Prepare>
  void expect_old_or_new(const std::vector<std::string>& arguments, const Prepare& prepare) {
    prepare();
    const Files before = test::files_in(folder_.path());
    double span = static_cast<double>(time_of(arguments).count());
    const Files after = test::files_in(folder_.path());
    ASSERT_NE(before, after);
    std::mt19937 random(23);  // NOLINT(cert-msc51-cpp): the same every time
    std::uniform_real_distribution<double> part(0.0, 1.0);
    const int kills = GetParam() == SIGKILL ? kKillsBySigkill : kKillsByOtherSignals;
    int round = 0;
    for (int killed = 0; killed < kills; ++round) {
      ASSERT_LT(round, kills * kMostRoundsPerKill) << "the signal does not end the program";
      prepare();
      const microseconds moment(std::lround(part(random) * span));
      if (kill_after(moment, arguments)) {
        ++killed;
        span *= kGrowth;
      } else {
        span /= kShrinkage;
      }
      for (const auto& [name, bytes] : test::files_in(folder_.path())) {
        const std::string target = name.substr(0, name.find(".tmp-"));
        // A report contains times, so its bytes differ.
        const bool is_report = bytes.starts_with("{") && bytes.ends_with("\n}\n");
        const bool is_old = name == target && bytes == before.at(target);
        ASSERT_TRUE(is_old || bytes == after.at(target) || is_report)
            << name << " is torn, round " << round;
      }
    }
    time_of(arguments);
    EXPECT_EQ(test::files_in(folder_.path()).size(), after.size()) << "something was left";
  }

  TemporaryFolder folder_;
};

TEST_P(Killed, ARunLeavesTheOldResultOrTheNewOne) {
  write_mesh(cylinder(12, 20, 0.5, 3.0), folder_ / "tube.obj");
  folder_.file("bend.json", test::kBendTube);
  expect_old_or_new({"run", "bend.json", "--device", "cpu", "--quiet", "--save", "out.obj",
                     "--report", "report.json"},
                    [&] {
                      folder_.file("out.obj", "old");
                      folder_.file("report.json", "old");
                    });
}

TEST_P(Killed, ARepairLeavesTheOldMeshOrTheNewOne) {
  Mesh mesh = icosphere(4);
  mesh.positions.emplace_back(0.0, 0.0, 0.0);  // belongs to no face
  write_mesh(mesh, folder_ / "rest.ply");
  expect_old_or_new({"check", "mesh.ply", "--fix", "mesh.ply"}, [&] {
    fs::remove(folder_ / "mesh.ply");
    fs::copy_file(folder_ / "rest.ply", folder_ / "mesh.ply");
  });
}

INSTANTIATE_TEST_SUITE_P(All, Killed, ::testing::Values(SIGKILL, SIGTERM, SIGHUP, SIGINT));

}  // namespace
}  // namespace lapwing
