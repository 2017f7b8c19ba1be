#include "lapwing/deform/handle_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace lapwing {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Returns true if `value` is the same for all handles, up to the rounding errors of a rotation's
// scale.
bool is_one_number(std::size_t handles, const auto& value) {
  constexpr double kRounding = 1e-12;
  if (handles == 0) return true;
  double least = value(0);
  double most = least;
  for (std::size_t h = 1; h < handles; ++h) {
    least = std::min(least, value(h));
    most = std::max(most, value(h));
  }
  return most - least <= kRounding * std::max(std::abs(least), std::abs(most));
}

}  // namespace

HandleWeights::HandleWeights(const EditSystem& system)
    : system_(system), factor_(system.region.roi.size(), 1.0) {
  sum_ = solved_columns({0}, [](std::size_t, std::size_t) { return 1.0; }).front();
  const bool all = system.is_held_by_handles_alone();
  for (std::size_t r = 0; r < sum_.size(); ++r) {
    const double sum = sum_[r];
    if (sum > 0.0) sum_[r] = all ? 1.0 : std::min(sum, 1.0);
    if (sum <= 0.0) sum_[r] = 0.0;
    factor_[r] = sum > 0.0 ? sum_[r] / sum : 0.0;
  }
}

std::vector<std::vector<double>> HandleWeights::solved_columns(
    const std::vector<std::size_t>& columns, const ValueOfHandle& value) const {
  const LaplacianSystem& laplacian = *system_.laplacian;
  const VertexSet& roi = system_.region.roi;
  const std::size_t n = laplacian.size();
  std::vector<std::vector<double>> fields;
  std::vector<double> b(3 * n);
  std::vector<Vector3d> prescribed(system_.rest->size(), Vector3d::Zero());
  // Solves three columns at a time, as x, y and z.
  for (std::size_t first = 0; first < columns.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, columns.size() - first);
    std::vector<Vector3d> of_handle;
    for (std::size_t h = 0; h < system_.region.handles.size(); ++h) {
      Vector3d values = Vector3d::Zero();
      for (std::size_t k = 0; k < count; ++k) {
        values[static_cast<Eigen::Index>(k)] = value(h, columns[first + k]);
      }
      for (const Index v : system_.region.handles[h]) prescribed[v] = values;
      of_handle.push_back(values);
    }
    for (const FalloffVertex& g : system_.region.graded) prescribed[g.vertex] = of_handle[g.handle];
    laplacian.right_hand_side(prescribed, b);
    laplacian.solve_in_place(std::span(b).first(count * n), count);
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<double>& field = fields.emplace_back();
      for (std::size_t r = 0; r < roi.size(); ++r) {
        const Index u = system_.constraints.unknowns.of_vertex[roi[r]];
        field.push_back(factor_[r] * (u == kNoIndex
                                          ? prescribed[roi[r]][static_cast<Eigen::Index>(k)]
                                          : b[k * n + u]));
      }
    }
  }
  return fields;
}

std::vector<std::vector<double>> HandleWeights::spread_columns(std::size_t count,
                                                               const ValueOfHandle& value) const {
  std::vector<std::size_t> differing;
  std::vector<std::vector<double>> fields(count);
  for (std::size_t c = 0; c < count; ++c) {
    if (!is_one_number(system_.region.handles.size(), [&](std::size_t h) { return value(h, c); })) {
      differing.push_back(c);
      continue;
    }
    fields[c] = sum_;
    if (system_.region.handles.empty()) continue;
    for (double& number : fields[c]) number *= value(0, c);
  }
  std::vector<std::vector<double>> solved = solved_columns(differing, value);
  for (std::size_t k = 0; k < differing.size(); ++k) fields[differing[k]] = std::move(solved[k]);
  return fields;
}

std::vector<double> HandleWeights::spread(std::span<const double> values) const {
  return spread_columns(1, [&](std::size_t h, std::size_t) { return values[h]; }).front();
}

std::vector<double> HandleWeights::of_handle(std::size_t handle) const {
  return spread_columns(1, [&](std::size_t h, std::size_t) { return h == handle ? 1.0 : 0.0; })
      .front();
}

std::vector<Vector3d> HandleWeights::displacement(std::span<const Affine3d> motions,
                                                  std::span<const AngleAxisd> turns,
                                                  const RestStretch& rest_stretch) const {
  const EditSystem& s = system_;
  const VertexSet& roi = s.region.roi;
  // For each handle: its turn, its centroid, and the centroid's displacement.
  constexpr std::size_t kNumbers = 9;
  std::vector<std::array<double, kNumbers>> of_handle(motions.size());
  for (std::size_t h = 0; h < motions.size(); ++h) {
    const Vector3d& centroid = s.frames[h].centroid;
    double* out = of_handle[h].data();
    Eigen::Map<Vector3d>{out} = turns[h].angle() * turns[h].axis();
    Eigen::Map<Vector3d>{out + 3} = centroid;
    Eigen::Map<Vector3d>{out + 6} = motions[h] * centroid - centroid;
  }
  const std::vector<std::vector<double>> fields =
      spread_columns(kNumbers, [&](std::size_t h, std::size_t k) { return of_handle[h][k]; });
  std::vector<Vector3d> u(s.rest->size(), Vector3d::Zero());
  for (std::size_t r = 0; r < roi.size(); ++r) {
    if (sum_[r] == 0.0) continue;
    std::array<double, kNumbers> at;
    for (std::size_t k = 0; k < kNumbers; ++k) at[k] = fields[k][r];
    const Eigen::Map<const Vector3d> turn(at.data());
    const Eigen::Map<const Vector3d> pivot(at.data() + 3);
    const Eigen::Map<const Vector3d> move(at.data() + 6);
    const Vector3d arm = (*s.rest)[roi[r]] - pivot / sum_[r];
    Vector3d stretched = rest_stretch.common * arm;
    if (!rest_stretch.u.empty()) stretched += rest_stretch.u[roi[r]];
    const double angle = turn.norm();
    u[roi[r]] = move - arm +
                (angle > 0.0 ? Vector3d(AngleAxisd(angle, turn / angle) * stretched) : stretched);
  }
  return u;
}

}  // namespace lapwing
