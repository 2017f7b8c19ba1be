// Every mesh of the packages with a tenth of its vertices held at each end of the longest axis.
#include <algorithm>
#include <numeric>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/topology.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::HasSubstr;

// Three to hold, three to move, and some between.
constexpr std::size_t kLeastVertices = 6;

// The last tenth goes aside by a tenth of the diagonal.
DeformRequest move_one_end(const Mesh& mesh) {
  const Bounds bounds = bounds_of(mesh.positions);
  Eigen::Index axis = 0;
  (bounds.max - bounds.min).maxCoeff(&axis);
  std::vector<Index> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return mesh.positions[a][axis] < mesh.positions[b][axis];
  });
  const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(3, order.size() / 10));
  DeformRequest request;
  request.roi = {AllVertices{}, "roi"};
  request.belt =
      RegionSpec{ListedVertices{make_vertex_set({order.begin(), order.begin() + tenth})}, "belt"};
  request.handles = {
      {{ListedVertices{make_vertex_set({order.end() - tenth, order.end()})}, "handle"},
       SimilarityMove{.translate = 0.1 * bounds.diagonal() * Vector3d::Unit((axis + 1) % 3)}}};
  return request;
}

bool is_refused(const Mesh& mesh, DeformRequest request) {
  request.parameters.loose = LoosePolicy::refuse;
  try {
    resolve_edit_region(request, mesh);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.find("anchor") != std::string::npos;
  }
  return false;
}

TEST(LooseOfModels, IsCarriedWithANoteWhereItWasRefused) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  LAPWING_NEEDS_MODELS(assimp, "assimp");
  std::vector<std::filesystem::path> files = cgal;
  files.insert(files.end(), assimp.begin(), assimp.end());
  std::size_t refused = 0;
  for (const auto& path : files) {
    const std::string name = path.filename().string();
    Mesh mesh;
    try {
      mesh = read_mesh(path);
      mesh.topology();
    } catch (const Error&) {
      continue;  // broken on purpose
    }
    if (mesh.vertex_count() < kLeastVertices) continue;
    const DeformRequest request = move_one_end(mesh);
    if (!is_refused(mesh, request)) continue;
    ++refused;
    try {
      const Deformed carried = deform(mesh, request);
      EXPECT_TRUE(carried.certificate.all_finite) << name;
      RecordProperty(name, carried.notes.empty() ? "" : carried.notes.front());
      EXPECT_THAT(carried.notes,
                  Contains(::testing::AnyOf(HasSubstr("loose component"), HasSubstr("seam edges"),
                                            HasSubstr("rotates as little"))))
          << name;
    } catch (const Error& error) {
      ADD_FAILURE() << name << ": " << error.what();
    }
  }
  EXPECT_GE(refused, 16U);
  RecordProperty("refused", static_cast<int>(refused));
}

}  // namespace
}  // namespace lapwing
