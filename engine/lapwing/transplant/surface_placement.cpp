// Each step linearizes the rigid motion as a translation and a small rotation, as in point-to-plane
// registration: Chen and Medioni, "Object modelling by registration of multiple range images",
// Image and Vision Computing 10, 1992.
#include "lapwing/transplant/surface_placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/SVD>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kSnapPoints = 96;
constexpr int kSteps = 60;
// The iteration stops if a step is smaller than this, in radii of the loop.
constexpr double kLeastStep = 1e-11;
// If the cosine between the normals of surface and loop is below this, the point is on the back of
// a sheet. A higher threshold would also exclude a neck that the loop surrounds.
constexpr double kBehind = -0.7;
// Below this distance, in radii, the normal of the surface is more reliable than the direction to
// the nearest point.
constexpr double kTouching = 1e-7;
// A step that increases the distances is halved at most down to this fraction.
constexpr double kLeastShare = 1.0 / 64.0;
// Eigenvalues below this fraction of the largest are ignored: their motions slide along the surface
// and hardly change the distances.
constexpr double kIdle = 1e-3;

// Returns one group that contains all triangles with finite corners.
Adjacency usable(std::span<const Triangle> triangles, std::span<const Vector3d> positions,
                 const std::string& where) {
  Adjacency groups;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto finite = [&](Index v) { return positions[v].allFinite(); };
    if (std::ranges::all_of(triangles[t], finite)) groups.values.push_back(static_cast<Index>(t));
  }
  if (groups.values.empty()) {
    throw InputError(where + ": the mesh has no triangles to put a part on");
  }
  groups.starts.push_back(static_cast<Index>(groups.values.size()));
  return groups;
}

// Returns the rigid motion of the step `share` * `step` for a loop with the frame `frame`.
Eigen::Affine3d motion_of(const Vector6d& step, double share, const LoopFrame& frame) {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  const double angle = step.tail<3>().norm();
  if (angle > 0.0) {
    motion.linear() = Eigen::AngleAxisd(share * angle, step.tail<3>() / angle).toRotationMatrix();
  }
  motion.translation() =
      frame.center + share * frame.radius * step.head<3>() - motion.linear() * frame.center;
  return motion;
}

}  // namespace

Eigen::Affine3d place_at(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                         const SurfacePlace& place, const std::string& where) {
  const double length = place.normal.norm();
  if (!place.point.allFinite() || !(length > 0.0) || !std::isfinite(length)) {
    throw InputError(where + ": the place of the part needs a finite point and a nonzero normal");
  }
  if (!(place.scale > 0.0) || !std::isfinite(place.scale) || !std::isfinite(place.rotate_degrees)) {
    throw InputError(where + ": the part needs a finite rotation and a scale above 0");
  }
  const std::vector<Eigen::Vector3d> placed = transformed(part, placement);
  const LoopFrame frame = loop_frame(LoopCurve(placed, where + ": the part's boundary loop"));
  const Eigen::Vector3d normal = place.normal / length;
  const Eigen::AngleAxisd turn(place.rotate_degrees * std::numbers::pi / 180.0, normal);
  Eigen::Affine3d change;
  change.linear() = place.scale * turn.toRotationMatrix() * least_rotation(frame.normal, normal);
  change.translation() = place.point - change.linear() * frame.center;
  change.makeAffine();
  return change * placement;
}

// The linear least-squares problem of one step, in radii of the loop. The unknowns are a
// translation and a rotation about the loop's centre.
struct SurfaceSnap::Contacts {
  Matrix6d normal_matrix = Matrix6d::Zero();
  Vector6d right_side = Vector6d::Zero();
  double squares = 0.0;

  Vector6d step() const {
    // The matrix is symmetric positive semidefinite, so its singular vectors are its eigenvectors.
    // Eigen's eigenvalue solver would take ten times as long to compile.
    const Eigen::JacobiSVD<Matrix6d> modes(normal_matrix, Eigen::ComputeFullV);
    Vector6d result = Vector6d::Zero();
    for (int m = 0; m < 6; ++m) {
      const double gain = modes.singularValues()[m];
      if (!(gain > kIdle * modes.singularValues()[0])) break;
      const Vector6d mode = modes.matrixV().col(m);
      result += mode.dot(right_side) / gain * mode;
    }
    return result;
  }
};

SurfaceSnap::SurfaceSnap(std::span<const Triangle> triangles, std::span<const Vector3d> positions,
                         const std::string& where)
    : normals_(triangles.size(), Vector3d::Zero()),
      surface_(triangles, positions, usable(triangles, positions, where)) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vector3d normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    if (normal.norm() > 0.0) normals_[t] = normal.normalized();
  }
}

SurfaceSnap::Contacts SurfaceSnap::contacts(std::span<const Vector3d> points,
                                            const LoopFrame& frame) const {
  Contacts contacts;
  Index hint = kNoIndex;
  for (const Vector3d& p : points) {
    TrianglePoint nearest = surface_.find(0, p, Vector3d::Zero(), hint);
    if (nearest.triangle == kNoIndex) continue;  // so far that the squared distance overflows
    if (normals_[nearest.triangle].dot(frame.normal) < kBehind) {
      nearest = surface_.find(0, p, frame.normal);
    }
    hint = nearest.hint;
    const Vector3d way = (p - nearest.position) / frame.radius;
    const double distance = way.norm();
    contacts.squares += distance * distance;
    const Vector3d direction =
        distance > kTouching ? Vector3d(way / distance) : normals_[nearest.triangle];
    Vector6d row;
    row << direction, ((p - frame.center) / frame.radius).cross(direction);
    contacts.normal_matrix += row * row.transpose();
    contacts.right_side -= row * way.dot(direction);
  }
  return contacts;
}

Eigen::Affine3d SurfaceSnap::snap(const Eigen::Affine3d& placement, std::span<const Vector3d> part,
                                  const std::string& where) const {
  const LoopCurve curve(transformed(part, placement), where + ": the part's boundary loop");
  const LoopFrame placed = loop_frame(curve);
  std::vector<Vector3d> points(kSnapPoints);
  curve.spread(0.0, points);

  Eigen::Affine3d best = Eigen::Affine3d::Identity();
  LoopFrame frame = placed;
  Contacts reached = contacts(points, frame);
  double share = 1.0;
  for (int k = 0; k < kSteps; ++k) {
    const Vector6d step = reached.step();
    if (!(share * step.norm() > kLeastStep) || share < kLeastShare) break;
    const Eigen::Affine3d next = motion_of(step, share, frame) * best;
    const LoopFrame next_frame{next * placed.center, next.linear() * placed.normal, placed.radius};
    const Contacts tried = contacts(transformed(points, next), next_frame);
    share *= 0.5;
    if (!(tried.squares < reached.squares)) continue;
    best = next;
    frame = next_frame;
    reached = tried;
    share = 1.0;
  }
  return best * placement;
}

}  // namespace lapwing
