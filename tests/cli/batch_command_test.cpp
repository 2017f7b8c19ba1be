#include <chrono>
#include <csignal>
#include <random>
#include <thread>
#include <unistd.h>

#include "batch/bent_tubes.h"
#include "command_line.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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

  // Runs a batch and kills it after `time`. Returns false if the batch had already ended.
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

  static inline const std::string kBatch = "batch jobs.jsonl --recipe bend.json --threads 2 -o ";
};

TEST_F(BatchCommandLine, KilledAgainAndAgainItComesToTheBytesOfAnUndisturbedRun) {
  const auto begin = std::chrono::steady_clock::now();
  succeed(kBatch + "whole");
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
  succeed(kBatch + "out --resume");
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

TEST_F(BatchCommandLine, ATermSignalKeepsWhatIsDone) {
  const Outcome stopped = lapwing(kBatch + "out & sleep 0.3; kill -TERM $!; wait $!");
  EXPECT_THAT(stopped.exit_code, ::testing::AnyOf(143, 0)) << stopped.output;
  succeed(kBatch + "out --resume");
  succeed(kBatch + "whole");
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

// A limit on the file size has the same effect as a full disk: a write stores only some of its
// bytes. The first limit is too small for any mesh, the second for the lines of results.
TEST_F(BatchCommandLine, WithoutRoomItSaysSoAndGoesOnLater) {
  succeed(kBatch + "whole");
  const std::string quoted = "'" + std::string(LAPWING_CLI) + "' ";
  for (const char* const blocks : {"1", "20"}) {
    const Outcome full = lapwing("--version >/dev/null; ulimit -f " + std::string(blocks) + "; " +
                                 quoted + kBatch + "out --resume");
    EXPECT_EQ(full.exit_code, 6) << full.output;
    EXPECT_THAT(full.output, AllOf(HasSubstr("of 60 jobs are done"), HasSubstr("--resume")));
  }
  succeed(kBatch + "out --resume");
  EXPECT_EQ(files_of("out"), files_of("whole"));
}

TEST_F(BatchCommandLine, TellsFailedLinesByItsExitCode) {
  write("jobs.jsonl", "{\"id\": \"a\"}\n{\"id\": \"b\", \"set\": {\"/steps/7\": 1}}\n");
  const Outcome outcome = lapwing(kBatch + "out");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("1 of 2 done, 1 failed"),
                                    HasSubstr("\nlapwing: 1 job failed; see out/failed.jsonl\n")));
  EXPECT_THAT(read("out/failed.jsonl"), HasSubstr("/steps is a list of 1"));
  EXPECT_TRUE(fs::exists(file("out/a.ply")));
}

TEST_F(BatchCommandLine, ShardThatFailsNamesItsOwnFileEvenWhenQuiet) {
  write("jobs.jsonl", R"({"id": "a", "set": {"/steps/7": 1}}
{"id": "b", "set": {"/steps/7": 1}}
)");
  EXPECT_EQ(lapwing(kBatch + "out --shard 2/2 --quiet").output,
            "lapwing: 1 job failed; see out/failed-2-of-2.jsonl\n");
  EXPECT_TRUE(fs::exists(file("out/failed-2-of-2.jsonl")));
  EXPECT_EQ(lapwing(kBatch + "out --resume --quiet").output,
            "lapwing: 2 jobs failed; see out/failed.jsonl\n");
}

// Stands in for sbatch and scancel: sbatch accepts the first ACCEPTED jobs.
TEST_F(BatchCommandLine, WritesTheVerticesOfAllJobs) {
  EXPECT_THAT(succeed(kBatch + "out --vertices all.npy"), HasSubstr("wrote all.npy"));
  EXPECT_EQ(fs::file_size(file("all.npy")) / (kJobs * 24),
            read_mesh(file("tube.obj")).vertex_count());
}

TEST_F(BatchCommandLine, SlurmShardsFailsIfSbatchDoesAndLeavesNoJobBehind) {
  fs::create_directory(file("bin"));
  write("bin/sbatch",
        "#!/bin/sh\n"
        "echo \"$*\" >> submitted\n"
        "if [ \"$(wc -l < submitted)\" -gt \"$ACCEPTED\" ]; then\n"
        "  echo 'sbatch: error: denied' >&2\n"
        "  exit 1\n"
        "fi\n"
        "echo 41\n");
  write("bin/scancel", "#!/bin/sh\necho \"$*\" > cancelled\n");
  for (const char* name : {"bin/sbatch", "bin/scancel"}) {
    fs::permissions(file(name), fs::perms::owner_all);
  }
  const auto submit = [&](int accepted) {
    fs::remove(file("submitted"));
    return lapwing("--version >/dev/null; PATH=\"$PWD/bin:$PATH\" LAPWING='" LAPWING_CLI
                   "' ACCEPTED=" +
                   std::to_string(accepted) +
                   " '" LAPWING_TOOLS "/batch/slurm-shards' 2 -- jobs.jsonl -o out");
  };
  const Outcome none = submit(0);
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.output, AllOf(HasSubstr("sbatch: error: denied"),
                                 HasSubstr("nothing was submitted"), Not(HasSubstr("Job "))));
  EXPECT_FALSE(fs::exists(file("cancelled")));
  const Outcome one = submit(1);
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.output, AllOf(HasSubstr("job 41, is cancelled"), Not(HasSubstr("Job "))));
  EXPECT_EQ(read("cancelled"), "41\n");
  EXPECT_THAT(submit(2).output, HasSubstr("Job 41: 2 shards."));
}

TEST_F(BatchCommandLine, RefusesWhatItCannotBeginBeforeItBegins) {
  for (const char* flags :
       {"--shard 0/4", "--shard 5/4", "--format fbx", "--vertices v.npy --shard 1/2",
        "--vertices v.csv", "--vertices v.npy --displacements float32"}) {
    expect_refused(kBatch + "out " + flags, 2);
  }
  expect_refused("batch none.jsonl -o out", 6);
  write("other", "a file in the place of the folder");
  expect_refused(kBatch + "other", 6);
  write("jobs.jsonl", "{\"id\": \"a\"}\n{\"id\": \"a\"}\n");
  expect_refused(kBatch + "out", 2, {"the id \"a\" is already used in line 1"});
}

}  // namespace
}  // namespace lapwing
