// A coat of a surface onto itself gives the surface back, on whatever triangles: taken off as the
// target's own detail, its detail comes back as the source's coating.
#include <filesystem>

#include "lapwing/coating/fairing.h"
#include "run/coat_runs.h"
#include "support/bent_tube.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

constexpr Index kOwnCells = 24;
constexpr double kOwnDetail = 0.5;

class CoatOntoItself : public CoatRuns, public ::testing::WithParamInterface<MappedSampling> {
 protected:
  /// Onto the patch of `path` what is smaller than `detail` there, at once or fading in.
  void expect_the_same_mesh(const std::filesystem::path& path, const RegionSpec& patch,
                            double detail) {
    for (const auto& transition : {std::optional<Transition>(), std::optional(Transition{})}) {
      CoatStep step;
      step.source.patch = patch;
      step.source.detail_size = detail;
      step.source.sampling.sampling = GetParam();
      step.target_patch = patch;
      step.parameters.smooth_target = detail;
      step.parameters.transition = transition;
      step.parameters.remesh = Remeshing::none;
      const auto result = run_recipe({path, {step}, "", folder_.path()}, cpu_);
      const double height =
          relief_height(result->original, result->mesh.topology(), result->region.roi, detail);
      EXPECT_GT(height, 0.0);
      EXPECT_LT(largest_distance(result->mesh.positions, result->original), 0.02 * height)
          << path << (transition ? " at once" : " fading in");
      const auto inside = vertex_mask(result->original.size(), result->region.roi);
      for (Index v = 0; v < result->original.size(); ++v) {
        if (inside[v] != 0) continue;
        EXPECT_EQ(result->mesh.positions[v], result->original[v]) << path << ", vertex " << v;
      }
    }
  }

 private:
  static double relief_height(const Positions& positions, const Topology& topology,
                              const VertexSet& patch, double detail) {
    const Positions smooth = smooth_around(patch, detail, positions, topology,
                                           LaplacianWeights::cotangent, "detail_size");
    return largest_distance(positions, smooth);
  }
};

TEST_P(CoatOntoItself, GivesAReliefBack) {
  write(relief(kOwnCells, 4.0, 0.01), "relief.ply");
  const RegionSpec middle{GeodesicDisk{Eigen::Vector3d(0.5, 0.5, 0.0), 0.3}};
  expect_the_same_mesh(folder_.path() / "relief.ply", middle, kOwnDetail);
}

TEST_P(CoatOntoItself, GivesASteepReliefOnUnevenTrianglesBack) {
  write(uneven_relief(kOwnCells, 4.0, 0.04, 1), "uneven.ply");
  const std::filesystem::path path = folder_.path() / "uneven.ply";
  const RegionSpec middle{GeodesicDisk{Eigen::Vector3d(0.5, 0.5, 0.0), 0.3}};
  expect_the_same_mesh(path, {AllVertices{}}, kOwnDetail);
  expect_the_same_mesh(path, middle, kOwnDetail);
}

TEST_P(CoatOntoItself, GivesPatchesOfScansBack) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  std::size_t found = 0;
  for (const std::filesystem::path& file : files) {
    if (file.filename() != "elephant.off" && file.filename() != "lion-head.off") continue;
    ++found;
    const Bounds bounds = bounds_of(read_mesh(file).positions);
    for (const Eigen::Vector3d& near : {bounds.center(), bounds.max}) {
      const RegionSpec disk{GeodesicDisk{near, 0.2 * bounds.diagonal()}};
      expect_the_same_mesh(file, {DiskInRegion{{disk}}}, 0.08 * bounds.diagonal());
    }
  }
  EXPECT_EQ(found, 2U);
}

INSTANTIATE_TEST_SUITE_P(Samplings, CoatOntoItself,
                         ::testing::Values(MappedSampling::one_ring, MappedSampling::linear),
                         [](const auto& test) {
                           return test.param == MappedSampling::linear ? "linear" : "one_ring";
                         });

}  // namespace
}  // namespace lapwing::test
