#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"
#include "support/bent_tube.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using test::bend;
using test::largest_distance;

// Returns the mesh with each triangle of `chosen` split into four triangles, and each neighbour of
// these triangles split into two or three.
Mesh refined(const Mesh& mesh, std::span<const char> chosen) {
  std::map<std::pair<Index, Index>, Index> middles;
  Mesh finer;
  finer.positions = mesh.positions;
  const auto edge = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.face(f);
    for (std::size_t k = 0; chosen[f] != 0 && k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if (!middles.emplace(edge(a, b), static_cast<Index>(finer.vertex_count())).second) continue;
      finer.positions.emplace_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    }
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Index> corners;  // those of the triangle and the middles of its edges
    const auto t = mesh.face(f);
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(t[k]);
      const auto middle = middles.find(edge(t[k], t[(k + 1) % 3]));
      if (middle != middles.end()) corners.push_back(middle->second);
    }
    if (corners.size() == 6) {
      for (const std::size_t k : {0U, 2U, 4U}) {
        finer.add_face(std::array{corners[k], corners[k + 1], corners[(k + 5) % 6]});
      }
      finer.add_face(std::array{corners[1], corners[3], corners[5]});
      continue;
    }
    // Add a fan around the midpoint of an edge, or the unchanged triangle.
    const auto first = std::find_if(corners.begin(), corners.end(),
                                    [&](Index v) { return v >= mesh.vertex_count(); });
    if (first != corners.end()) std::rotate(corners.begin(), first, corners.end());
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      finer.add_face(std::array{corners[0], corners[k], corners[k + 1]});
    }
  }
  return finer;
}

// A surface bends in the same way if all its triangles, or those of one half, are refined. The
// detail length is at least an edge of the coarse mesh.
TEST(RefinedMesh, IsBentAsTheCoarseOne) {
  const auto result_at = [](const Mesh& mesh, std::size_t count) {
    const EditRegion region = test::ends_of_cylinder(mesh, 0.31, 2.69);
    const Topology& topology = mesh.topology();
    CpuKernels kernels;
    DeformOptions options;
    options.detail_length = 0.1;
    const DeformSolver deformer(mesh.positions, topology, region, options, kernels);
    Positions result = deformer.solve(std::array{bend()}).positions;
    result.resize(count);
    return result;
  };
  const Mesh coarse = cylinder(24, 31, 0.5, 3.0);
  const double diagonal = bounds_of(coarse.positions).diagonal();
  const std::size_t count = coarse.vertex_count();
  const Positions expected = result_at(coarse, count);
  const Mesh once = subdivide(coarse);
  EXPECT_LT(largest_distance(expected, result_at(once, count)), 0.01 * diagonal);
  EXPECT_LT(largest_distance(expected, result_at(subdivide(once), count)), 0.01 * diagonal);
  std::vector<char> upper(coarse.face_count(), 0);
  for (std::size_t f = 0; f < upper.size(); ++f) {
    upper[f] = coarse.positions[coarse.face(f)[0]].z() > 1.5 ? 1 : 0;
  }
  EXPECT_LT(largest_distance(expected, result_at(refined(coarse, upper), count)), 0.01 * diagonal);
}

}  // namespace
}  // namespace lapwing
