#include "lapwing/render/surface_paint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/render/corner_colors.h"
#include "lapwing/render/surface.h"

namespace lapwing {
namespace {

constexpr std::uint32_t kAllEdges = 0b111;
// If the maximum is at most this multiple of the percentile, the range includes it, because the
// other colours then barely change.
constexpr float kOutlierFactor = 1.5F;

void check_count(std::size_t given, std::size_t expected, const char* what) {
  if (given == expected) return;
  throw InputError(std::to_string(given) + " " + what + " were given for a surface that needs " +
                   std::to_string(expected));
}

bool is_polygon_edge(std::span<const Index> polygon, Index a, Index b) {
  for (std::size_t corner = 0; corner < polygon.size(); ++corner) {
    const Index here = polygon[corner];
    const Index next = polygon[(corner + 1) % polygon.size()];
    if ((here == a && next == b) || (here == b && next == a)) return true;
  }
  return false;
}

// Returns the entries of `SurfacePaint::edge_buffer`, one per triangle. Bit e is set if edge e of
// the triangle is an edge of the polygon, not a diagonal.
std::vector<std::uint32_t> polygon_edges(const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  std::vector<std::uint32_t> edges(topology.triangles.size(), 0);
  for (std::size_t t = 0; t < edges.size(); ++t) {
    const Triangle& triangle = topology.triangles[t];
    const std::span<const Index> polygon = mesh.face(topology.triangle_faces[t]);
    for (std::size_t e = 0; e < 3; ++e) {
      if (is_polygon_edge(polygon, triangle[e], triangle[(e + 1) % 3])) edges[t] |= 1U << e;
    }
  }
  return edges;
}

ScalarRange range_of(std::span<const float> scalars) {
  ScalarRange range{std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()};
  for (const float value : scalars) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range.low <= range.high ? range : ScalarRange{};
}

}  // namespace

// The shader expects the weight times 255 in the bits above the class.
VertexClass drawn_by_handle(VertexClass vertex, double weight) {
  const auto share = static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(weight, 0.0, 1.0)));
  return static_cast<VertexClass>(static_cast<std::uint32_t>(vertex) | share << 8U);
}

void draw_graded(std::span<const FalloffVertex> graded, std::span<const VertexSet> handles,
                 std::span<VertexClass> classes) {
  std::vector<char> fades(handles.size(), 0);
  for (const FalloffVertex& g : graded) {
    classes[g.vertex] = drawn_by_handle(classes[g.vertex], g.weight);
    fades[g.handle] = 1;
  }
  // Without this, the handle itself would be drawn with weight 0.
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (fades[h] == 0) continue;
    for (const Index v : handles[h]) classes[v] = drawn_by_handle(VertexClass::handle, 1.0);
  }
}

std::vector<VertexClass> vertex_classes(const EditRegion& region, std::size_t vertex_count) {
  std::vector<VertexClass> classes(vertex_count, VertexClass::outside);
  for (const Index v : region.roi) classes[v] = VertexClass::roi;
  for (const Index v : region.belt) classes[v] = VertexClass::belt;
  for (const auto& handle : region.handles) {
    for (const Index v : handle) classes[v] = VertexClass::handle;
  }
  draw_graded(region.graded, region.handles, classes);
  return classes;
}

SurfacePaint::SurfacePaint(const Surface& surface)
    : context_(surface.context()),
      vertex_count_(surface.vertex_count()),
      triangle_count_(surface.triangle_count()),
      transfer_(surface.context()),
      classes_(surface.context(), "vertex classes", vertex_count_ * sizeof(VertexClass)),
      scalars_(surface.context(), "vertex scalars", vertex_count_ * sizeof(float)),
      edges_(surface.context(), "shown edges", triangle_count_ * sizeof(kAllEdges)),
      corner_sources_(context_, "colours of the file", 0),
      corner_places_(context_, "places in images", 0),
      images_(context_, "images", 0) {
  set_classes(std::vector<VertexClass>(vertex_count_, VertexClass::outside));
  set_scalars(std::vector<float>(vertex_count_, 0.0F));
  transfer_.upload(edges_, std::vector<std::uint32_t>(triangle_count_, kAllEdges));
}

void SurfacePaint::set_classes(std::span<const VertexClass> classes) {
  check_count(classes.size(), vertex_count_, "vertex classes");
  revision_.renew();
  transfer_.upload(classes_, classes);
}

void SurfacePaint::set_scalars(std::span<const float> scalars) {
  check_count(scalars.size(), vertex_count_, "vertex scalars");
  revision_.renew();
  transfer_.upload(scalars_, scalars);
  scalar_range_ = range_of(scalars);
}

void SurfacePaint::set_polygons(const Mesh& mesh) {
  check_count(mesh.topology().triangles.size(), triangle_count_, "triangles");
  revision_.renew();
  transfer_.upload(edges_, polygon_edges(mesh));
}

void SurfacePaint::set_file_colors(const Mesh& drawn, const Mesh& mesh, const FilePaint& file) {
  check_count(drawn.topology().triangles.size(), triangle_count_, "triangles");
  revision_.renew();
  CornerColors corners = corner_colors(drawn, mesh, file.colors);
  const VkDeviceSize limit = context_.limits().maxStorageBufferRange;
  if (std::span(corners.places).size_bytes() > limit) corners = {};
  const auto replace = [&](gpu::Buffer& buffer, auto values) {
    buffer = gpu::Buffer(context_, buffer.name(), values.size_bytes());
    transfer_.upload(buffer, values);
  };
  replace(corner_sources_, std::span(corners.sources));
  replace(corner_places_, std::span(corners.places));
  replace(images_, std::span(file.images).first(corners.places.empty() ? 0 : file.images.size()));
}

ScalarRange range_without_outliers(std::span<const float> numbers) {
  std::vector<float> finite;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(finite),
               [](float value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  const auto usual = finite.begin() + static_cast<std::ptrdiff_t>(99 * (finite.size() - 1) / 100);
  std::nth_element(finite.begin(), usual, finite.end());
  const float largest = *std::max_element(usual, finite.end());
  const bool far_above = largest > kOutlierFactor * *usual && *usual > 0.0F;
  return {0.0F, far_above ? *usual : largest};
}

}  // namespace lapwing
