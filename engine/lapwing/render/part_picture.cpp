#include "lapwing/render/part_picture.h"

#include <cmath>
#include <numbers>

#include <Eigen/SVD>

#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {
namespace {

// Elevation of the eye above the loop's plane, and azimuth from the front, in radians.
constexpr double kAbove = 20.0 * std::numbers::pi / 180.0;
constexpr double kAside = 25.0 * std::numbers::pi / 180.0;

// A part whose depth is below this fraction of its width, such as a wing, is seen from its broad
// side.
constexpr double kFlatSpread = 0.7;

// The front of a mesh faces +z. If the up direction of a part is along z, its front is +y instead.
Eigen::Vector3d front_of(const Eigen::Vector3d& up) {
  const Eigen::Vector3d axis =
      std::abs(up.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  return (axis - axis.dot(up) * up).normalized();
}

// Returns the horizontal direction in which a flat part is thinnest, oriented towards the front;
// otherwise the front.
Eigen::Vector3d broadside_of(const Positions& positions, const Eigen::Vector3d& up) {
  const Eigen::Vector3d front = front_of(up);
  const Eigen::Vector3d side = up.cross(front);
  const auto plan = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(p.dot(side), p.dot(front));
  };
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : positions) mean += plan(p) / static_cast<double>(positions.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& p : positions) spread += (plan(p) - mean) * (plan(p) - mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix2d> axes(spread, Eigen::ComputeFullV);
  const Eigen::Vector2d sizes = axes.singularValues();
  if (!(sizes[1] < kFlatSpread * kFlatSpread * sizes[0])) return front;
  const Eigen::Vector2d least = axes.matrixV().col(1);
  return (least.y() < 0.0 ? -1.0 : 1.0) * (least.x() * side + least.y() * front);
}

ViewAxes standing_view(const Positions& positions, const Eigen::Vector3d& up) {
  const Eigen::Vector3d front = broadside_of(positions, up);
  const Eigen::Vector3d aside = std::cos(kAside) * front + std::sin(kAside) * up.cross(front);
  return {std::cos(kAbove) * aside + std::sin(kAbove) * up, up};
}

}  // namespace

Image part_picture(const std::shared_ptr<gpu::Context>& context, const Mesh& mesh,
                   std::span<const Index> loop, std::uint32_t side) {
  const BoundaryLoop own_loop(loop.begin(), loop.end());
  const LoopFrame frame =
      loop_frame(LoopCurve(loop_points(own_loop, mesh.positions), "the part's boundary loop"));
  const Topology& topology = mesh.topology();
  Surface surface(context, mesh.positions, topology);
  SurfacePaint paint(surface);
  std::vector<VertexClass> classes(mesh.vertex_count(), VertexClass::outside);
  for (const Index v : loop) classes[v] = VertexClass::handle;
  paint.set_classes(classes);
  const Positions shown = surface_positions(mesh.positions, topology);
  RenderOptions options;
  options.width = side;
  options.height = side;
  options.background = Background::transparent;
  options.style.color = SurfaceColor::regions;
  return render_image(surface, paint, fit(shown, standing_view(shown, frame.normal), 1.0), options);
}

}  // namespace lapwing
