#include <chrono>
#include <csignal>
#include <random>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "command_line.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class BatchCommandLine : public CommandLine {
 protected:
  static constexpr int kJobs = 60;

  void SetUp() override {
    CommandLine::SetUp();
    write("bend.json", test::kBendTube);
    std::string lines;
    for (int k = 0; k < kJobs; ++k) {
      lines += R"({"id": "j)" + std::to_string(k) +
               R"(", "set": {"/steps/0/handles/0/move/translate": [0.)" + std::to_string(k + 10) +
               ", 0, 0.3]}}\n";
    }
    write("jobs.jsonl", lines);
  }

  test::Files files_of(const std::string& folder) const { return test::files_in(file(folder)); }

  // Runs a batch and kills it after that long; false where it came to its end before.
  bool kill_after(std::chrono::microseconds time) const {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.path().c_str()) != 0) _exit(9);
      execl(LAPWING_CLI, LAPWING_CLI, "batch", "jobs.jsonl", "--recipe", "bend.json", "-o", "out",
            "--resume", "--threads", "2", "--quiet", nullptr);
      _exit(9);
    }
    std::this_thread::sleep_for(time);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }

  static constexpr const char* kBatch = "batch jobs.jsonl --recipe bend.json --threads 2 -o ";
};

TEST_F(BatchCommandLine, KilledAgainAndAgainItComesToTheBytesOfAnUndisturbedRun) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(lapwing(kBatch + std::string("whole")).exit_code, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - begin);
  std::mt19937 random(22);  // NOLINT(cert-msc51-cpp): the same every time
  std::uniform_int_distribution<long> upto(1000, std::max(2000L, whole.count() / 3));
  constexpr int kKills = 200;
  int kills = 0;
  for (int round = 0; round < 7 * kKills && kills < kKills; ++round) {
    if (kill_after(std::chrono::microseconds(upto(random)))) {
      ++kills;
    } else {
      EXPECT_EQ(files_of("out"), files_of("whole")) << "after " << kills << " kills";
      fs::remove_all(file("out"));
    }
  }
  EXPECT_EQ(kills, kKills);
  EXPECT_EQ(lapwing(kBatch + std::string("out --resume")).exit_code, 0);
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

TEST_F(BatchCommandLine, ATermSignalKeepsWhatIsDone) {
  const Outcome stopped = lapwing(kBatch + std::string("out & sleep 0.3; kill -TERM $!; wait $!"));
  EXPECT_THAT(stopped.exit_code, ::testing::AnyOf(143, 0)) << stopped.output;
  EXPECT_EQ(lapwing(kBatch + std::string("out --resume")).exit_code, 0);
  ASSERT_EQ(lapwing(kBatch + std::string("whole")).exit_code, 0);
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

// A file that may not grow beyond some blocks is what a full disk is: writes end short. First no
// mesh fits, then the lines of results do not.
TEST_F(BatchCommandLine, WithoutRoomItSaysSoAndGoesOnLater) {
  ASSERT_EQ(lapwing(kBatch + std::string("whole")).exit_code, 0);
  const std::string quoted = "'" + std::string(LAPWING_CLI) + "' ";
  for (const char* const blocks : {"1", "20"}) {
    const Outcome full = lapwing("--version >/dev/null; ulimit -f " + std::string(blocks) + "; " +
                                 quoted + kBatch + "out --resume");
    EXPECT_EQ(full.exit_code, 6) << full.output;
    EXPECT_THAT(full.output, AllOf(HasSubstr("of 60 jobs are done"), HasSubstr("--resume")));
  }
  EXPECT_EQ(lapwing(kBatch + std::string("out --resume")).exit_code, 0);
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

TEST_F(BatchCommandLine, AFolderThatMayNotBeWrittenIsAnError) {
  write("out", "a file, where the folder should be");
  EXPECT_EQ(lapwing(kBatch + std::string("out")).exit_code, 6);
}

TEST_F(BatchCommandLine, TellsFailedLinesByItsExitCode) {
  write("jobs.jsonl", "{\"id\": \"a\"}\n{\"id\": \"b\", \"set\": {\"/steps/7\": 1}}\n");
  const Outcome outcome = lapwing(kBatch + std::string("out"));
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("1 of 2 done, 1 failed"), HasSubstr("failed")));
  EXPECT_THAT(read("out/failed.jsonl"), HasSubstr("/steps is a list of 1"));
  EXPECT_TRUE(fs::exists(file("out/a.ply")));
}

TEST_F(BatchCommandLine, RefusesWhatItCannotBeginBeforeItBegins) {
  EXPECT_EQ(lapwing(kBatch + std::string("out --shard 0/4")).exit_code, 2);
  EXPECT_EQ(lapwing(kBatch + std::string("out --shard 5/4")).exit_code, 2);
  EXPECT_EQ(lapwing(kBatch + std::string("out --format fbx")).exit_code, 2);
  EXPECT_EQ(lapwing("batch none.jsonl -o out").exit_code, 6);
  write("jobs.jsonl", "{\"id\": \"a\"}\n{\"id\": \"a\"}\n");
  const Outcome twice = lapwing(kBatch + std::string("out"));
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.output, HasSubstr("the id \"a\" is already used in line 1"));
  EXPECT_FALSE(fs::exists(file("out")));
}

}  // namespace
}  // namespace lapwing
