#include "lapwing/transplant/loop_curve.h"

#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/decompositions.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Points are considered to be on a line if their width is below this fraction of the loop's length.
constexpr double kThinnest = 1e-6;
// If the enclosed area is below this fraction of the disk with the loop's radius, the area vector
// is not used.
constexpr double kLeastArea = 1e-3;

// Mean and covariance, integrated over the length of a polyline. Exact for all edge lengths.
struct Moments {
  Vector3d mean = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Zero();
};

Moments moments_of(std::span<const Vector3d> closed) {
  Moments moments;
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < closed.size(); ++k) {
    const double edge = (closed[k + 1] - closed[k]).norm();
    moments.mean += 0.5 * edge * (closed[k] + closed[k + 1]);
    length += edge;
  }
  moments.mean /= length;
  for (std::size_t k = 0; k + 1 < closed.size(); ++k) {
    const Vector3d a = closed[k] - moments.mean;
    const Vector3d b = closed[k + 1] - moments.mean;
    const double weight = (b - a).norm() / (6.0 * length);
    moments.covariance +=
        weight * (a * a.transpose() + b * b.transpose() + (a + b) * (a + b).transpose());
  }
  return moments;
}

void require_loop(std::span<const Vector3d> points, const std::string& where) {
  if (points.size() < 3) {
    throw InputError(where + " has " + std::to_string(points.size()) +
                     " vertices; a boundary loop needs at least 3");
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite()) {
      throw InputError(where + " has a non-finite position at index " + std::to_string(k) +
                       "; repair the mesh with `lapwing check --fix`");
    }
  }
}

}  // namespace

LoopCurve::LoopCurve(std::span<const Vector3d> points, const std::string& where)
    : points_(points.begin(), points.end()), lengths_{0.0} {
  require_loop(points, where);
  points_.push_back(points.front());
  for (std::size_t k = 0; k < points.size(); ++k) {
    lengths_.push_back(lengths_.back() + (points_[k + 1] - points_[k]).norm());
  }
  if (length() > 0.0) {
    const Eigenvectors3 axes = symmetric_eigenvectors(moments_of(points_).covariance);
    if (axes.values[1] > kThinnest * kThinnest * length() * length()) return;
  }
  throw InputError(where +
                   ": its points are collinear, so the orientation of the part is undefined; "
                   "choose another loop or region");
}

void LoopCurve::spread(double start, std::span<Vector3d> spread) const {
  const auto count = static_cast<double>(spread.size());
  std::size_t edge = 0;
  double last = 0.0;
  for (std::size_t k = 0; k < spread.size(); ++k) {
    const double share = start + static_cast<double>(k) / count;
    const double at = (share - std::floor(share)) * length();
    if (at < last) edge = 0;
    last = at;
    while (edge + 2 < lengths_.size() && lengths_[edge + 1] < at) ++edge;
    const double from = lengths_[edge];
    const double span = lengths_[edge + 1] - from;
    const double t = span > 0.0 ? (at - from) / span : 0.0;
    spread[k] = points_[edge] + t * (points_[edge + 1] - points_[edge]);
  }
}

LoopFrame loop_frame(const LoopCurve& curve) {
  const Moments moments = moments_of(curve.points());
  LoopFrame frame;
  frame.center = moments.mean;
  frame.radius = std::sqrt(moments.covariance.trace());
  Vector3d area = Vector3d::Zero();
  const auto& points = curve.points();
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    area += 0.5 * (points[k] - frame.center).cross(points[k + 1] - frame.center);
  }
  if (area.norm() > kLeastArea * frame.radius * frame.radius) {
    frame.normal = area.normalized();
    return frame;
  }
  frame.normal = symmetric_eigenvectors(moments.covariance).vectors.col(0);
  if (frame.normal.dot(area) < 0.0) frame.normal = -frame.normal;
  return frame;
}

std::vector<Vector3d> loop_points(const BoundaryLoop& loop, std::span<const Vector3d> positions) {
  std::vector<Vector3d> points;
  points.reserve(loop.size());
  for (const Index v : loop) points.push_back(positions[v]);
  return points;
}

double loop_length(const BoundaryLoop& loop, std::span<const Vector3d> positions) {
  double length = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    length += (positions[loop[(k + 1) % loop.size()]] - positions[loop[k]]).norm();
  }
  return length;
}

std::vector<Vector3d> transformed(std::span<const Vector3d> points, const Eigen::Affine3d& map) {
  std::vector<Vector3d> images(points.begin(), points.end());
  for (Vector3d& p : images) p = map * p;
  return images;
}

}  // namespace lapwing
