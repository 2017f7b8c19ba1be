// Every OBJ, OFF, PLY and STL file of Debian's libcgal-demo and assimp-testmodels, good and broken
// alike, through the mesh doctor and a small edit: it is edited, or refused in words.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kernels/moved_mesh.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/doctor/format.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "support/gpu.h"
#include "support/models.h"

namespace lapwing {
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

TEST_P(Corpus, EveryFileIsEditedOrRefusedInWords) {
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
      EXPECT_GT(std::string(error.what()).size(), 15U) << file;
    }
  }
  // What cannot be read or has no triangles is refused rightly; what can is nearly always solved.
  EXPECT_GT(edited, files.size() / 2);
  EXPECT_LE(20 * unsolvable, files.size());
}

INSTANTIATE_TEST_SUITE_P(Packages, Corpus, ::testing::Values("cgal", "assimp"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lapwing
