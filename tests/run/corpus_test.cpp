// Every OBJ, OFF, PLY and STL file of Debian's libcgal-demo and assimp-testmodels, good and broken
// alike, through the mesh doctor, a small edit and a coat: it is edited, or refused.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/moved_mesh.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/doctor/format.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/coat_runs.h"
#include "support/gpu.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEdited = 400;

// Up to kMostEdited vertices around one of the largest component, breadth first: the first ones are
// the handle, the last fifth, or all the others if they are few, the belt.
EditRegion small_region(const Topology& topology) {
  const Components components = connected_components(topology.rings);
  std::vector<std::size_t> sizes(components.count, 0);
  for (const Index c : components.of_vertex) ++sizes[c];
  const auto largest =
      static_cast<Index>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  const auto seed = static_cast<Index>(
      std::find(components.of_vertex.begin(), components.of_vertex.end(), largest) -
      components.of_vertex.begin());
  std::vector<Index> order{seed};
  std::vector<char> seen(topology.vertex_count(), 0);
  seen[seed] = 1;
  for (std::size_t at = 0; at < order.size() && order.size() < kMostEdited; ++at) {
    for (const Index w : topology.rings[order[at]]) {
      if (seen[w] == 0) order.push_back(w);
      seen[w] = 1;
    }
  }
  const auto size = static_cast<std::ptrdiff_t>(order.size());
  const auto handle = std::max<std::ptrdiff_t>(size / 20, 1);
  const auto belt = std::min(std::max<std::ptrdiff_t>(size / 5, 7), size - handle);
  EditRegion region;
  region.handles.emplace_back(order.begin(), order.begin() + handle);
  region.belt.assign(order.end() - belt, order.end());
  region.roi = std::move(order);
  std::sort(region.roi.begin(), region.roi.end());
  std::sort(region.belt.begin(), region.belt.end());
  std::sort(region.handles[0].begin(), region.handles[0].end());
  return region;
}

// What became of the file, in words; throws `Error` when it was refused.
std::string check_and_edit(const fs::path& path, VulkanKernels& kernels) {
  const Mesh mesh = read_mesh(path);
  const Topology& topology = mesh.topology();
  EXPECT_FALSE(format(check(mesh)).empty());
  if (topology.triangles.empty()) throw InputError("no triangles to edit");
  const double diagonal = bounds_of(mesh.positions).diagonal();
  const DeformSolver deformer(mesh.positions, topology, small_region(topology), {}, kernels);
  const std::array motions{
      Eigen::Affine3d(Eigen::Translation3d(0.01 * diagonal, 0.02 * diagonal, 0.0))};
  const DeformResult result = deformer.solve(motions);
  const auto response = deformer.response();
  test::MovedMesh shown(kernels.context(), mesh.positions, topology, response->columns());
  shown.blend(Drag(response).parameters(motions));
  for (const Eigen::Vector3d& p : shown.positions()) {
    if (!p.allFinite()) return "NOT FINITE ON THE DEVICE";
  }
  return result.certificate.all_finite ? "edited" : "NOT FINITE";
}

class Corpus : public ::testing::TestWithParam<const char*> {};

TEST_P(Corpus, EveryFileIsEditedOrRefused) {
  LAPWING_NEEDS_GPU();
  LAPWING_NEEDS_MODELS(files, GetParam());
  VulkanKernels kernels;
  std::size_t edited = 0;
  std::size_t unsolvable = 0;
  for (const fs::path& file : files) {
    std::printf("%s: ", file.filename().c_str());
    std::fflush(stdout);  // a crash then names its file
    try {
      const std::string outcome = check_and_edit(file, kernels);
      std::printf("%s\n", outcome.c_str());
      EXPECT_EQ(outcome, "edited") << file;
      ++edited;
    } catch (const Error& error) {
      if (dynamic_cast<const SolverError*>(&error) != nullptr) ++unsolvable;
      std::printf("refused: %s\n", error.what());
    }
  }
  // What cannot be read or has no triangles is refused rightly; what can is nearly always solved.
  EXPECT_GT(edited, files.size() / 2);
  EXPECT_LE(20 * unsolvable, files.size());
}

INSTANTIATE_TEST_SUITE_P(Packages, Corpus, ::testing::Values("cgal", "assimp"),
                         [](const auto& test) { return std::string(test.param); });

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

  // Returns whether the mesh was coated; otherwise it was refused.
  bool is_coated(const fs::path& target, const CoatStep& step) {
    try {
      EXPECT_LT(displacement(target, step), 0.25) << target << " from " << step.source.mesh;
      return true;
    } catch (const Error&) {
      return false;
    }
  }
};

TEST_P(CoatCorpus, EveryMeshIsCoatedOrRefused) {
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
    if (is_coated(file, onto)) ++coated;
    CoatStep from;
    from.source.mesh = file;
    from.source.patch = disk_at_corner(bounds);
    from.target_patch = {AllVertices{}};
    from.source.detail_size = 0.1 * bounds.diagonal();
    if (is_coated(folder_.path() / "bumps.ply", from)) ++coated;
  }
  EXPECT_GT(coated, 10U);
}

INSTANTIATE_TEST_SUITE_P(Packages, CoatCorpus, ::testing::Values("cgal", "assimp"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lapwing::test
