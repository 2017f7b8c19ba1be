#include "lapwing/render/draw_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

// One triangle of an order as a triangle of the mesh that begins with its smallest vertex.
Triangle from_smallest(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// A mesh and the order in which it is drawn, in memory that the host sees.
class Ordered {
 public:
  explicit Ordered(const Mesh& ordered) : mesh(ordered) { surface.place(mesh.positions); }

  bool is_mapped() const { return surface.draw_order() != nullptr; }
  const DrawOrder& order() const { return *surface.draw_order(); }

  // Of the order's indices, what they say to the vertex shader.
  std::vector<Triangle> smooth() const {
    const auto drawn = order().index_buffer().mapped_as<Triangle>();
    return {drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(order().smooth_count())};
  }
  std::vector<Triangle> sharp() const {
    std::vector<Triangle> found;
    const auto drawn = order().index_buffer().mapped_as<Triangle>();
    for (const Triangle& corners : drawn.subspan(order().smooth_count(), order().sharp_count())) {
      EXPECT_EQ(corners[0] % 3, 0U);
      EXPECT_EQ(corners[1], corners[0] + 1);
      EXPECT_EQ(corners[2], corners[0] + 2);
      found.push_back(topology.triangles[corners[0] / 3]);
    }
    return found;
  }

  Mesh mesh;
  std::shared_ptr<gpu::Context> context = std::make_shared<gpu::Context>();
  Topology topology = build_topology(mesh);
  Surface surface{context, mesh.positions, topology};
};

// Where x is positive, turned around the y axis.
Positions folded(const Mesh& sheet, double angle) {
  Positions moved = sheet.positions;
  for (Eigen::Vector3d& p : moved) {
    const double beyond = p.x() - 0.5;
    if (beyond > 0.0) p = {0.5 + beyond * std::cos(angle), p.y(), beyond * std::sin(angle)};
  }
  return moved;
}

TEST(DrawOrder, DrawsEveryTriangleOnce) {
  LAPWING_NEEDS_GPU();
  Ordered sheet(grid(70, 70));  // more than one thread's triangles
  if (!sheet.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  sheet.surface.place(folded(sheet.mesh, 1.5));
  std::multiset<Triangle> drawn;
  for (const auto& part : {sheet.smooth(), sheet.sharp()}) {
    for (const Triangle& t : part) drawn.insert(from_smallest(t));
  }
  std::multiset<Triangle> expected;
  for (const Triangle& t : sheet.topology.triangles) expected.insert(from_smallest(t));
  EXPECT_EQ(drawn, expected);
}

TEST(DrawOrder, SphereIsSmoothAndABarIsNot) {
  LAPWING_NEEDS_GPU();
  const Ordered sphere(icosphere(4));
  if (!sphere.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  EXPECT_EQ(sphere.order().sharp_count(), 0U);
  EXPECT_EQ(Ordered(bar(1, 1, 1.0, 1.0)).order().smooth_count(), 0U);
}

TEST(DrawOrder, TrianglesAtAFoldBecomeSharpAndSmoothAgain) {
  LAPWING_NEEDS_GPU();
  Ordered sheet(grid(8, 8));
  if (!sheet.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  EXPECT_EQ(sheet.order().sharp_count(), 0U);
  sheet.surface.place(folded(sheet.mesh, 1.5));
  const std::vector<Triangle> sharp = sheet.sharp();
  EXPECT_FALSE(sharp.empty());
  for (const Triangle& t : sharp) {
    EXPECT_TRUE(std::any_of(t.begin(), t.end(),
                            [&](Index v) { return sheet.mesh.positions[v].x() == 0.5; }));
  }
  sheet.surface.place(sheet.mesh.positions);
  EXPECT_EQ(sheet.order().sharp_count(), 0U);
}

TEST(DrawOrder, WhatIsNotANumberIsSharp) {
  LAPWING_NEEDS_GPU();
  Ordered sphere(icosphere(2));
  if (!sphere.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  Positions broken = sphere.mesh.positions;
  broken[0].x() = std::numeric_limits<double>::quiet_NaN();
  sphere.surface.place(broken);
  EXPECT_GE(sphere.order().sharp_count(), sphere.topology.vertex_triangles.size(0));
  EXPECT_GT(sphere.order().smooth_count(), 0U);
}

TEST(OrderInSpace, NeighboursFollowEachOther) {
  const Mesh sheet = grid(64, 64);
  std::vector<Vec4> places;
  for (const Eigen::Vector3d& p : sheet.positions) places.push_back(place_of(p, {0, 0, 0}));
  std::vector<Triangle> triangles = sheet.topology().triangles;
  // Far apart, one after the other.
  for (std::size_t t = 0; t < triangles.size() / 2; t += 2) {
    std::swap(triangles[t], triangles[triangles.size() - 1 - t]);
  }
  const auto steps = [&](const std::vector<Index>& order) {
    double sum = 0.0;
    for (std::size_t k = 1; k < order.size(); ++k) {
      sum += (sheet.positions[triangles[order[k]][0]] - sheet.positions[triangles[order[k - 1]][0]])
                 .norm();
    }
    return sum * 64.0 / static_cast<double>(order.size());  // in edges
  };
  std::vector<Index> as_given(triangles.size());
  for (Index t = 0; t < as_given.size(); ++t) as_given[t] = t;
  const std::vector<Index> order = morton_order(places, triangles);
  EXPECT_GT(steps(as_given), 10.0);
  EXPECT_LT(steps(order), 2.0);
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), as_given.begin(), as_given.end()));
}

TEST(OrderInSpace, TakesWhateverPositionsThereAre) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<Vec4> places{
      {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {nan, 0, 0, 1}, {infinity, 0, -infinity, 1}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 1, 4}};
  std::vector<Index> order = morton_order(places, triangles);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_TRUE(morton_order(places, {}).empty());
}

// How a picture may differ that is drawn by vertex from one that is drawn by corner.
struct DrawnTwice {
  // `by_corner`: as on a device whose memory the host does not see.
  static Image picture(const Mesh& mesh, const SurfaceStyle& style, bool by_corner) {
    gpu::ContextOptions options;
    options.map_device_memory = !by_corner;
    const auto context = std::make_shared<gpu::Context>(options);
    Surface surface(context, mesh.positions, mesh.topology());
    EXPECT_TRUE(!by_corner || surface.draw_order() == nullptr);
    SurfacePaint paint(surface);
    std::vector<VertexClass> classes(mesh.vertex_count(), VertexClass::roi);
    std::vector<float> heights;
    for (const Eigen::Vector3d& p : mesh.positions) heights.push_back(static_cast<float>(p.y()));
    for (std::size_t v = 0; v < classes.size(); v += 3) classes[v] = VertexClass::belt;
    paint.set_classes(classes);
    paint.set_scalars(heights);
    RenderOptions how;
    how.width = 160;
    how.height = 120;
    how.style = style;
    const Camera camera = fit(bounds_of(mesh.positions), view_axes(View::three_quarter), 4.0 / 3.0);
    return render_image(surface, paint, camera, how);
  }

  static int largest_difference(const Mesh& mesh, const SurfaceStyle& style) {
    const Image by_vertex = picture(mesh, style, false);
    const Image by_corner = picture(mesh, style, true);
    int largest = 0;
    for (std::size_t at = 0; at < by_vertex.rgba.size(); ++at) {
      largest = std::max(largest, std::abs(by_vertex.rgba[at] - by_corner.rgba[at]));
    }
    return largest;
  }
};

class PictureByVertex : public ::testing::TestWithParam<SurfaceColor> {
 protected:
  void SetUp() override { LAPWING_NEEDS_GPU(); }
};

TEST_P(PictureByVertex, IsThatByCorner) {
  SurfaceStyle style{.color = GetParam()};
  EXPECT_LE(DrawnTwice::largest_difference(icosphere(3), style), 1);
  EXPECT_LE(DrawnTwice::largest_difference(bar(3, 5, 1.0, 2.0), style), 1);
  Mesh fold = grid(9, 9);
  fold.positions = folded(fold, 2.0);  // whose back shows beside its front
  EXPECT_LE(DrawnTwice::largest_difference(fold, style), 1);
  style.sides = Sides::front;
  EXPECT_LE(DrawnTwice::largest_difference(fold, style), 1);
}

TEST_P(PictureByVertex, IsThatByCornerWhereCornersDiffer) {
  SurfaceStyle style{.color = GetParam(), .wireframe = true};
  EXPECT_LE(DrawnTwice::largest_difference(icosphere(2), style), 1);
  style = {.color = GetParam(), .flat = true};
  EXPECT_LE(DrawnTwice::largest_difference(icosphere(2), style), 1);
}

INSTANTIATE_TEST_SUITE_P(Colors, PictureByVertex,
                         ::testing::Values(SurfaceColor::plain, SurfaceColor::regions,
                                           SurfaceColor::scalar, SurfaceColor::carried),
                         [](const auto& test) -> std::string {
                           switch (test.param) {
                             case SurfaceColor::regions:
                               return "regions";
                             case SurfaceColor::scalar:
                               return "scalar";
                             case SurfaceColor::carried:
                               return "carried";
                             default:
                               return "plain";
                           }
                         });

}  // namespace
}  // namespace lapwing
