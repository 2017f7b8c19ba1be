#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// If a sum cancels to less than this fraction of its terms, only rounding errors remain.
constexpr double kRoundingShare = 1e-12;
// If a mapped ring is smaller than the target's ring by more than this factor, its extent is only a
// rounding error.
constexpr double kMostScale = 1e12;

// Sums over the edges of a row: a_j are the edges of the mapped ring, b_j those of the target's
// ring.
struct RingEdges {
  Matrix3d moment = Matrix3d::Zero();  // sum_j b_j a_j'
  double source_spread = 0.0;          // sum_j |a_j|^2
  double target_spread = 0.0;
};

RingEdges edges_of(const MappedRings& rings, std::size_t row, std::span<const Vector3d> source,
                   std::span<const Vector3d> target) {
  const SurfacePoint& here = rings.points[row];
  const Vector3d& anchor = source[here.corners[0]];
  const Vector3d own = offset_from(anchor, here, source);
  RingEdges edges;
  for (std::size_t e = rings.target.starts[row]; e < rings.target.starts[row + 1]; ++e) {
    const Index j = rings.target.neighbours[e];
    const SurfacePoint& there = rings.points[j];
    if (there.is_nowhere()) continue;
    const Vector3d a = offset_from(anchor, there, source) - own;
    const Vector3d b = target[j] - target[row];
    edges.moment += b * a.transpose();
    edges.source_spread += a.squaredNorm();
    edges.target_spread += b.squaredNorm();
  }
  return edges;
}

Vector3d unit_or_zero(const Vector3d& normal) {
  const double length = normal.norm();
  return length > kRoundingShare ? Vector3d(normal / length) : Vector3d::Zero();
}

// Returns a right-handed orthonormal frame with `normal` as the third axis (Duff et al., "Building
// an orthonormal basis, revisited", 2017).
Matrix3d frame_of(const Vector3d& normal) {
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1.0 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  Matrix3d frame;
  frame.col(0) << 1.0 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x();
  frame.col(1) << b, sign + normal.y() * normal.y() * a, -normal.y();
  frame.col(2) = normal;
  return frame;
}

// The turn about the third axis that maximizes trace(turn' H). It depends only on the upper left 2
// x 2 block of H.
struct PlaneTurn {
  explicit PlaneTurn(const Matrix3d& H)
      : cosine(H(0, 0) + H(1, 1)), sine(H(1, 0) - H(0, 1)), length(std::hypot(cosine, sine)) {}
  Matrix3d matrix() const {
    Matrix3d turn = Matrix3d::Identity();
    if (!(length > 0.0)) return turn;
    turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    turn.topLeftCorner<2, 2>() /= length;
    return turn;
  }
  double cosine;
  double sine;
  double length;
};

// Returns F_t Rz F_s'. F_s and F_t are the frames, and Rz rotates the projected edges of the mapped
// ring to those of the target's ring. If the edges determine no turn, the coordinate axes replace
// them, which leads to the smallest rotation.
Matrix3d turn_of_frames(const Vector3d& source_normal, const Vector3d& target_normal,
                        const RingEdges& edges) {
  const Matrix3d source = frame_of(source_normal);
  const Matrix3d target = frame_of(target_normal);
  PlaneTurn turn(target.transpose() * edges.moment * source);
  if (turn.length <= kRoundingShare * std::sqrt(edges.source_spread * edges.target_spread)) {
    turn = PlaneTurn(target.transpose() * source);
  }
  return target * turn.matrix() * source.transpose();
}

Matrix3d turn_of_row(const MappedRings& rings, std::size_t row, const FramedSurface& source,
                     const FramedSurface& target) {
  if (rings.points[row].is_nowhere()) return Matrix3d::Identity();
  const RingEdges edges = edges_of(rings, row, source.positions, target.positions);
  const Vector3d source_normal = unit_or_zero(rings.points[row].of(source.normals));
  const Vector3d target_normal = unit_or_zero(target.normals[row]);
  const bool framed = !source_normal.isZero(0.0) && !target_normal.isZero(0.0);
  const Matrix3d R =
      framed ? turn_of_frames(source_normal, target_normal, edges) : nearest_rotation(edges.moment);
  const bool extent = edges.target_spread < kMostScale * kMostScale * edges.source_spread;
  return extent ? Matrix3d(std::sqrt(edges.target_spread / edges.source_spread) * R) : R;
}

}  // namespace

void CpuKernels::rotate_frames(const MappedRings& rings, const FramedSurface& source,
                               const FramedSurface& target, std::span<Matrix3d> transforms) {
  constexpr std::size_t kRowsPerTask = 512;
  parallel_for(rings.target.row_count(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      transforms[r] = turn_of_row(rings, r, source, target);
    }
  });
}

}  // namespace lapwing
