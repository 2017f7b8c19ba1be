#include "lapwing/render/surface.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

// With memory that the host sees, where the processor moves the surface, and without, where the
// device does.
class SurfaceUploads : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    gpu::ContextOptions options;
    options.map_device_memory = GetParam();
    context = std::make_shared<gpu::Context>(options);
  }

  std::uint64_t uploaded() const { return context->transfers().uploaded; }
  // What one vertex that moves takes: place, number, and the numbers of those with new normals.
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
  // Places, triangles, and the triangles around each vertex: a fan has one corner more, its begin,
  // and the last an end. All vertices get normals, for which the processor needs no list.
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

// What a drag has moved is where it was, to the bit.
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

// A drag by one response after a drag by another: what only the first moves is at rest.
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
