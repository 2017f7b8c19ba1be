#include "tools/scene_tool.h"

namespace lapwing::viewer {
namespace {

// A surface nearer to the eye by more than this share of the mesh's diagonal hides a place.
constexpr double kHides = 0.02;

}  // namespace

bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector2d& pixel, const ToolScene& scene) {
  const auto hit = scene.pick ? scene.pick(pixel) : std::nullopt;
  if (!hit) return false;
  const double nearer = (hit->position - place).dot(scene.projection.toward_eye(place));
  return nearer >
         kHides * bounds_of(surface_positions(scene.positions, surface_of(scene.state)->topology()))
                      .diagonal();
}

}  // namespace lapwing::viewer
