#include "lapwing/run/mesh_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"

namespace lapwing {
namespace {

class AMeshCache : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  MeshCache cache_;
};

TEST_F(AMeshCache, ReadsAFileOnce) {
  write_mesh(grid(3, 3), folder_.path() / "a.obj");
  const auto first = cache_.mesh(folder_.path(), "a.obj");
  std::filesystem::remove(folder_.path() / "a.obj");
  EXPECT_EQ(cache_.mesh(folder_.path(), "a.obj"), first);
}

TEST_F(AMeshCache, KeepsThoseAskedForLast) {
  for (int k = 0; k < 20; ++k) {
    write_mesh(grid(2, 2), folder_.path() / (std::to_string(k) + ".obj"));
  }
  const auto often = cache_.mesh(folder_.path(), "0.obj");
  const std::weak_ptr<const Mesh> once = cache_.mesh(folder_.path(), "1.obj");
  for (int k = 2; k < 20; ++k) {
    cache_.mesh(folder_.path(), std::to_string(k) + ".obj");
    EXPECT_EQ(cache_.mesh(folder_.path(), "0.obj"), often);
  }
  EXPECT_TRUE(once.expired());
}

TEST_F(AMeshCache, GivesWhatWasPutThereInPlaceOfAFile) {
  write_mesh(grid(3, 3), folder_.path() / "a.obj");
  cache_.put("a.obj", grid(5, 5));
  EXPECT_EQ(cache_.mesh(folder_.path(), "a.obj")->positions, grid(5, 5).positions);
}

TEST_F(AMeshCache, SaysWhichFileIsNotThere) {
  EXPECT_THROW(cache_.mesh(folder_.path(), "none.obj"), IoError);
}

TEST_F(AMeshCache, HasAllMeshesOfARecipeThatOpensNoFile) {
  const std::string coat = R"({"op": "coat", "source": "bumps", "source_patch": {"all": true},
    "target_patch": {"disk": {"center": 220, "radius": 0.3}}, "detail_size": 0.2})";
  const std::string transplant = R"({"op": "transplant", "part": "cap",
    "target_region": {"disk": {"center": 220, "radius": 0.3}}})";
  cache_.put("plain", grid(20, 20));
  cache_.put("bumps", grid(20, 20));
  cache_.put("cap", grid(8, 8));
  CpuKernels kernels;
  for (const std::string& step : {coat, transplant}) {
    const Recipe recipe =
        parse_recipe(R"({"lapwing": 1, "mesh": "plain", "steps": [)" + step + "]}", {}, "test");
    EXPECT_EQ(run_recipe(recipe, kernels, {}, {.meshes = &cache_})->report.steps.size(), 1U);
    EXPECT_THROW(run_recipe(recipe, kernels), std::runtime_error);
  }
}

}  // namespace
}  // namespace lapwing
