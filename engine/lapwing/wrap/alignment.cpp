#include "lapwing/wrap/alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kSamples = 400;  // of each surface
constexpr int kIterations = 30;
// After this number of iterations, only the best starts are continued.
constexpr int kFirstIterations = 6;
constexpr std::size_t kPromising = 6;
constexpr double kKept = 0.8;  // fraction of the pairs that are kept

// The centroid, the principal axes as columns in order of their moments, and the root mean square
// distance from the centroid.
struct PrincipalFrame {
  Vector3d centroid = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();
  double radius = 0.0;
};

PrincipalFrame principal_frame(const ScanSurface& surface) {
  PrincipalFrame frame;
  double whole = 0.0;
  for (std::size_t v = 0; v < surface.areas().size(); ++v) {
    if (!(surface.areas()[v] > 0.0)) continue;
    whole += surface.areas()[v];
    frame.centroid += surface.areas()[v] * surface.positions()[v];
  }
  frame.centroid /= whole;
  Matrix3d covariance = Matrix3d::Zero();
  for (std::size_t v = 0; v < surface.areas().size(); ++v) {
    if (!(surface.areas()[v] > 0.0)) continue;
    const Vector3d from = surface.positions()[v] - frame.centroid;
    covariance += surface.areas()[v] / whole * from * from.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance);
  frame.axes = solver.eigenvectors();
  if (frame.axes.determinant() < 0.0) frame.axes.col(0) *= -1.0;
  frame.radius = std::sqrt(covariance.trace());
  return frame;
}

// Returns the 24 rotations of a cube.
std::vector<Matrix3d> rotations_of_cube() {
  std::vector<Matrix3d> rotations;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d R = Matrix3d::Zero();
      for (int k = 0; k < 3; ++k) {
        R(order[static_cast<std::size_t>(k)], k) = (signs >> k & 1) != 0 ? -1.0 : 1.0;
      }
      if (R.determinant() > 0.0) rotations.push_back(R);
    }
  } while (std::ranges::next_permutation(order).found);
  return rotations;
}

double scale_of(const Affine3d& map) {
  return std::cbrt(map.linear().determinant());
}

// A pair of points that should coincide after the alignment.
struct Pair {
  Vector3d from;
  Vector3d to;
  double distance;
};

// Appends a pair for each sample and its closest point on the other surface, except for the
// farthest pairs. Returns their mean distance.
template <class Find>
double add_pairs(const SurfaceSamples& samples, const Find& find, std::vector<Pair>& pairs) {
  std::vector<Pair> found;
  for (std::size_t k = 0; k < samples.points.size(); ++k) {
    found.push_back(find(samples.points[k], samples.normals[k]));
  }
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(found.size()));
  std::ranges::nth_element(found, found.begin() + static_cast<std::ptrdiff_t>(kept), {},
                           &Pair::distance);
  found.resize(kept);
  double sum = 0.0;
  for (const Pair& pair : found) sum += pair.distance;
  pairs.insert(pairs.end(), found.begin(), found.end());
  return sum / static_cast<double>(std::max<std::size_t>(kept, 1));
}

Affine3d similarity(std::span<const Vector3d> from, std::span<const Vector3d> to) {
  using Columns = Eigen::Map<const Eigen::Matrix3Xd>;
  const auto count = static_cast<Eigen::Index>(from.size());
  return Affine3d(
      Eigen::umeyama(Columns(from.front().data(), 3, count), Columns(to.front().data(), 3, count)));
}

}  // namespace

Alignment align_points(std::span<const Vector3d> from, std::span<const Vector3d> to) {
  const auto are_on_a_line = [](std::span<const Vector3d> points) {
    constexpr double kFlat = 1e-6;
    Vector3d centroid = Vector3d::Zero();
    for (const Vector3d& p : points) centroid += p / static_cast<double>(points.size());
    Matrix3d covariance = Matrix3d::Zero();
    for (const Vector3d& p : points) covariance += (p - centroid) * (p - centroid).transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
    return !(solver.eigenvalues()[1] > kFlat * kFlat * solver.eigenvalues()[2]);
  };
  if (from.size() < 3 || are_on_a_line(from) || are_on_a_line(to)) {
    throw InputError(
        "The alignment needs three landmarks that are not on one line. Add a landmark.");
  }
  Alignment alignment;
  alignment.method = AlignmentMethod::landmarks;
  alignment.map = alignment.start = similarity(from, to);
  alignment.scale = scale_of(alignment.map);
  return alignment;
}

// Iterative closest points between two surfaces, from one start.
class Registration {
 public:
  Registration(const ScanSurface& surface, const ScanSurface& scan)
      : surface_(surface),
        scan_(scan),
        of_surface_(surface.samples(kSamples)),
        of_scan_(scan.samples(kSamples)) {}

  // Improves `map` by `iterations` steps, each of which calls `fit(from, to)` for pairs of closest
  // points. Returns the mean distance of the pairs in both directions.
  template <class Fit>
  double improve(Affine3d& map, int iterations, const Fit& fit) const {
    double distance = 0.0;
    for (int k = 0; k <= iterations; ++k) {
      check_cancelled();
      std::vector<Pair> pairs;
      distance = find_pairs(map, pairs);
      if (k == iterations) break;
      Positions from;
      Positions to;
      for (const Pair& pair : pairs) {
        from.push_back(pair.from);
        to.push_back(pair.to);
      }
      const Affine3d next = fit(from, to);
      // If the surfaces do not fit, pairs in both directions can shrink the surface to a point.
      if (!(scale_of(next) > kSmallest * scale_of(map))) {
        return std::numeric_limits<double>::infinity();
      }
      map = next;
    }
    return distance;
  }

 private:
  static constexpr double kSmallest = 0.3;

  double find_pairs(const Affine3d& map, std::vector<Pair>& pairs) const {
    const Affine3d back = map.inverse();
    // Normals transform by the transposed inverse.
    const Matrix3d forth_of_normals = back.linear().transpose();
    const Matrix3d back_of_normals = map.linear().transpose();
    Index hint = kNoIndex;
    double distance = add_pairs(
        of_surface_,
        [&](const Vector3d& point, const Vector3d& normal) -> Pair {
          const Counterpart on_scan =
              scan_.counterpart(map * point, (forth_of_normals * normal).normalized(), hint);
          return {point, on_scan.position, on_scan.distance};
        },
        pairs);
    hint = kNoIndex;
    distance += add_pairs(
        of_scan_,
        [&](const Vector3d& point, const Vector3d& normal) -> Pair {
          const Counterpart on_surface =
              surface_.counterpart(back * point, (back_of_normals * normal).normalized(), hint);
          return {on_surface.position, point, (map * on_surface.position - point).norm()};
        },
        pairs);
    return 0.5 * distance;
  }

  const ScanSurface& surface_;
  const ScanSurface& scan_;
  SurfaceSamples of_surface_;
  SurfaceSamples of_scan_;
};

// Returns the affine map that minimizes the squared distances of `to` from the mapped `from`.
Affine3d affine_fit(std::span<const Vector3d> from, std::span<const Vector3d> to) {
  Vector3d center_from = Vector3d::Zero();
  Vector3d center_to = Vector3d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) {
    center_from += from[k] / static_cast<double>(from.size());
    center_to += to[k] / static_cast<double>(from.size());
  }
  Matrix3d moments = Matrix3d::Zero();
  Matrix3d mixed = Matrix3d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) {
    moments += (from[k] - center_from) * (from[k] - center_from).transpose();
    mixed += (to[k] - center_to) * (from[k] - center_from).transpose();
  }
  // The small term makes the fit of a flat surface unique.
  const Matrix3d regular = moments + 1e-6 * moments.trace() * Matrix3d::Identity();
  Affine3d map;
  map.linear() = (regular.ldlt().solve(mixed.transpose())).transpose();
  map.translation() = center_to - map.linear() * center_from;
  return map;
}

Alignment align_surfaces(const ScanSurface& surface, const ScanSurface& scan) {
  const PrincipalFrame from = principal_frame(surface);
  const PrincipalFrame to = principal_frame(scan);
  const Registration registration(surface, scan);
  const std::vector<Matrix3d> rotations = rotations_of_cube();
  std::vector<Alignment> starts(rotations.size());
  for (std::size_t k = 0; k < starts.size(); ++k) {
    Affine3d& map = starts[k].map;
    map.linear() = to.radius / from.radius * to.axes * rotations[k] * from.axes.transpose();
    map.translation() = to.centroid - map.linear() * from.centroid;
  }
  const auto improve = [&](int iterations, int affine_iterations) {
    parallel_for(starts.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        registration.improve(starts[k].map, iterations, similarity);
        starts[k].start = starts[k].map;
        starts[k].mean_distance =
            registration.improve(starts[k].start, affine_iterations, affine_fit);
      }
    });
    std::ranges::stable_sort(starts, {}, &Alignment::mean_distance);
  };
  improve(kFirstIterations, kFirstIterations);
  starts.resize(kPromising);
  improve(kIterations, kIterations);
  Alignment best = starts.front();
  best.method = AlignmentMethod::surfaces;
  if (!std::isfinite(best.mean_distance)) {
    throw InputError(
        "The template cannot be aligned with the scan. Add three landmarks, or align the template "
        "by hand.");
  }
  best.scale = scale_of(best.map);
  best.mean_distance /= bounds_of(scan.positions()).diagonal();
  return best;
}

}  // namespace lapwing
