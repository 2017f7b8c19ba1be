#include "lapwing/deform/turned_start.h"

#include <algorithm>

namespace lapwing {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

TurnedStart::TurnedStart(const EditSystem& system) : system_(system) {
  const LaplacianSystem& laplacian = system.systems->laplacian();
  const std::size_t n = laplacian.size();
  std::vector<double> b(3 * n);
  for (const VertexSet& handle : system.region.handles) {
    std::vector<Vector3d> one(system.rest->size(), Vector3d::Zero());
    for (const Index v : handle) one[v].x() = 1.0;
    laplacian.right_hand_side(one, b);
    laplacian.solve_in_place(std::span(b).first(n), 1);
    for (std::size_t k = 0; k < n; ++k) shares_.push_back(std::clamp(b[k], 0.0, 1.0));
  }
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0.0;
    for (std::size_t at = k; at < shares_.size(); at += n) sum += shares_[at];
    if (sum <= 1.0) continue;
    for (std::size_t at = k; at < shares_.size(); at += n) shares_[at] /= sum;
  }
}

std::vector<Vector3d> TurnedStart::displacement(std::span<const Affine3d> motions,
                                                std::span<const AngleAxisd> turns) const {
  const EditSystem& s = system_;
  std::vector<Vector3d> u(s.rest->size(), Vector3d::Zero());
  const std::size_t n = s.constraints.unknowns.size();
  for (std::size_t h = 0; h < motions.size(); ++h) {
    for (std::size_t k = 0; k < n; ++k) {
      const double share = shares_[h * n + k];
      if (share == 0.0) continue;
      const Index v = s.constraints.unknowns.vertices[k];
      const Affine3d part = partial_motion(motions[h], turns[h], s.frames[h].centroid, share);
      u[v] += part * (*s.rest)[v] - (*s.rest)[v];
    }
  }
  return u;
}

}  // namespace lapwing
