// A process that edits all day takes no more memory than after its first edits.
#include <cstdlib>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "batch/bent_tubes.h"
#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/render/picture_request.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"
#include "lapwing/run/run_report.h"
#include "lapwing/run/session.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "support/memory_in_use.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

int edits(int usual) {
  return test::how_often("LAPWING_EDITS", usual);
}

class LongLife : public ::testing::Test {
 protected:
  void SetUp() override {
    write_mesh(cylinder(12, 20, 0.5, 3.0), folder_ / "tube.obj");
    write_mesh(icosphere(2), folder_ / "host.ply");
    write_mesh(cylinder(8, 5, 0.2, 0.8), folder_ / "part.ply");
  }

  // Of the k-th edit: moves and settings differ from one to the next.
  Recipe bend(int k) const {
    std::string text = test::kBendTube;
    const std::string move = "[0, 0, 0.5]";
    text.replace(text.find(move), move.size(), "[" + std::to_string(0.01 * (k % 50)) + ", 0, 0.3]");
    return parse_recipe(text, folder_.path(), "test");
  }

  void save(RunResult& result) const {
    save_result(result, folder_ / "out.ply");
    replace_file(folder_ / "report.json", to_json(result.report));
  }

  // What lists of free blocks and the like may come to.
  static constexpr std::size_t kSlack = std::size_t{256} << 10U;

  // The software driver keeps scenes of a quarter of a MiB for use again, more of them when its
  // threads wait for a busy processor; after hundreds of edits there are as many as ever.
  static constexpr std::size_t kDeviceSlack = std::size_t{2} << 20U;

  // Does `edit` so often, and looks at the memory after a tenth of them and at the end.
  static void expect_flat(int count, const std::function<void(int)>& edit,
                          std::size_t slack = kSlack) {
    const int first = std::max(20, count / 10);
    for (int k = 0; k < first; ++k) edit(k);
    const std::size_t before = test::memory_in_use();
    ASSERT_GT(before, 0U);
    for (int k = first; k < count; ++k) edit(k);
    EXPECT_LE(test::memory_in_use(), before + slack) << "after " << count << " edits";
  }

  TemporaryFolder folder_;
};

TEST_F(LongLife, OfEditsFromFileToFile) {
  CpuKernels kernels;
  expect_flat(edits(500), [&](int k) { save(*run_recipe(bend(k), kernels)); });
}

TEST_F(LongLife, OfASessionWithMoreRegionsThanItKeeps) {
  CpuKernels kernels;
  const MeshCache meshes;
  Session session(kernels, meshes);
  expect_flat(edits(500), [&](int k) {
    Recipe recipe = bend(k);
    auto& deform = std::get<DeformRequest>(recipe.steps[0]);
    deform.parameters.constraint_weight = 1.0 + k % 7;
    save(*session.run(recipe));
  });
}

TEST_F(LongLife, OfTransplants) {
  CpuKernels kernels;
  const Recipe recipe = parse_recipe(
      R"({"lapwing": 1, "mesh": "host.ply", "steps": [{"op": "transplant", "part": "part.ply",
          "target_region": {"disk": {"near": [0, 0, 1], "radius": 0.5}}}]})",
      folder_.path(), "test");
  expect_flat(edits(60), [&](int) { save(*run_recipe(recipe, kernels)); });
}

TEST_F(LongLife, OnTheDeviceWithPictures) {
  LAPWING_NEEDS_GPU();
  if (std::getenv("LAPWING_VALIDATION") != nullptr) {
    GTEST_SKIP() << "the validation layers keep some of all that they have seen";
  }
  VulkanOptions options;
  options.frames_on_device = true;
  VulkanKernels kernels(options);
  const auto edit = [&](int k) {
    const auto result = run_recipe(bend(k), kernels);
    Surface surface(kernels.context(), result->original, result->mesh.topology());
    const SurfacePaint paint(surface);
    surface.place(result->mesh.positions);
    PictureRequest picture;
    picture.width = picture.height = 32;
    render_image(surface, paint, picture.camera(result->mesh.positions, false), picture.options());
  };
  expect_flat(edits(300), edit, kDeviceSlack);
}

}  // namespace
}  // namespace lapwing
