#include "lapwing/deform/predictor.h"

#include <algorithm>

#include "lapwing/deform/linear_response.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The fraction of the recent change that is repeated. It is less than 1 because the recent change
// also contains minimization that earlier frames had not completed.
constexpr double kTrust = 0.75;
// Weight of a frame relative to the next one.
constexpr double kShareOfOlder = 0.5;

void add_change(std::vector<Vector3d>& recent, std::span<const Vector3d> from,
                std::span<const Vector3d> to, std::span<const Index> where) {
  if (recent.empty()) recent.assign(to.size(), Vector3d::Zero());
  for (const Index v : where) recent[v] = kShareOfOlder * recent[v] + (to[v] - from[v]);
}

}  // namespace

void Predictor::clear() {
  recent_prescribed_.clear();
  recent_u_.clear();
}

// Returns the factor, from 0 to 1, by which the recent displacement of the handles' vertices best
// fits `change` in the least-squares sense.
double Predictor::repeated_share(const EditSystem& edit, std::span<const Vector3d> change) const {
  double along = 0.0;
  double square = 0.0;
  for (const VertexSet& handle : edit.region.handles) {
    for (const Index v : handle) {
      along += change[v].dot(recent_prescribed_[v]);
      square += recent_prescribed_[v].squaredNorm();
    }
  }
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
}

std::vector<Vector3d> Predictor::predict(const EditSystem& edit,
                                         std::span<const Vector3d> last_prescribed,
                                         std::span<const Vector3d> prescribed,
                                         std::span<const Vector3d> u) const {
  std::vector<Vector3d> change(prescribed.size(), Vector3d::Zero());
  for (const Index v : edit.moving) change[v] = prescribed[v] - last_prescribed[v];
  const double share = recent_prescribed_.empty() ? 0.0 : kTrust * repeated_share(edit, change);
  if (share > 0.0) {
    for (const Index v : edit.moving) change[v] -= share * recent_prescribed_[v];
  }
  std::vector<Vector3d> predicted = laplacian_displacement(edit, change, Springs::ignored);
  for (const Index v : edit.moving) {
    predicted[v] += u[v];
    if (share > 0.0) predicted[v] += share * recent_u_[v];
  }
  return predicted;
}

void Predictor::add_frame(const EditSystem& edit, std::span<const Vector3d> last_prescribed,
                          std::span<const Vector3d> prescribed, std::span<const Vector3d> last_u,
                          std::span<const Vector3d> u) {
  add_change(recent_prescribed_, last_prescribed, prescribed, edit.moving);
  add_change(recent_u_, last_u, u, edit.moving);
}

}  // namespace lapwing
