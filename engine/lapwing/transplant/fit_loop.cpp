// Least-squares rotation between point sets: Umeyama, "Least-squares estimation of transformation
// parameters between two point patterns", IEEE PAMI 13, 1991.
#include "lapwing/transplant/fit_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/decompositions.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Number of points on each loop, and of starts that are tried before refinement.
constexpr std::size_t kCurvePoints = 256;
// Number of best starts, and of starts nearest to the smallest rotation, that are refined.
constexpr std::size_t kRefined = 8;
// Golden-section steps: the final interval, 0.618^46 times two spacings, is 1e-12 of the loop's
// length.
constexpr int kSections = 46;
// If the distances of all starts differ by less than this fraction of the radius, all are equally
// good, unless the best distance is below kSharp times the worst: then the loops have the same
// shape.
constexpr double kAlike = 0.01;
constexpr double kSharp = 0.1;
// Starts whose distance exceeds the best by at most this fraction of the range of distances are as
// good as the best.
constexpr double kAsGood = 0.01;

// The rotation R that maximizes trace(R' M), and this trace.
struct Rotation {
  Matrix3d matrix;
  double agreement = 0.0;
};

Rotation best_rotation(const Matrix3d& moments) {
  const auto [U, sigma, V] = singular_values(moments);
  Vector3d signs = Vector3d::Ones();
  if (U.determinant() * V.determinant() < 0.0) signs[2] = -1.0;
  return {U * signs.asDiagonal() * V.transpose(), sigma.dot(signs)};
}

// A fit of the part's loop to the host's loop for one starting point.
struct Start {
  double at = 0.0;  ///< start on the host's loop, a fraction of its length; the part's start is 0
  double distance = 0.0;  ///< root mean square distance between the loops, in radii
  Matrix3d rotation = Matrix3d::Identity();
};

class StartSearch {
 public:
  // `host` must have the same direction as `part`.
  StartSearch(const LoopCurve& part, const LoopCurve& host)
      : host_(host),
        host_frame_(loop_frame(host)),
        host_points_(kCurvePoints),
        part_points_(kCurvePoints) {
    const LoopFrame frame = loop_frame(part);
    part.spread(0.0, part_points_);
    for (Vector3d& p : part_points_) p = (p - frame.center) / frame.radius;
  }

  Start try_at(double at) {
    host_.spread(at, host_points_);
    Matrix3d moments = Matrix3d::Zero();
    double squares = 0.0;
    for (std::size_t k = 0; k < kCurvePoints; ++k) {
      const Vector3d q = (host_points_[k] - host_frame_.center) / host_frame_.radius;
      moments += q * part_points_[k].transpose();
      squares += q.squaredNorm() + part_points_[k].squaredNorm();
    }
    const Rotation best = best_rotation(moments);
    const double left = std::max(0.0, squares - 2.0 * best.agreement);
    return {at, std::sqrt(left / static_cast<double>(kCurvePoints)), best.matrix};
  }

  // Returns the best start between `from` and `to`. This interval must contain a single minimum.
  Start refine(double from, double to) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    Start low = try_at(to - golden * (to - from));
    Start high = try_at(from + golden * (to - from));
    for (int step = 0; step < kSections; ++step) {
      if (low.distance < high.distance) {
        to = high.at;
        high = low;
        low = try_at(to - golden * (to - from));
      } else {
        from = low.at;
        low = high;
        high = try_at(from + golden * (to - from));
      }
    }
    return low.distance < high.distance ? low : high;
  }

 private:
  const LoopCurve& host_;
  LoopFrame host_frame_;
  std::vector<Vector3d> host_points_;
  std::vector<Vector3d> part_points_;
};

// Returns the local minima of `tried`, a cyclic sequence.
std::vector<Start> local_minima(const std::vector<Start>& tried) {
  std::vector<Start> valleys;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    const double before = tried[(k + tried.size() - 1) % tried.size()].distance;
    const double after = tried[(k + 1) % tried.size()].distance;
    if (tried[k].distance <= before && tried[k].distance <= after) valleys.push_back(tried[k]);
  }
  return valleys;
}

Matrix3d fitted_rotation(const LoopCurve& part, const LoopCurve& host) {
  const Matrix3d least = least_rotation(loop_frame(part).normal, loop_frame(host).normal);
  const auto turn = [&](const Start& s) { return -least.cwiseProduct(s.rotation).sum(); };
  StartSearch search(part, host);
  constexpr double kStep = 1.0 / static_cast<double>(kCurvePoints);
  std::vector<Start> tried;
  for (std::size_t k = 0; k < kCurvePoints; ++k) {
    tried.push_back(search.try_at(kStep * static_cast<double>(k)));
  }
  std::vector<Start> valleys = local_minima(tried);
  std::ranges::stable_sort(valleys, {}, &Start::distance);
  if (valleys.size() > kRefined) {
    std::stable_sort(valleys.begin() + kRefined, valleys.end(),
                     [&](const Start& a, const Start& b) { return turn(a) < turn(b); });
  }
  if (valleys.size() > 2 * kRefined) valleys.resize(2 * kRefined);
  for (Start& valley : valleys) valley = search.refine(valley.at - kStep, valley.at + kStep);

  const double worst = std::ranges::max(tried, {}, &Start::distance).distance;
  const double best = std::ranges::min(valleys, {}, &Start::distance).distance;
  if (worst - best < kAlike && best >= kSharp * worst) return least;
  std::erase_if(valleys,
                [&](const Start& s) { return s.distance > best + kAsGood * (worst - best); });
  return std::ranges::min(valleys, {}, turn).rotation;
}

void require_usable(const LoopFit& fit, const std::string& where) {
  if (!(fit.scale > 0.0) || !std::isfinite(fit.scale)) {
    throw InputError(where + ": the part's scale must be above 0");
  }
  if (fit.keep_size && fit.scale != 1.0) {
    throw InputError(where +
                     ": \"keep_size\" and \"scale\" exclude each other; remove one of the two");
  }
  if (!std::isfinite(fit.rotate_degrees)) {
    throw InputError(where + ": the part's rotation must be a finite number of degrees");
  }
}

}  // namespace

Eigen::Affine3d fit_loop(std::span<const Vector3d> part, std::span<const Vector3d> host,
                         const LoopFit& fit, const std::string& where) {
  require_usable(fit, where);
  const std::vector<Vector3d> against(host.rbegin(), host.rend());
  const LoopCurve part_curve(part, where + ": the part's boundary loop");
  const LoopCurve host_curve(against, where + ": the hole's boundary loop");
  const LoopFrame from = loop_frame(part_curve);
  const LoopFrame to = loop_frame(host_curve);

  const double size = fit.keep_size ? 1.0 : to.radius / from.radius;
  const Eigen::AngleAxisd turn(fit.rotate_degrees * std::numbers::pi / 180.0, to.normal);
  Eigen::Affine3d placement;
  placement.linear() =
      fit.scale * size * turn.toRotationMatrix() * fitted_rotation(part_curve, host_curve);
  placement.translation() = to.center - placement.linear() * from.center;
  placement.makeAffine();
  return placement;
}

}  // namespace lapwing
