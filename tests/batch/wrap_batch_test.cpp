// Batches that wrap one template onto many scans.
#include <cmath>
#include <cstring>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "batch/bent_tubes.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/batch/batch.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class AWrapBatch : public ::testing::Test {
 protected:
  void SetUp() override {
    write_mesh(icosphere(1), path("ball.ply"));
    for (int k = 0; k < 2; ++k) {
      Mesh scan = icosphere(2);
      for (Eigen::Vector3d& p : scan.positions) p.z() *= 1.2 + 0.2 * k;
      write_mesh(scan, path("scan" + std::to_string(k) + ".ply"));
    }
    write("wrap.json", R"({"lapwing": 1, "mesh": "ball.ply", "steps": [
      {"op": "wrap", "scan": "", "aligned": true}]})");
    write("jobs.jsonl", R"({"id": "a", "set": {"/steps/0/scan": "scan0.ply"}}
{"id": "gone", "set": {"/steps/0/scan": "gone.ply"}}

{"id": "b", "set": {"/steps/0/scan": "scan1.ply"}}
)");
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  BatchRequest request() const {
    return {.jobs = path("jobs.jsonl"),
            .recipe = path("wrap.json"),
            .folder = path("out"),
            .vertices = path("vertices.npy"),
            .threads = 2};
  }
  std::string bytes(const std::string& name) const {
    return test::files_in(folder_.path()).at(name);
  }

  TemporaryFolder folder_;
};

TEST_F(AWrapBatch, WritesTheVerticesOfAllResultsInTheOrderOfTheJobs) {
  const BatchCount count = run_batch(request());
  EXPECT_EQ(count.done, 2U);
  EXPECT_EQ(count.failed, 1U);
  const std::size_t n = icosphere(1).vertex_count();
  const std::string found = bytes("vertices.npy");
  EXPECT_THAT(found, HasSubstr("'descr': '<f8', 'fortran_order': False, 'shape': (3, " +
                               std::to_string(n) + ", 3)"));
  std::vector<double> numbers(9 * n);
  ASSERT_EQ(found.size() % 64, (72 * n) % 64) << "the header ends at a multiple of 64";
  std::memcpy(numbers.data(), found.data() + found.size() - 72 * n, 72 * n);
  const auto row = [&](std::size_t k, std::size_t v) {
    return Eigen::Vector3d(numbers.data() + 3 * (k * n + v));
  };
  const Mesh a = read_mesh(path("out/a.ply"));
  const Mesh b = read_mesh(path("out/b.ply"));
  EXPECT_NEAR(bounds_of(a.positions).max.z(), 1.2, 0.02);
  EXPECT_NEAR(bounds_of(b.positions).max.z(), 1.4, 0.05);
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_EQ(row(0, v), a.positions[v]);
    EXPECT_TRUE(std::isnan(row(1, v).x()));
    EXPECT_EQ(row(2, v), b.positions[v]);
  }
}

TEST_F(AWrapBatch, ReportsDistancesAndFailures) {
  run_batch(request());
  const test::Files files = test::files_in(path("out"));
  const auto first = nlohmann::json::parse(
      files.at("results.jsonl").substr(0, files.at("results.jsonl").find('\n')));
  EXPECT_EQ(first["id"], "a");
  EXPECT_EQ(first["wrap"]["coverage"], 1.0);
  EXPECT_THAT(files.at("failed.jsonl"), AllOf(HasSubstr("\"gone\""), HasSubstr("gone.ply")));
}

TEST_F(AWrapBatch, IsCompletedByResumingIt) {
  run_batch(request());
  const std::string with_hole = bytes("vertices.npy");
  fs::copy_file(path("scan0.ply"), path("gone.ply"));
  fs::remove(path("vertices.npy"));
  BatchRequest again = request();
  again.resume = true;
  EXPECT_EQ(run_batch(again).before, 2U);
  const std::string whole = bytes("vertices.npy");
  const std::size_t row = icosphere(1).vertex_count() * 24;
  const auto rows = [&](const std::string& text, std::size_t k) {
    return text.substr(text.size() - (3 - k) * row, row);
  };
  EXPECT_EQ(rows(whole, 1), rows(whole, 0));
  EXPECT_EQ(rows(whole, 2), rows(with_hole, 2));
}

TEST_F(AWrapBatch, NeedsResultsWithEquallyManyVertices) {
  write("wrap.json", R"({"lapwing": 1, "mesh": "ball.ply", "steps": [{"op": "subdivide"}]})");
  write("jobs.jsonl",
        R"({"id": "once"}
{"id": "twice", "set": {"/steps/0/times": 2}})");
  EXPECT_THAT(error_message<InputError>([&] { run_batch(request()); }),
              AllOf(HasSubstr("twice.ply has 642 vertices"), HasSubstr("once.ply has 162")));
  BatchRequest other = request();
  other.vertices = path("vertices.csv");
  EXPECT_THAT(error_message<InputError>([&] { run_batch(other); }), HasSubstr("expected a .npy"));
}

}  // namespace
}  // namespace lapwing
