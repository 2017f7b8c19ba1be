#include "lapwing/render/id_picture.h"

#include <array>

#include <Eigen/Geometry>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/renderer.h"
#include "lapwing/render/surface.h"
#include "lapwing/shaders/triangle_id_frag.h"
#include "lapwing/shaders/triangle_id_vert.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr TargetFormat kFormat{.color = VK_FORMAT_R32_UINT};
// Push constants of shaders/triangle_id.vert.
struct IdPush {
  std::array<float, 16> clip_from_surface;  // columns
};

// Returns the intersection of `ray` and the triangle's plane, clamped to the triangle. The clamp
// only corrects rounding errors, which are large if the triangle is seen edge-on.
Vector3d point_on_triangle(const Ray& ray, const std::array<Vector3d, 3>& corners) {
  const Vector3d ab = corners[1] - corners[0];
  const Vector3d ac = corners[2] - corners[0];
  const Vector3d across = ray.direction.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant == 0.0) return (corners[0] + corners[1] + corners[2]) / 3.0;
  const Vector3d from_corner = ray.origin - corners[0];
  Vector3d weights;
  weights[1] = from_corner.dot(across) / determinant;
  weights[2] = ray.direction.dot(from_corner.cross(ab)) / determinant;
  weights[0] = 1.0 - weights[1] - weights[2];
  weights = weights.cwiseMax(0.0);
  weights /= weights.sum();
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

}  // namespace

IdPicture::Target::Target(gpu::Context& context, VkExtent2D size, const TargetFormat& format)
    : extent(size),
      ids(context, {"triangle numbers", format.color, size, format.samples,
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}),
      scope(context, size, format),
      read_back(context, "triangle numbers",
                VkDeviceSize{sizeof(std::uint32_t)} * size.width * size.height,
                gpu::Memory::readback) {}

IdPicture::IdPicture(gpu::Context& context)
    : context_(context),
      pipeline_(context, kFormat,
                {.name = "triangle numbers",
                 .vertex_spirv = shaders::triangle_id_vert(),
                 .fragment_spirv = shaders::triangle_id_frag(),
                 .storage_buffers = 2,
                 .push_constant_bytes = sizeof(IdPush),
                 .depth = true}),
      commands_(context, "triangle numbers"),
      transfer_(context) {}

void IdPicture::draw(Surface& surface, const Camera& camera, std::uint32_t width,
                     std::uint32_t height) {
  const VkExtent2D extent = checked_extent(context_, width, height);
  surface.finish();
  if (!target_ || target_->extent.width != width || target_->extent.height != height) {
    target_.reset();
    target_.emplace(context_, extent, kFormat);
  }
  camera_ = camera;
  record(surface);
  commands_.run();
}

void IdPicture::record(const Surface& surface) {
  const VkExtent2D extent = target_->extent;
  gpu::Recorder recorder(commands_);
  const VkCommandBuffer commands = recorder.handle();
  target_->ids.transition(commands, kDiscarded, kColorTarget);
  target_->scope.begin(commands, target_->ids.view());
  set_viewport(context_, commands, {{0, 0}, extent});
  if (surface.triangle_count() > 0) {
    IdPush push;
    Eigen::Map<Eigen::Matrix4f>(push.clip_from_surface.data()) =
        clip_from_surface(camera_, extent, surface.origin()).cast<float>();
    pipeline_.draw(commands, {surface.position_buffer(), surface.triangle_buffer()}, push,
                   static_cast<std::uint32_t>(3 * surface.triangle_count()));
  }
  target_->scope.end(commands, target_->ids.view());
  record_read_back(recorder, target_->ids, extent, target_->read_back);
  recorder.finish();
}

std::span<const std::uint32_t> IdPicture::ids() const {
  if (!target_) return {};
  return target_->read_back.mapped_as<const std::uint32_t>();
}

std::optional<Pick> IdPicture::pick(const Surface& surface, std::uint32_t x, std::uint32_t y) {
  if (!target_ || x >= target_->extent.width || y >= target_->extent.height) return {};
  const std::uint32_t id = ids()[std::size_t{y} * target_->extent.width + x];
  if (id == 0) return {};
  Triangle triangle;
  transfer_.download(surface.triangle_buffer(), triangle, VkDeviceSize{id - 1} * sizeof triangle);
  std::array<Vector3d, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<float, 4> place;
    transfer_.download(surface.position_buffer(), place, VkDeviceSize{triangle[c]} * sizeof place);
    corners[c] = surface.origin() + Vector3d(place[0], place[1], place[2]);
  }
  const Ray ray = line_of_sight(camera_, Eigen::Vector2d(x + 0.5, y + 0.5),
                                Eigen::Vector2d(target_->extent.width, target_->extent.height));
  Pick found{id - 1, triangle[0], point_on_triangle(ray, corners), 0.0};
  double least = (corners[0] - found.position).squaredNorm();
  for (std::size_t c = 1; c < 3; ++c) {
    const double distance = (corners[c] - found.position).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    found.vertex = triangle[c];
  }
  found.depth = (camera_.target - camera_.eye).normalized().dot(found.position - camera_.eye);
  return found;
}

}  // namespace lapwing
