#include "lapwing/remesh/target_sizing_field.h"

#include <cmath>
#include <sstream>

#include "lapwing/base/errors.h"

namespace lapwing::remeshing {

double TargetSizingField::at(const Eigen::Vector3d& point) const {
  const double length = length_(point);
  if (length > 0.0 && std::isfinite(length)) return length;
  std::ostringstream message;
  message << "the target edge length at (" << point.transpose() << ") is " << length
          << "; it must be positive";
  throw InputError(message.str());
}

}  // namespace lapwing::remeshing
