// Tests that after any failed system call, the folder contains either the complete old file or the
// complete new file, and no other file.
#include <cerrno>
#include <cstring>
#include <functional>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "faults/failing_calls.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/batch/batch.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"
#include "state/history.h"
#include "state/journal.h"
#include "support/error_message.h"
#include "viewer_state/tube_edit.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using test::FailingCall;
using test::FileCall;
using test::Files;
using ::testing::HasSubstr;

struct Fault {
  FileCall call;
  int error;

  friend void PrintTo(const Fault& fault, std::ostream* out) {
    *out << test::name_of(fault.call) << ": " << std::strerror(fault.error);
  }
};

std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (const FileCall call : test::kFileCalls) {
    for (const int error : {ENOSPC, EIO}) all.push_back({call, error});
  }
  return all;
}

class FileFault : public ::testing::TestWithParam<Fault> {
 protected:
  // Runs `write` repeatedly. Its first system call fails in the first run, its second call in the
  // second run, and so on until no call fails. `look` checks the files after each run.
  void meet_everywhere(const std::function<void()>& prepare, const std::function<void()>& write,
                       const std::function<void(bool written, int k)>& look) {
    bool met = true;
    for (int k = 0; met; ++k) {
      prepare();
      std::string message;
      {
        const FailingCall fault(GetParam().call, k, GetParam().error);
        message = error_message<IoError>(write);
        met = FailingCall::has_failed();
      }
      if (met && !message.empty()) {
        EXPECT_THAT(message, HasSubstr(std::strerror(GetParam().error))) << "call " << k;
      }
      EXPECT_TRUE(met || message.empty()) << message;
      look(message.empty(), k);
      ASSERT_LT(k, 1000);
    }
  }

  Files files() const { return test::files_in(folder_.path()); }
  // Expects that each file is complete, either as in `before` or as in `after`.
  void expect_old_or_new(const Files& before, const Files& after, int k) const {
    for (const auto& [name, bytes] : files()) {
      const auto old = before.find(name);
      const auto fresh = after.find(name);
      EXPECT_TRUE((old != before.end() && bytes == old->second) ||
                  (fresh != after.end() && bytes == fresh->second))
          << name << " at call " << k;
    }
    for (const auto& [name, bytes] : before) EXPECT_TRUE(files().contains(name)) << name;
  }

  void expect_old_or_new_mesh() {
    const fs::path path = folder_ / "a.ply";
    write_mesh(icosphere(2), path);
    const Files after = files();
    write_mesh(icosphere(1), path);
    const Files before = files();
    meet_everywhere(
        [&] { write_mesh(icosphere(1), path); }, [&] { write_mesh(icosphere(2), path); },
        [&](bool written, int k) { EXPECT_EQ(files(), written ? after : before) << "call " << k; });
  }

  TemporaryFolder folder_;
};

TEST_P(FileFault, LeavesTheOldMeshOrTheNewOne) {
  expect_old_or_new_mesh();
}

TEST_P(FileFault, LeavesTheOldMeshOrTheNewOneAlsoWithNamedTemporaries) {
  const test::NoNamelessFiles named;
  expect_old_or_new_mesh();
}

TEST_P(FileFault, LeavesNothingWhereNothingWas) {
  const fs::path path = folder_ / "a.ply";
  meet_everywhere([&] { fs::remove(path); }, [&] { write_mesh(icosphere(1), path); },
                  [&](bool written, int k) { EXPECT_EQ(files().size(), written ? 1U : 0U) << k; });
}

// If a call before the first rename fails, no file has changed.
TEST_P(FileFault, LeavesAllFilesOfARunAsTheyWereUntilTheyAreWhole) {
  folder_.file("tube.obj", "");
  write_mesh(cylinder(12, 20, 0.5, 3.0), folder_ / "tube.obj");
  folder_.file("points.csv", "x, y, z\n0.60, 0.0, 2.90\n");
  std::string text = test::kBendTube;
  text.insert(text.find("\"handles\""), R"("carry": ["points.csv"], )");
  CpuKernels kernels;
  const auto result = run_recipe(parse_recipe(text, folder_.path(), "test"), kernels);
  const auto save = [&] {
    FileReplacements written;
    save_result(*result, folder_ / "out.obj", written);
    written.add(folder_ / "picture.png",
                encode_png({.width = 1, .height = 1, .rgba = {1, 2, 3, 4}}));
    written.commit();
  };
  save();
  const Files after = files();
  const auto prepare = [&] {
    for (const char* const name : {"out.obj", "points-carried.csv", "picture.png"}) {
      folder_.file(name, "old");
    }
  };
  prepare();
  const Files before = files();
  meet_everywhere(prepare, save, [&](bool written, int k) {
    expect_old_or_new(before, after, k);
    if (written) {
      EXPECT_TRUE(files() == after);
    } else if (GetParam().call != FileCall::rename && GetParam().call != FileCall::linkat &&
               k < 3) {
      EXPECT_TRUE(files() == before) << "call " << k;
    }
  });
}

TEST_P(FileFault, OfABatchLosesNothingThatIsDone) {
  write_mesh(cylinder(12, 20, 0.5, 3.0), folder_ / "tube.obj");
  folder_.file("bend.json", test::kBendTube);
  std::string jobs;
  for (int k = 1; k < 5; ++k) {
    jobs += "{\"set\": {\"/steps/0/handles/0/move/translate\": [0." + std::to_string(k) +
            ", 0, 0.3]}}\n";
  }
  folder_.file("jobs.jsonl", jobs);
  const auto batch = [&](const char* folder) {
    BatchRequest request{.jobs = folder_ / "jobs.jsonl", .folder = folder_ / folder};
    request.recipe = folder_ / "bend.json";
    request.resume = true;
    request.threads = 1;
    run_batch(request);
  };
  batch("whole");
  const Files whole = test::files_in(folder_ / "whole");
  meet_everywhere([&] { fs::remove_all(folder_ / "out"); }, [&] { batch("out"); },
                  [&](bool, int k) {
                    batch("out");
                    EXPECT_TRUE(test::files_in(folder_ / "out") == whole) << "call " << k;
                  });
}

TEST_P(FileFault, OfAJournalLosesNoStepThatWasRecorded) {
  using namespace viewer;
  using namespace viewer::test;
  const fs::path mesh = folder_ / "tube.obj";
  write_mesh(bumpy_tube(), mesh);
  const fs::path cache = folder_ / "cache";
  std::vector<Draft> recorded;
  meet_everywhere(
      [&] {
        fs::remove_all(cache);
        recorded.assign(1, Draft{});
      },
      [&] {
        History history(chosen_tube());
        Journal journal(cache, stamp_of(mesh));
        for (int k = 0; k < 4; ++k) {
          journal.record(history.state());
          recorded.push_back(draft_of(history.state()));
          history.perform(MoveHandle{0, twisted(1.0 + k)});
          if (k == 1) journal.keep_mesh();
          if (k == 2) history.perform(Settle{handles_alone(history.state())});
        }
      },
      [&](bool, int k) {
        const auto found = find_interrupted(cache);
        if (recorded.size() > 1) {
          ASSERT_EQ(found.size(), 1U) << "call " << k;
          EXPECT_EQ(found[0].draft, recorded.back()) << "call " << k;
        }
      });
}

INSTANTIATE_TEST_SUITE_P(All, FileFault, ::testing::ValuesIn(faults()));

TEST(NamedTemporary, OfADeadProcessIsReplacedAndOneInUseIsNot) {
  const test::NoNamelessFiles named;
  const TemporaryFolder folder;
  folder.file("a.txt.tmp-0", "left by a process that was killed");
  replace_file(folder / "a.txt", "new");
  EXPECT_EQ(test::files_in(folder.path()), (Files{{"a.txt", "new"}}));
  FileReplacement in_use(folder / "a.txt");
  in_use.write("half");
  replace_file(folder / "a.txt", "newer");
  in_use.commit();
  EXPECT_EQ(test::files_in(folder.path()), (Files{{"a.txt", "half"}}));
}

TEST(NamedTemporary, IsNoLinkAndNoPipe) {
  const test::NoNamelessFiles named;
  const TemporaryFolder folder;
  folder.file("mine.txt", "mine");
  fs::create_symlink("mine.txt", folder / "a.txt.tmp-0");
  ASSERT_EQ(::mkfifo((folder / "a.txt.tmp-1").c_str(), 0600), 0);
  replace_file(folder / "a.txt", "new");
  EXPECT_EQ(content_of(folder / "mine.txt"), "mine");
  EXPECT_EQ(content_of(folder / "a.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "a.txt.tmp-0"));
}

}  // namespace
}  // namespace lapwing
