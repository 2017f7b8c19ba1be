#include "lapwing/deform/modifiers/substeps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "lapwing/base/errors.h"
#include "lapwing/deform/turn_tracker.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

// Subtracted before the quotient is rounded up, so that rounding errors do not add a substep: 0.3
// degrees in steps of 0.1 are three substeps.
constexpr double kRoundingOfQuotient = 1e-9;

bool is_free(const MovedHandle& handle) {
  return handle.orientation == HandleOrientation::free;
}

}  // namespace

std::vector<Affine3d> ResolvedRequest::motions(double from, double to) const {
  std::vector<Affine3d> all;
  for (std::size_t h = 0; h < request.handles.size(); ++h) {
    const Move& move = request.handles[h].move;
    all.push_back(to_affine(move, centroids[h], to));
    if (from > 0.0) all.back() = all.back() * to_affine(move, centroids[h], from).inverse();
  }
  return all;
}

HandleMotions ResolvedRequest::handle_motions(double from, double to) const {
  HandleMotions all{motions(from, to), {}, {}};
  for (const MovedHandle& handle : request.handles) {
    const AxisRotation whole = turn_of(handle.move);
    all.turns.emplace_back((to - from) * whole.degrees * std::numbers::pi / 180.0, whole.axis);
    all.is_free.push_back(is_free(handle) ? 1 : 0);
  }
  if (!all.any_free()) all.is_free.clear();
  return all;
}

std::vector<HandleMotions> ResolvedRequest::path() const {
  std::size_t count = 0;
  for (const MovedHandle& handle : request.handles) count = std::max(count, handle.path.size());
  std::vector<HandleMotions> path;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(count + 1);
    HandleMotions motions = handle_motions(0.0, share);
    for (std::size_t h = 0; h < request.handles.size(); ++h) {
      const MovedHandle& handle = request.handles[h];
      if (handle.path.empty()) continue;
      motions.maps[h] = to_affine(handle.path[k], centroids[h]);
      const AxisRotation turn = turn_of(handle.path[k]);
      motions.turns[h] = {turn.degrees * std::numbers::pi / 180.0, turn.axis};
    }
    path.push_back(std::move(motions));
  }
  return path;
}

LargestTurn largest_turn(const DeformRequest& request) {
  LargestTurn largest;
  for (std::size_t h = 0; h < request.handles.size(); ++h) {
    if (is_free(request.handles[h])) continue;
    const AxisRotation turn = turn_of(request.handles[h].move);
    if (turn.degrees > largest.turn.degrees) largest = {h, turn};
  }
  return largest;
}

std::optional<double> substep_degrees(const DeformParameters& parameters, double turn_degrees,
                                      bool has_path) {
  if (parameters.commit_every) return parameters.commit_every;
  // Linear responses ignore paths, so large turns must be split even if there is a path.
  const bool follows_path = parameters.settle && has_path;
  return exceeds_settled_turn(turn_degrees) && !follows_path ? std::optional(kFarTurnDegrees)
                                                             : std::nullopt;
}

std::size_t commit_count(const DeformRequest& request) {
  const double degrees = largest_turn(request).turn.degrees;
  const bool has_path = std::ranges::any_of(
      request.handles, [](const MovedHandle& handle) { return !handle.path.empty(); });
  const std::optional<double> every = substep_degrees(request.parameters, degrees, has_path);
  if (!every) return 1;
  const double count = std::ceil(degrees / *every - kRoundingOfQuotient);
  if (!(count <= static_cast<double>(kMostCommits))) {
    std::ostringstream text;
    text << request.where << ": a handle turns by " << degrees << " degrees; with substeps of "
         << *every << " degrees that takes more than " << kMostCommits
         << " commits. Raise \"commit_every\", or turn less";
    throw InputError(text.str());
  }
  return static_cast<std::size_t>(std::max(count, 1.0));
}

Certificate certify(const ResolvedRequest& bound, std::span<const Vector3d> start,
                    std::span<const Vector3d> end, std::span<const Certificate> parts,
                    std::span<const Eigen::Matrix3d> stretch) {
  Certificate certificate;
  // The final position of a free handle is not prescribed, but each substep has measured its handle
  // error.
  const bool any_free = std::ranges::any_of(bound.request.handles, is_free);
  for (const Certificate& part : parts) {
    certificate.relative_residual = std::max(certificate.relative_residual, part.relative_residual);
    certificate.relative_gradient = std::max(certificate.relative_gradient, part.relative_gradient);
    certificate.prescribed_motion += part.prescribed_motion;
    if (any_free) {
      certificate.handle_error = std::max(certificate.handle_error, part.handle_error);
    }
    certificate.settle_iterations += part.settle_iterations;
    certificate.settled = certificate.settled && part.settled;
    certificate.lacks_hessian = certificate.lacks_hessian || part.lacks_hessian;
    certificate.settle_last_step = std::max(certificate.settle_last_step, part.settle_last_step);
  }
  const EditRegion& region = bound.region;
  const std::vector<Affine3d> motions = bound.motions(0.0, 1.0);
  for (std::size_t h = 0; h < motions.size(); ++h) {
    if (is_free(bound.request.handles[h])) continue;
    for (const Index v : region.handles[h]) {
      const double error = (end[v] - motions[h] * start[v]).norm();
      certificate.handle_error = std::max(certificate.handle_error, error);
    }
  }
  for (const Target& target : region.targets) {
    const double off = (point_of(target, end) - target.position).norm();
    certificate.target_error = std::max(certificate.target_error, off);
  }
  const auto weights =
      laplacian_weights(bound.topology, start, bound.request.parameters.weights, region.roi);
  measure_region(region, bound.topology, weights, start, end, certificate, stretch);
  require_valid(certificate);
  return certificate;
}

}  // namespace lapwing
