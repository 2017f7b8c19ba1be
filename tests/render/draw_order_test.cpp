#include "lapwing/render/draw_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

// Rotates the indices of the triangle so that the smallest one is first.
Triangle from_smallest(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// A mesh and its drawing order in mapped memory.
class Ordered {
 public:
  explicit Ordered(const Mesh& ordered) : mesh(ordered) {}

  bool is_mapped() const { return surface.draw_order() != nullptr; }
  const DrawOrder& order() const { return *surface.draw_order(); }

  // Returns the triangles that the vertex shader draws for the index buffer.
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

// Returns the sheet, folded by `angle` about the line x = 0.5.
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
  Mesh fold = grid(20, 20);
  fold.positions = folded(fold, 1.5);
  const Ordered sheet(fold);
  if (!sheet.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  EXPECT_GT(sheet.order().sharp_count(), 0U);
  EXPECT_GT(sheet.order().smooth_count(), 0U);
  std::multiset<Triangle> drawn;
  for (const auto& part : {sheet.smooth(), sheet.sharp()}) {
    for (const Triangle& t : part) drawn.insert(from_smallest(t));
  }
  std::multiset<Triangle> expected;
  for (const Triangle& t : sheet.topology.triangles) expected.insert(from_smallest(t));
  EXPECT_EQ(drawn, expected);
}

TEST(DrawOrder, OnlyASurfaceWithHardEdgesHasSharpTriangles) {
  LAPWING_NEEDS_GPU();
  const Ordered sphere(icosphere(4));
  if (!sphere.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  EXPECT_EQ(sphere.order().sharp_count(), 0U);
  EXPECT_GT(Ordered(bar(1, 1, 1.0, 1.0)).order().sharp_count(), 0U);
}

TEST(DrawOrder, TrianglesAtAFoldAreSharp) {
  LAPWING_NEEDS_GPU();
  Mesh fold = grid(8, 8);
  fold.positions = folded(fold, 1.5);
  const Ordered sheet(fold);
  if (!sheet.is_mapped()) GTEST_SKIP() << "the device draws by corner";
  const std::vector<Triangle> sharp = sheet.sharp();
  EXPECT_FALSE(sharp.empty());
  for (const Triangle& t : sharp) {
    EXPECT_TRUE(std::any_of(t.begin(), t.end(),
                            [&](Index v) { return sheet.mesh.positions[v].x() == 0.5; }));
  }
}

// Draws the mesh with an index buffer, or corner by corner as on a device without mapped memory.
Image picture(const Mesh& mesh, const SurfaceStyle& style, bool by_corner) {
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

int largest_difference(const Mesh& mesh, const SurfaceStyle& style) {
  const Image by_vertex = picture(mesh, style, false);
  const Image by_corner = picture(mesh, style, true);
  int largest = 0;
  for (std::size_t at = 0; at < by_vertex.rgba.size(); ++at) {
    largest = std::max(largest, std::abs(by_vertex.rgba[at] - by_corner.rgba[at]));
  }
  return largest;
}

class PictureByVertex : public ::testing::TestWithParam<SurfaceColor> {
 protected:
  void SetUp() override { LAPWING_NEEDS_GPU(); }
};

TEST_P(PictureByVertex, IsThatByCorner) {
  SurfaceStyle style{.color = GetParam()};
  EXPECT_LE(largest_difference(icosphere(3), style), 1);
  EXPECT_LE(largest_difference(bar(3, 5, 1.0, 2.0), style), 1);
  Mesh fold = grid(9, 9);
  fold.positions = folded(fold, 2.0);  // shows its front and its back
  EXPECT_LE(largest_difference(fold, style), 1);
  style.sides = Sides::front;
  EXPECT_LE(largest_difference(fold, style), 1);
}

TEST_P(PictureByVertex, IsThatByCornerWhereCornersDiffer) {
  SurfaceStyle style{.color = GetParam(), .wireframe = true};
  EXPECT_LE(largest_difference(icosphere(2), style), 1);
  style = {.color = GetParam(), .flat = true};
  EXPECT_LE(largest_difference(icosphere(2), style), 1);
}

std::string name_of_color(const ::testing::TestParamInfo<SurfaceColor>& color) {
  constexpr std::array kNames{"plain", "regions", "scalar", "carried"};
  return kNames[static_cast<std::size_t>(color.param)];
}

INSTANTIATE_TEST_SUITE_P(Colors, PictureByVertex,
                         ::testing::Values(SurfaceColor::plain, SurfaceColor::regions,
                                           SurfaceColor::scalar, SurfaceColor::carried),
                         name_of_color);

}  // namespace
}  // namespace lapwing
