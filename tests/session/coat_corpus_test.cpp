// Debian's meshes as targets and as sources of a coat: every one is coated sensibly or refused in
// words.
#include <filesystem>

#include <gmock/gmock.h>

#include "lapwing/base/errors.h"
#include "session/coat_runs.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

namespace fs = std::filesystem;

// Larger files take longer and show nothing else.
constexpr std::uintmax_t kLargestFile = 500'000;
constexpr double kCorpusHeight = 0.02;

// The largest disk within a quarter of the mesh's diagonal of a corner of its bounds: often a horn.
RegionSpec disk_at_corner(const Bounds& bounds) {
  const RegionSpec near{GeodesicDisk{bounds.max, 0.25 * bounds.diagonal()}};
  return {DiskInRegion{{near}}};
}

class CoatCorpus : public CoatRuns, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override { write(relief(24, 4.0, kCorpusHeight), "bumps.ply"); }

  // Of the target's diagonal. Throws `Error` when the step is refused.
  double displacement(const fs::path& target, const CoatStep& step) {
    const auto result = run_recipe({target, {step}, "", folder_.path()}, cpu_);
    for (const Index v : result->region.roi) {
      EXPECT_TRUE(result->mesh.positions[v].allFinite()) << target << ", vertex " << v;
    }
    return result->report.steps[0].coat->largest_displacement / result->report.bounds.diagonal();
  }

  // Whether it was done.
  bool is_coated_or_refused_in_words(const fs::path& target, const CoatStep& step) {
    try {
      EXPECT_LT(displacement(target, step), 0.25) << target << " from " << step.source.mesh;
      return true;
    } catch (const Error& error) {
      EXPECT_GT(std::string(error.what()).size(), 15U) << target << " from " << step.source.mesh;
      return false;
    }
  }
};

TEST_P(CoatCorpus, EveryMeshIsCoatedOrRefusedInWords) {
  LAPWING_NEEDS_MODELS(files, GetParam());
  std::size_t coated = 0;
  for (const fs::path& file : files) {
    if (fs::file_size(file) > kLargestFile) continue;
    Bounds bounds;
    try {
      bounds = bounds_of(read_mesh(file).positions);
    } catch (const Error&) {
      continue;  // what the reader refuses is another test's
    }
    if (!(bounds.diagonal() > 0.0)) continue;
    CoatStep onto;
    onto.source.mesh = "bumps.ply";
    onto.source.patch = {AllVertices{}};
    onto.target_patch = disk_at_corner(bounds);
    onto.source.detail_size = 0.5;
    if (is_coated_or_refused_in_words(file, onto)) ++coated;
    CoatStep from;
    from.source.mesh = file;
    from.source.patch = disk_at_corner(bounds);
    from.target_patch = {AllVertices{}};
    from.source.detail_size = 0.1 * bounds.diagonal();
    if (is_coated_or_refused_in_words(folder_.path() / "bumps.ply", from)) ++coated;
  }
  EXPECT_GT(coated, 10U);
}

INSTANTIATE_TEST_SUITE_P(Packages, CoatCorpus, ::testing::Values("cgal", "assimp"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lapwing::test
