#include "lapwing/render/surface.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

// On a software device, the CPU moves the surface if memory is mapped; otherwise, the device does.
class SurfaceUploads : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    gpu::ContextOptions options;
    options.map_device_memory = GetParam();
    context = std::make_shared<gpu::Context>(options);
  }

  std::uint64_t uploaded() const { return context->transfers().uploaded; }
  // Returns the number of bytes for moving vertices: their positions and indices, and the indices
  // of the vertices whose normals change.
  std::uint64_t moving_bytes(std::span<const Index> moving) const {
    const std::size_t affected = with_ring_neighbours(moving, topology.rings).size();
    constexpr std::uint64_t kNoParameters = 16;
    return moving.size() * (sizeof(Vec4) + sizeof(Index)) + affected * sizeof(Index) +
           2 * kNoParameters;
  }

  const Mesh mesh = icosphere(3);
  const Topology topology = build_topology(mesh);
  std::shared_ptr<gpu::Context> context;
};

TEST_P(SurfaceUploads, MeshOnceAndNothingForAStillSurface) {
  Surface surface(context, mesh.positions, topology);
  const std::uint64_t opened = uploaded();
  const std::uint64_t vertices = mesh.vertex_count();
  const std::uint64_t corners = topology.vertex_triangles.values.size();
  // The data are positions, triangles and the fans around the vertices. A fan has one more corner
  // than triangles. Each fan has a start index, and the last one also an end index. The CPU does
  // not need a list of all vertices.
  const bool is_mapped = !gpu::Buffer(*context, "probe", 16).mapped().empty();
  const std::uint64_t list = is_mapped ? 0 : vertices * sizeof(Index);
  EXPECT_EQ(opened, vertices * sizeof(Vec4) + topology.triangles.size() * sizeof(Triangle) +
                        (corners + 2 * vertices + 1) * sizeof(Index) + list);
  surface.place(mesh.positions);
  surface.finish();
  EXPECT_EQ(uploaded(), opened);
}

TEST_P(SurfaceUploads, OnlyVerticesThatAreElsewhere) {
  Surface surface(context, mesh.positions, topology);
  const std::uint64_t opened = uploaded();
  const std::vector<Index> moving{3, 17, 100};
  Positions moved = mesh.positions;
  for (const Index v : moving) moved[v] *= 1.5;
  surface.place(moved);
  EXPECT_LT(test::largest_distance(surface.positions(), moved), 1e-6);
  EXPECT_EQ(uploaded() - opened, moving_bytes(moving));
}

TEST_P(SurfaceUploads, OnlyMovingVerticesWhereADragBegins) {
  std::vector<Index> moving(mesh.vertex_count() / 4);
  std::iota(moving.begin(), moving.end(), 0U);
  const std::vector<double> column(3 * moving.size(), 1.0);
  const auto blend = upload_response(context, {moving, 1, column}, topology);
  Surface surface(context, mesh.positions, topology);
  std::uint64_t before = uploaded();
  const Positions settled(mesh.vertex_count(), {0.5, 0.0, 0.0});
  surface.begin(*blend, mesh.positions, settled);
  EXPECT_EQ(uploaded() - before, moving.size() * sizeof(Vec4));
  before = uploaded();
  surface.blend(blend, std::vector{0.25});
  Positions expected = mesh.positions;
  for (const Index v : moving) expected[v] += Eigen::Vector3d(0.75, 0.25, 0.25);
  EXPECT_LT(test::largest_distance(surface.positions(), expected), 1e-6);
  EXPECT_LT(uploaded() - before, 64U) << "the parameter";
}

TEST_P(SurfaceUploads, ComesBackFromADrag) {
  const std::vector<Index> moving{5, 6, 7};
  const std::vector<double> column(9, 1.0);
  const auto blend = upload_response(context, {moving, 1, column}, topology);
  Surface surface(context, mesh.positions, topology);
  const Positions places = surface.positions();
  const std::vector<Eigen::Vector3d> normals = surface.normals();
  surface.begin(*blend, mesh.positions);
  surface.blend(blend, std::vector{0.25});
  surface.place(mesh.positions);
  EXPECT_EQ(surface.positions(), places);
  EXPECT_EQ(surface.normals(), normals);
}

// Returns the outward normals of the faces at each corner of a bar, in any order.
std::vector<Eigen::Vector3d> face_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> normals;
  for (const auto& [a, b, c] : mesh.topology().triangles) {
    const Eigen::Vector3d& from = mesh.positions[a];
    const Eigen::Vector3d normal = (mesh.positions[b] - from).cross(mesh.positions[c] - from);
    normals.push_back(normal.normalized());
  }
  return normals;
}

double distance_to_nearest(const Eigen::Vector3d& v, const std::vector<Eigen::Vector3d>& others) {
  double least = 2.0;
  for (const Eigen::Vector3d& other : others) least = std::min(least, (v - other).norm());
  return least;
}

// Every normal of a bar equals that of a face, both at rest and after a shear.
TEST_P(SurfaceUploads, HardEdgesStayHardWhenTheSurfaceMoves) {
  Mesh box = bar(2, 3, 1.0, 2.0);
  Surface surface(context, box.positions, box.topology());
  for (const double shear : {0.0, 0.3}) {
    for (Eigen::Vector3d& p : box.positions) p.x() += shear * p.z();
    surface.place(box.positions);
    const std::vector<Eigen::Vector3d> normals = surface.normals();
    EXPECT_GT(normals.size(), box.vertex_count());
    for (const Eigen::Vector3d& normal : normals) {
      EXPECT_LT(distance_to_nearest(normal, face_normals(box)), 1e-5) << shear;
    }
  }
  Surface round(context, box.positions, box.topology(), 180.0);
  EXPECT_EQ(round.normals().size(), box.vertex_count());
}

// When the second drag begins, vertices that only the first response moves return to rest.
TEST_P(SurfaceUploads, DragByAnotherResponseBeginsAtRest) {
  const auto blend_of = [&](const std::vector<Index>& moving) {
    const std::vector<double> column(3 * moving.size(), 1.0);
    return upload_response(context, {moving, 1, column}, topology);
  };
  const auto first = blend_of({5, 6, 7});
  const auto second = blend_of({7, 8});
  Surface surface(context, mesh.positions, topology);
  surface.begin(*first, mesh.positions);
  surface.blend(first, std::vector{0.25});
  surface.begin(*second, mesh.positions);
  surface.blend(second, std::vector{0.5});
  Positions expected = mesh.positions;
  for (const Index v : {7U, 8U}) expected[v] += Eigen::Vector3d::Constant(0.5);
  EXPECT_LT(test::largest_distance(surface.positions(), expected), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Memory, SurfaceUploads, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "mapped" : "staged"; });

}  // namespace
}  // namespace lapwing
