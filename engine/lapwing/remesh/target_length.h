#pragma once

#include <functional>

#include <Eigen/Core>

namespace lapwing::remeshing {

/// The edge length that the caller wants at a point. Throws InputError, naming the point, where it
/// is not positive or not finite.
class TargetLength {
 public:
  explicit TargetLength(const std::function<double(const Eigen::Vector3d&)>& length)
      : length_(length) {}
  double at(const Eigen::Vector3d& point) const;

 private:
  const std::function<double(const Eigen::Vector3d&)>& length_;
};

}  // namespace lapwing::remeshing
