#include "lapwing/deform/certificate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numbers>
#include <sstream>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/inversion.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kRingsPerTask = 256;

Vector3d area_normal(const Triangle& t, std::span<const Vector3d> p) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// Returns true if the ratio of the smallest height to the longest side exceeds kThinnestTriangle.
bool is_not_degenerate(const Triangle& t, std::span<const Vector3d> p) {
  const double longest =
      std::max({(p[t[1]] - p[t[0]]).squaredNorm(), (p[t[2]] - p[t[1]]).squaredNorm(),
                (p[t[0]] - p[t[2]]).squaredNorm()});
  return area_normal(t, p).norm() > kThinnestTriangle * longest;
}

// Returns the flipped triangles that touch `roi`, ascending. Each is tested at its first corner in
// `roi`.
std::vector<Index> flipped_triangles(std::span<const Index> roi, std::span<const char> in_roi,
                                     std::span<const Matrix3d> rotation_of,
                                     const Topology& topology, std::span<const Vector3d> rest,
                                     std::span<const Vector3d> current) {
  std::mutex mutex;
  std::vector<Index> flipped;
  parallel_for(roi.size(), kRingsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      for (const Index t : topology.vertex_triangles[roi[r]]) {
        const Triangle& corners = topology.triangles[t];
        const auto first =
            std::find_if(corners.begin(), corners.end(), [&](Index v) { return in_roi[v] != 0; });
        if (*first != roi[r] || !is_not_degenerate(corners, rest)) continue;
        Matrix3d turn = Matrix3d::Zero();
        for (const Index v : corners) {
          turn += in_roi[v] != 0 ? rotation_of[v] : Matrix3d(Matrix3d::Identity());
        }
        const Vector3d expected = turn * area_normal(corners, rest);
        if (!(expected.dot(area_normal(corners, current)) < 0.0)) continue;
        const std::scoped_lock lock(mutex);
        flipped.push_back(t);
      }
    }
  });
  std::sort(flipped.begin(), flipped.end());
  return flipped;
}

std::vector<Index> free_vertices(const EditRegion& region, std::size_t vertex_count) {
  std::vector<char> held = vertex_mask(vertex_count, region.belt);
  for (const auto& handle : region.handles) {
    for (const Index v : handle) held[v] = 1;
  }
  std::vector<Index> free;
  std::ranges::copy_if(region.roi, std::back_inserter(free), [&](Index v) { return !held[v]; });
  return free;
}

// Sets the smallest and largest scale and the largest rotation. If several vertices have the same
// extreme value, the first one is stored.
void set_extremes(std::span<const Index> roi, std::span<const double> scales,
                  std::span<const double> angles, Certificate& certificate) {
  double largest_angle = 0.0;
  CancelCheck cancel_check;
  for (std::size_t m = 0; m < roi.size(); ++m) {
    cancel_check();
    if (m == 0 || scales[m] < certificate.smallest_scale) {
      certificate.smallest_scale = scales[m];
      certificate.smallest_scale_vertex = roi[m];
    }
    if (m == 0 || scales[m] > certificate.largest_scale) {
      certificate.largest_scale = scales[m];
      certificate.largest_scale_vertex = roi[m];
    }
    if (angles[m] > largest_angle) {
      largest_angle = angles[m];
      certificate.largest_rotation_vertex = roi[m];
    }
  }
  certificate.largest_rotation_degrees = largest_angle * 180.0 / std::numbers::pi;
}

}  // namespace

std::vector<Matrix3d> measure_shape(std::span<const Index> roi, const Topology& topology,
                                    std::span<const Vector3d> rest,
                                    std::span<const Vector3d> current, Certificate& certificate,
                                    std::span<const Matrix3d> asked) {
  certificate.rest_diagonal = bounds_of(surface_positions(rest, topology)).diagonal();
  for (const Index v : roi) {
    certificate.all_finite = certificate.all_finite && current[v].allFinite();
  }
  if (!certificate.all_finite) return {};

  std::vector<double> scales(roi.size());
  std::vector<double> angles(roi.size());
  std::vector<char> in_roi(rest.size(), 0);
  std::vector<Matrix3d> rotations(rest.size());
  parallel_for(roi.size(), kRingsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const Index i = roi[m];
      const RingSimilarity ring = fit_similarity(i, topology.rings[i], rest, current);
      in_roi[i] = 1;
      rotations[i] =
          asked.empty() ? ring.R : fit_rotation(i, topology.rings[i], rest, current, asked[i]);
      scales[m] = ring.scale;
      angles[m] = rotation_angle(rotations[i]);
    }
  });
  set_extremes(roi, scales, angles, certificate);
  const EdgeStretches edges = edge_stretches(roi, topology, rest, current, asked);
  certificate.edge_stretch = edges.root_mean_square;
  certificate.largest_edge_stretch = edges.most.stretch;
  certificate.largest_edge_stretch_vertices = edges.most.vertices;
  const std::vector<Index> flipped =
      flipped_triangles(roi, in_roi, rotations, topology, rest, current);
  certificate.flipped_triangles = flipped.size();
  certificate.first_flipped_triangles.assign(
      flipped.begin(), flipped.begin() + std::min(flipped.size(), kListedTriangles));
  // Only a surface that has rotated far can be inside out.
  if (!flipped.empty() || certificate.largest_rotation_degrees > kFarTurnDegrees) {
    const Inversion inversion = measure_inversion(roi, topology, rest, current);
    certificate.inside_out_share = inversion.share;
    certificate.inside_out_vertex = inversion.vertex;
  }
  certificate.region_is_whole = std::ranges::all_of(roi, [&](Index i) {
    return std::ranges::all_of(topology.rings[i], [&](Index j) { return in_roi[j] != 0; });
  });
  return rotations;
}

void measure_region(const EditRegion& region, const Topology& topology,
                    std::span<const double> weights, std::span<const Vector3d> rest,
                    std::span<const Vector3d> current, Certificate& certificate,
                    std::span<const Matrix3d> asked) {
  const std::vector<Matrix3d> rotations =
      measure_shape(region.roi, topology, rest, current, certificate, asked);
  if (!certificate.all_finite) return;
  certificate.detail_error = detail_error(free_vertices(region, rest.size()), topology, weights,
                                          rest, current, rotations, asked);
}

void require_valid(const Certificate& certificate) {
  const Certificate& c = certificate;
  const bool all_measured = std::isfinite(c.handle_error) && std::isfinite(c.target_error) &&
                            std::isfinite(c.edge_stretch) &&
                            std::isfinite(c.largest_edge_stretch) &&
                            std::isfinite(c.largest_scale) && std::isfinite(c.settle_last_step);
  if (!c.all_finite || !all_measured) {
    throw SolverError(
        "the result has non-finite positions or distances, so the mesh is unchanged; run "
        "`lapwing check` on it, and make sure that the handle's motion is finite");
  }
  if (!(certificate.relative_residual <= kLargestResidual)) {
    std::ostringstream text;
    text << "the relative residual of the solution is " << certificate.relative_residual
         << ", above the limit of " << kLargestResidual
         << ", so the mesh is unchanged. The region is nearly unconstrained: add belt vertices, or "
            "raise constraint_weight";
    throw SolverError(text.str());
  }
}

}  // namespace lapwing
