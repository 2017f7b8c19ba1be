#include "lapwing/batch/batch.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::Not;

using test::Files;

class ABatch : public ::testing::Test {
 protected:
  void SetUp() override {
    write_mesh(cylinder(8, 8, 0.5, 3.0), path("tube.obj"));
    write("bend.json", test::kBendTube);
    std::string lines;
    for (int k = 0; k < kJobs; ++k) lines += line(k) + "\n";
    write("jobs.jsonl", lines);
  }

  // Two regions in turn.
  static std::string line(int k) {
    const std::string n = std::to_string(k);
    return R"({"id": "j)" + n + R"(", "set": {"/steps/0/handles/0/move/translate": [0.0)" + n +
           R"(, 0.1, 0.2], "/steps/0/belt/box/max/2": )" + (k % 2 == 0 ? "0.4" : "0.9") + "}}";
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  Files files_of(const std::string& folder) const { return test::files_in(path(folder)); }
  BatchRequest request(const std::string& folder) const {
    return {.jobs = path("jobs.jsonl"),
            .recipe = path("bend.json"),
            .folder = path(folder),
            .threads = 2};
  }
  Files whole() const {
    run_batch(request("whole"));
    return files_of("whole");
  }
  BatchCount resume(const std::string& folder) const {
    BatchRequest again = request(folder);
    again.resume = true;
    return run_batch(again);
  }

  static constexpr int kJobs = 9;
  TemporaryFolder folder_;
};

TEST_F(ABatch, MakesTheBytesThatEachRecipeAloneMakes) {
  const Files files = whole();
  EXPECT_EQ(files.size(), kJobs + 1U) << "and results.jsonl";
  CpuKernels kernels;
  const JobFile jobs(path("jobs.jsonl"), path("bend.json"), "");
  fs::create_directory(path("alone"));
  for (const Job& job : jobs.jobs()) {
    const auto result = run_recipe(jobs.recipe_of(job), kernels);
    save_result(*result, path("alone") / (job.id + ".ply"));
  }
  for (const auto& [name, bytes] : files_of("alone")) EXPECT_EQ(files.at(name), bytes) << name;
}

TEST_F(ABatch, IsTheSameForAnyNumberOfThreads) {
  BatchRequest alone = request("alone");
  alone.threads = 1;
  run_batch(alone);
  BatchRequest many = request("many");
  many.threads = 7;
  run_batch(many);
  EXPECT_EQ(files_of("alone"), files_of("many"));
}

TEST_F(ABatch, IsTheSameFromShardsOfAnyNumber) {
  const Files expected = whole();
  for (const std::size_t count : {1U, 2U, 4U, 20U}) {
    const std::string folder = "shards" + std::to_string(count);
    for (std::size_t k = count; k >= 1; --k) {
      BatchRequest part = request(folder);
      part.shard = Shard{k, count};
      EXPECT_TRUE(run_batch(part).is_complete());
    }
    const BatchCount merged = resume(folder);
    EXPECT_EQ(merged.before, std::size_t{kJobs});
    EXPECT_EQ(files_of(folder), expected);
  }
}

TEST_F(ABatch, GoesOnAfterItWasEnded) {
  const Files expected = whole();
  int ended = 0;
  for (BatchCount count; !count.is_complete() || count.jobs == 0; ++ended) {
    BatchRequest again = request("ended");
    again.resume = true;
    std::size_t begun = 0;
    count = run_batch(again, {[&](const BatchCount& now) { begun = now.done - now.before; },
                              [&] { return begun < 2; }});
    ASSERT_LT(ended, kJobs);
  }
  EXPECT_GT(ended, 2);
  EXPECT_EQ(files_of("ended"), expected);
}

TEST_F(ABatch, DoesAgainWhatHasNoWholeLineOrNoFile) {
  const Files expected = whole();
  const std::string results = expected.at("results.jsonl");
  for (const std::size_t cut :
       {std::size_t{0}, std::size_t{10}, results.size() / 2, results.size() - 1}) {
    write("whole/results.jsonl", results.substr(0, cut));
    write("whole/j3.ply.tmp-4", "half");
    fs::remove(path("whole/j0.ply"));
    EXPECT_LT(resume("whole").before, std::size_t{kJobs});
    EXPECT_EQ(files_of("whole"), expected) << "cut after " << cut;
  }
}

TEST_F(ABatch, DoesNothingAgainThatIsDoneAndAllThatIsAskedForOtherwise) {
  whole();
  EXPECT_EQ(resume("whole").before, std::size_t{kJobs});
  write("jobs.jsonl", line(0) + "\n" + R"({"id": "j1"})" + "\n");
  EXPECT_EQ(resume("whole").before, 1U);
  BatchRequest displaced = request("whole");
  displaced.resume = true;
  displaced.output.displacements = Scalar::float32;
  EXPECT_EQ(run_batch(displaced).before, 0U);
}

TEST_F(ABatch, RefusesAFolderWithResultsUnlessItGoesOnFromThem) {
  whole();
  EXPECT_THAT(error_message<InputError>([&] { run_batch(request("whole")); }),
              HasSubstr("--resume"));
}

TEST_F(ABatch, ALineThatFailsStopsNoOther) {
  write("jobs.jsonl", line(0) + "\n" + R"({"id": "cut", "set": {"/st)" + "\n" + line(1) + "\n" +
                          R"({"id": "bad", "set": {"/steps/3/x": 1}})" + "\n" +
                          R"({"id": "far", "set": {"/steps/0/belt": {"vertices": [99999]}}})" +
                          "\n" + R"({"id": "none", "set": {"/mesh": "none.obj"}})" + "\n" +
                          line(2) + "\n");
  const BatchCount count = run_batch(request("out"));
  EXPECT_EQ(count.done, 3U);
  EXPECT_EQ(count.failed, 4U);
  const Files files = files_of("out");
  std::istringstream failed(files.at("failed.jsonl"));
  std::vector<std::string> lines;
  for (std::string each; std::getline(failed, each);) lines.push_back(each);
  EXPECT_THAT(
      lines,
      ElementsAre(AllOf(HasSubstr(R"("line":2)"), HasSubstr("syntax error")),
                  AllOf(HasSubstr(R"("id":"bad","line":4)"), HasSubstr("/steps is a list of 1")),
                  AllOf(HasSubstr(R"("id":"far","line":5)"), HasSubstr("99999")),
                  AllOf(HasSubstr(R"("id":"none","line":6)"), HasSubstr("none.obj"))));
  write("jobs.jsonl", line(0) + "\n");
  resume("out");
  EXPECT_THAT(files_of("out"), Not(Contains(Key("failed.jsonl"))));
}

TEST_F(ABatch, WritesDisplacementsBesideOneRestMesh) {
  BatchRequest displaced = request("out");
  displaced.output.displacements = Scalar::float64;
  run_batch(displaced);
  whole();
  const Mesh rest = read_mesh(path("out/rest.ply"));
  const Mesh moved = read_mesh(path("whole/j1.ply"));
  const NumberTable table = read_number_table(path("out/j1.npy"));
  ASSERT_EQ(table.row_count(), rest.vertex_count());
  for (std::size_t v = 0; v < rest.vertex_count(); ++v) {
    const Eigen::Vector3d expected = moved.positions[v] - rest.positions[v];
    EXPECT_EQ(Eigen::Vector3d(table.row(v)[0], table.row(v)[1], table.row(v)[2]), expected);
  }
}

TEST_F(ABatch, GivesAnotherMeshARestMeshOfItsOwn) {
  write_mesh(cylinder(10, 8, 0.5, 3.0), path("fine.obj"));
  write("jobs.jsonl", line(0) + "\n" + R"({"id": "f", "set": {"/mesh": "fine.obj"}})" + "\n");
  BatchRequest displaced = request("out");
  displaced.output.displacements = Scalar::float32;
  run_batch(displaced);
  EXPECT_THAT(files_of("out"), Contains(Key(::testing::StartsWith("rest-fine-"))));
}

TEST_F(ABatch, WritesNothingOverWhatItReads) {
  write("jobs.jsonl", R"({"id": "tube"})");
  BatchRequest here = request(".");
  here.output.extension = "obj";
  EXPECT_EQ(run_batch(here).failed, 1U);
}

TEST_F(ABatch, DoesNotTakeItsJobsFromWhereItsResultsGo) {
  fs::create_directory(path("out"));
  for (const std::string name : {"results.jsonl", "failed.jsonl", "failed-2-of-3.jsonl"}) {
    fs::copy_file(path("jobs.jsonl"), path("out/" + name));
    BatchRequest wrong = request("out");
    wrong.jobs = path("out/" + name);
    wrong.resume = true;
    EXPECT_THROW(run_batch(wrong), InputError) << name;
    EXPECT_EQ(content_of(path("out/" + name)), content_of(path("jobs.jsonl")));
    fs::remove(path("out/" + name));
  }
}

TEST_F(ABatch, NamesWhatIsCarriedAfterTheJob) {
  write_mesh(cylinder(6, 2, 0.2, 1.0), path("hat.obj"));
  write("jobs.jsonl", R"({"id": "a", "set": {"/steps/0/carry": ["hat.obj"]}})");
  EXPECT_EQ(run_batch(request("out")).done, 1U);
  EXPECT_THAT(files_of("out"), Contains(Key("a-hat-carried.obj")));
}

}  // namespace
}  // namespace lapwing
