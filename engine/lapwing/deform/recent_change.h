#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// By what an older change counts where a newer one comes.
inline constexpr double kShareOfOlder = 0.5;

/// What frames of a drag changed, each counted by half of the next: recent = recent / 2 + (to -
/// from), and to - from where `recent` is empty.
template <typename T>
void add_change(std::vector<T>& recent, const std::vector<T>& from, const std::vector<T>& to) {
  const bool is_first = recent.empty();
  recent.resize(to.size());
  for (std::size_t k = 0; k < to.size(); ++k) {
    const T change = to[k] - from[k];
    recent[k] = is_first ? change : T(kShareOfOlder * recent[k] + change);
  }
}

/// The same of the vertices `where` alone; 0 elsewhere.
inline void add_change(Positions& recent, const Positions& from, const Positions& to,
                       std::span<const Index> where) {
  if (recent.empty()) recent.assign(to.size(), Eigen::Vector3d::Zero());
  for (const Index v : where) {
    recent[v] = kShareOfOlder * recent[v] + Eigen::Vector3d(to[v] - from[v]);
  }
}

/// How much of what points did recently they do again, from 0 to 1: the share of those ways that
/// comes nearest to their ways now, in least squares.
class ShareOfRecent {
 public:
  void add(const Eigen::Vector3d& now, const Eigen::Vector3d& recent) {
    along_ += now.dot(recent);
    square_ += recent.squaredNorm();
  }
  double value() const { return square_ > 0.0 ? std::clamp(along_ / square_, 0.0, 1.0) : 0.0; }

 private:
  double along_ = 0.0;
  double square_ = 0.0;
};

}  // namespace lapwing
