#include "lapwing/deform/modifiers/substeps.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lapwing/base/errors.h"
#include "lapwing/deform/modifiers/winding.h"
#include "lapwing/deform/turn_tracker.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

// 0.3 degrees in parts of 0.1 must give three parts, although the quotient is rounded up.
constexpr double kRoundingOfQuotient = 1e-9;

// Tolerance for a computed half turn.
constexpr double kRoundingDegrees = 1e-6;

}  // namespace

std::optional<double> substep_degrees(const DeformParameters& parameters, double turn_degrees,
                                      bool has_path) {
  if (parameters.commit_every) return parameters.commit_every;
  const bool is_far = turn_degrees > kLargestSettledTurnDegrees + kRoundingDegrees;
  return parameters.settle && is_far && !has_path ? std::optional(kFarTurnDegrees) : std::nullopt;
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
  // The final position of a free handle is not known, but each part has measured its error.
  const auto is_free = [](const MovedHandle& handle) {
    return handle.orientation == HandleOrientation::free;
  };
  const bool any_free = std::ranges::any_of(bound.request.handles, is_free);
  for (const Certificate& part : parts) {
    certificate.relative_residual = std::max(certificate.relative_residual, part.relative_residual);
    certificate.relative_gradient = std::max(certificate.relative_gradient, part.relative_gradient);
    certificate.asked_motion += part.asked_motion;
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
