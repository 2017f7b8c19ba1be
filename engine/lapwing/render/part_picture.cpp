#include "lapwing/render/part_picture.h"

#include <cmath>
#include <numbers>

#include "lapwing/render/render_image.h"
#include "lapwing/transplant/loop_curve.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "lapwing/vulkan/vulkan_surface.h"

namespace lapwing {
namespace {

// How far above the loop's plane the eye is, and how far round from the front, in radians.
constexpr double kAbove = 20.0 * std::numbers::pi / 180.0;
constexpr double kAside = 25.0 * std::numbers::pi / 180.0;

// Meshes face +z; one that stands along z is seen from where its top was.
ViewAxes standing_view(const Eigen::Vector3d& up) {
  Eigen::Vector3d front = Eigen::Vector3d::UnitZ() - up.z() * up;
  if (front.norm() < 0.5) front = Eigen::Vector3d::UnitY() - up.y() * up;
  front.normalize();
  const Eigen::Vector3d aside = std::cos(kAside) * front + std::sin(kAside) * up.cross(front);
  return {std::cos(kAbove) * aside + std::sin(kAbove) * up, up};
}

}  // namespace

Image part_picture(VulkanKernels& kernels, const Mesh& mesh, std::span<const Index> loop,
                   std::uint32_t side) {
  const BoundaryLoop own_loop(loop.begin(), loop.end());
  const LoopFrame frame =
      loop_frame(LoopCurve(loop_points(own_loop, mesh.positions), "the part's boundary loop"));
  const Topology topology = build_topology(mesh);
  const auto surface = kernels.make_surface({mesh.positions, topology, {}, {}, 0});
  auto& drawn = dynamic_cast<VulkanSurface&>(*surface);
  SurfacePaint paint(drawn);
  std::vector<VertexClass> classes(mesh.vertex_count(), VertexClass::outside);
  for (const Index v : loop) classes[v] = VertexClass::handle;
  paint.set_classes(classes);
  RenderOptions options;
  options.width = side;
  options.height = side;
  options.background = Background::transparent;
  options.style.color = SurfaceColor::regions;
  return render_image(drawn, paint, fit(mesh.positions, standing_view(frame.normal), 1.0), options);
}

}  // namespace lapwing
