#include "lapwing/deform/rest_stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "lapwing/base/parallel.h"
#include "lapwing/deform/linear_response.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Largest relative difference of stretches that are considered equal: the rounding error for a
// rotation.
constexpr double kEqualStretches = 1e-12;
// Lower bound of the determinant of the tangential moment, relative to its squared trace. The
// moment is singular for a collinear ring.
constexpr double kCollinearRing = 1e-12;

using Tangents = Eigen::Matrix<double, 3, 2>;

bool are_equal(const Matrix3d& a, const Matrix3d& b) {
  return (a - b).norm() <= kEqualStretches * b.norm();
}

// Returns true if every motion preserves lengths, up to rounding errors.
bool are_rigid(std::span<const Eigen::Affine3d> motions) {
  return std::ranges::all_of(motions, [](const Eigen::Affine3d& motion) {
    return are_equal(motion.linear().transpose() * motion.linear(), Matrix3d::Identity());
  });
}

// Returns the stretch of a handle that is nearest to the identity if only handles hold the region;
// otherwise returns the identity.
Matrix3d common_stretch(const EditSystem& system, std::span<const Matrix3d> of_handles) {
  if (!system.is_held_by_handles_alone()) return Matrix3d::Identity();
  return *std::min_element(
      of_handles.begin(), of_handles.end(), [](const Matrix3d& a, const Matrix3d& b) {
        return (a - Matrix3d::Identity()).norm() < (b - Matrix3d::Identity()).norm();
      });
}

// Returns u of the smooth map x -> common x + u that interpolates the handles' stretches.
std::vector<Vector3d> smooth_map(const EditSystem& system, std::span<const Matrix3d> of_handles,
                                 const Matrix3d& common) {
  std::vector<Eigen::Affine3d> stretching;
  for (std::size_t h = 0; h < of_handles.size(); ++h) {
    const Vector3d& centroid = system.frames[h].centroid;
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    map.linear() += of_handles[h] - common;
    map.translation() = centroid - map.linear() * centroid;
    stretching.push_back(map);
  }
  std::vector<double> parameters(system.column_count());
  system.set_parameters(stretching, parameters);
  return laplacian_displacement(system, system.displacement_of_handles(parameters),
                                Springs::ignored);
}

class RingStretch {
 public:
  RingStretch(const EditSystem& system, const Matrix3d& common, std::span<const Vector3d> u)
      : topology_(system.topology),
        rest_(*system.rest),
        weights_(system.laplacian->weights().laplacian),
        common_(common),
        u_(u) {}

  // Returns S_i, or `common` if the ring has no tangent plane.
  Matrix3d operator()(Index i) const {
    const Vector3d normal = normal_at(i);
    if (normal.isZero(0.0)) return common_;
    Tangents tangents;
    tangents.col(0) = normal.unitOrthogonal();
    tangents.col(1) = normal.cross(tangents.col(0));
    // Fits the gradient of u instead of that of x + u, because the edges of x + u are not in the
    // tangent plane.
    Matrix3d change = Matrix3d::Zero();
    Matrix3d moment = Matrix3d::Zero();
    for (std::size_t e = topology_.rings.starts[i]; e < topology_.rings.starts[i + 1]; ++e) {
      const Index j = topology_.rings.values[e];
      const Vector3d edge = common_ * (rest_[j] - rest_[i]);
      change += weights_[e] * (u_[j] - u_[i]) * edge.transpose();
      moment += weights_[e] * edge * edge.transpose();
    }
    const Matrix2d in_plane = tangents.transpose() * moment * tangents;
    if (!(in_plane.determinant() > kCollinearRing * in_plane.trace() * in_plane.trace())) {
      return common_;
    }
    const Tangents images = tangents + change * tangents * in_plane.inverse();
    Eigen::SelfAdjointEigenSolver<Matrix2d> squares;
    squares.computeDirect(images.transpose() * images);
    const Vector2d stretches = squares.eigenvalues()
                                   .cwiseMax(kLeastStretch * kLeastStretch)
                                   .cwiseMin(1.0 / (kLeastStretch * kLeastStretch))
                                   .cwiseSqrt();
    const Tangents axes = tangents * squares.eigenvectors();
    const Matrix3d S = axes * stretches.asDiagonal() * axes.transpose() +
                       std::sqrt(stretches[0] * stretches[1]) * normal * normal.transpose();
    return common_ == Matrix3d::Identity() ? S : polar_stretch(S * common_);
  }

 private:
  // Returns the area-weighted normal of the surface stretched by `common`.
  Vector3d normal_at(Index i) const {
    Vector3d sum = Vector3d::Zero();
    for (const Index t : topology_.vertex_triangles[i]) {
      const auto& [a, b, c] = topology_.triangles[t];
      sum += (common_ * (rest_[b] - rest_[a])).cross(common_ * (rest_[c] - rest_[a]));
    }
    return sum.stableNormalized();
  }

  const Topology& topology_;
  const Positions& rest_;
  std::span<const double> weights_;
  const Matrix3d& common_;
  std::span<const Vector3d> u_;
};

}  // namespace

RestStretch rest_stretch(const EditSystem& system, std::span<const Eigen::Affine3d> motions) {
  if (are_rigid(motions)) return {};
  std::vector<Matrix3d> of_handles;
  for (const Eigen::Affine3d& motion : motions) {
    of_handles.push_back(polar_stretch(motion.linear()));
  }
  const auto all_are = [&](const Matrix3d& P) {
    return std::ranges::all_of(of_handles, [&](const Matrix3d& of) { return are_equal(of, P); });
  };
  RestStretch result;
  result.common = common_stretch(system, of_handles);
  std::vector<Matrix3d>& stretch = result.of_vertices;
  stretch.assign(system.rest->size(), Matrix3d::Identity());
  const VertexSet& roi = system.region.roi;
  if (all_are(result.common)) {
    for (const Index v : roi) stretch[v] = result.common;
    return result;
  }
  result.u = smooth_map(system, of_handles, result.common);
  const RingStretch stretch_of(system, result.common, result.u);
  constexpr std::size_t kStretchesPerTask = 256;
  parallel_for(roi.size(), kStretchesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) stretch[roi[r]] = stretch_of(roi[r]);
  });
  return result;
}

std::vector<double> mean_scales(std::span<const Matrix3d> stretches) {
  std::vector<double> scales;
  scales.reserve(stretches.size());
  for (const Matrix3d& S : stretches) scales.push_back(std::cbrt(S.determinant()));
  return scales;
}

}  // namespace lapwing
