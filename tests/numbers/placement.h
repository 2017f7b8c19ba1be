#pragma once

#include <string>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Where a mesh lies and how large it is: x -> scale x + offset.
struct Placement {
  std::string name;
  double scale = 1.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return scale * x + offset; }
  Mesh operator()(Mesh mesh) const {
    mesh.source.reset();
    for (Eigen::Vector3d& p : mesh.positions) p = (*this)(p);
    return mesh;
  }
  /// Where positions of the placed mesh lie on the plain one.
  Positions back(Positions positions) const {
    for (Eigen::Vector3d& p : positions) p = (p - offset) / scale;
    return positions;
  }
};

}  // namespace lapwing::test
