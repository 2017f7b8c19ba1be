#pragma once

#include <functional>

#include <Eigen/Core>

namespace lapwing::remeshing {

/// The sizing field: the edge length wanted at a point. `at` throws InputError, naming the point,
/// if the length is not positive or not finite.
class TargetSizingField {
 public:
  explicit TargetSizingField(const std::function<double(const Eigen::Vector3d&)>& length)
      : length_(length) {}
  double at(const Eigen::Vector3d& point) const;

 private:
  const std::function<double(const Eigen::Vector3d&)>& length_;
};

}  // namespace lapwing::remeshing
