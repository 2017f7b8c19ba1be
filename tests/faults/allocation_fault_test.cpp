// Tests that an edit reports an error or gives the same result if an allocation fails.
// LeakSanitizer checks that no memory leaks.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>

#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "coating/coating_scenes.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"
#include "run/transplant_runs.h"
#include "support/failing_new.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using test::FailingNew;

// The number of runs. One allocation fails in each run, and this number suffices to reach every
// loop. With LAPWING_EVERY_ALLOCATION, there is a run for every allocation.
constexpr long kRuns = 700;

void meet_everywhere(const std::function<Positions()>& work) {
  const Positions undisturbed = work();
  long calls = 0;
  {
    const FailingNew counting(-1);
    work();
    calls = FailingNew::calls();
  }
  const bool all = std::getenv("LAPWING_EVERY_ALLOCATION") != nullptr;
  const long stride = all ? 1 : std::max(1L, calls / kRuns);
  long refused = 0;
  for (long k = 0; k < calls; k += stride) {
    try {
      const FailingNew failing(k);
      ASSERT_EQ(work(), undisturbed) << "call " << k << " of " << calls;
    } catch (const std::bad_alloc&) {
      ++refused;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(work(), undisturbed) << "afterwards";
  std::printf("%ld calls, one in %ld refused, %ld runs ended by that\n", calls, stride, refused);
}

// The recipe is parsed in advance, because destructors of the JSON library allocate memory and
// terminate the program if an allocation fails.
void meet_everywhere(const Recipe& recipe) {
  CpuKernels kernels;
  meet_everywhere([&] { return run_recipe(recipe, kernels)->mesh.positions; });
}

class AllocationFault : public ::testing::Test {
 protected:
  Recipe recipe_of(const std::string& mesh, const std::string& step) const {
    return parse_recipe(R"({"lapwing": 1, "mesh": ")" + mesh + R"(", "steps": [)" + step + "]}",
                        folder_.path(), "test");
  }

  TemporaryFolder folder_;
};

TEST_F(AllocationFault, OfAnEditFromFileToFile) {
  write_mesh(cylinder(8, 6, 0.5, 3.0), folder_ / "tube.obj");
  folder_.file("out.ply", "old");
  const Recipe recipe = parse_recipe(test::kBendTube, folder_.path(), "test");
  CpuKernels kernels;
  meet_everywhere([&] {
    const auto result = run_recipe(recipe, kernels);
    save_result(*result, folder_ / "out.ply");
    return result->mesh.positions;
  });
  EXPECT_EQ(test::files_in(folder_.path()).size(), 2U);
}

TEST_F(AllocationFault, OfACoatOnAPatchThatIsRemeshed) {
  write_mesh(test::relief(10, 3.0, 0.03), folder_ / "source.ply");
  write_mesh(test::relief(8, 1.0, 0.1), folder_ / "target.ply");
  meet_everywhere(recipe_of("target.ply", R"({"op": "coat", "source": "source.ply",
      "source_patch": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.3}},
      "target_patch": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.3}}, "detail_size": 0.5})"));
}

TEST_F(AllocationFault, OfATransplantOfAFingerOntoASphere) {
  write_mesh(icosphere(2), folder_ / "host.ply");
  write_mesh(test::finger(8, 5, 0.2, 0.8), folder_ / "part.ply");
  meet_everywhere(recipe_of("host.ply", R"({"op": "transplant", "part": "part.ply",
      "target_region": {"disk": {"near": [0, 0, 1], "radius": 0.5}}})"));
}

}  // namespace
}  // namespace lapwing
