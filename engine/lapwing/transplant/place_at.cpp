#include "lapwing/transplant/place_at.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {

Eigen::Affine3d place_at(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                         const SurfacePlace& place, const std::string& where) {
  const double length = place.normal.norm();
  if (!place.point.allFinite() || !(length > 0.0) || !std::isfinite(length)) {
    throw InputError(where + ": the place of the part needs a finite point and a nonzero normal");
  }
  if (!(place.scale > 0.0) || !std::isfinite(place.scale) || !std::isfinite(place.rotate_degrees)) {
    throw InputError(where + ": the part needs a finite rotation and a scale above 0");
  }
  const std::vector<Eigen::Vector3d> placed = transformed(part, placement);
  const LoopFrame frame = loop_frame(LoopCurve(placed, where + ": the part's boundary loop"));
  const Eigen::Vector3d normal = place.normal / length;
  const Eigen::AngleAxisd turn(place.rotate_degrees * std::numbers::pi / 180.0, normal);
  Eigen::Affine3d change;
  change.linear() = place.scale * turn.toRotationMatrix() * least_rotation(frame.normal, normal);
  change.translation() = place.point - change.linear() * frame.center;
  change.makeAffine();
  return change * placement;
}

}  // namespace lapwing
