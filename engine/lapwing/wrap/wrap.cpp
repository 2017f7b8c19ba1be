#include "lapwing/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/wrap/nonrigid_icp.h"
#include "lapwing/wrap/scan_surface.h"
#include "lapwing/wrap/surfels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The distance from the scan to the result is measured at this many points or more.
constexpr std::size_t kMeasured = 10000;

VertexSet surface_vertices(const Topology& topology) {
  VertexSet vertices;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (topology.rings.size(v) > 0) vertices.push_back(v);
  }
  return vertices;
}

SurfaceDistance measure(std::vector<double> distances) {
  std::ranges::sort(distances);
  const auto count = static_cast<double>(distances.size());
  return {std::accumulate(distances.begin(), distances.end(), 0.0) / count,
          distances[static_cast<std::size_t>(0.95 * (count - 1.0))], distances.back()};
}

SurfaceDistance distance_from_scan(const ScanSurface& scan, const ScanSurface& surface) {
  const SurfaceSamples samples = scan.samples(std::max(kMeasured, surface.positions().size()));
  std::vector<Index> hints;
  std::vector<double> distances;
  for (const Counterpart& c : counterparts_of(samples.points, samples.normals, surface, hints)) {
    distances.push_back(c.distance);
  }
  return measure(std::move(distances));
}

// Returns the counterparts whose normals agree and that are not much farther away than most.
std::vector<SurfacePoint> accepted(std::span<const Counterpart> counterparts, double edge) {
  const double far = std::max(edge, far_distance(counterparts));
  std::vector<SurfacePoint> points;
  for (const Counterpart& c : counterparts) {
    points.push_back(c.agrees && c.distance <= far ? c.point : SurfacePoint::nowhere());
  }
  return points;
}

Alignment align(const ScanSurface& surface, const ScanSurface& scan,
                std::span<const Target> landmarks, bool aligned) {
  constexpr std::size_t kEnough = 3;
  if (aligned) return {};
  if (landmarks.size() < kEnough) return align_surfaces(surface, scan);
  Positions from;
  Positions to;
  for (const Target& landmark : landmarks) {
    from.push_back(point_of(landmark, surface.positions()));
    to.push_back(landmark.position);
  }
  return align_points(from, to);
}

Positions mapped(const Eigen::Affine3d& map, Positions positions) {
  for (Vector3d& p : positions) p = map * p;
  return positions;
}

// Returns the fitted template with its report, without the alignment.
Wrapped measured(const Topology& topology, FittedTemplate fitted, const ScanSurface& scan,
                 const EditRegion& region) {
  Wrapped result{.positions = std::move(fitted.positions)};
  WrapReport& report = result.report;
  const ScanSurface surface(topology, result.positions);
  std::vector<Index> hints;
  const std::vector<Counterpart> on_scan =
      counterparts_of(result.positions, surface.normals(), scan, hints);
  std::vector<double> distances;
  result.distances.assign(on_scan.size(), std::numeric_limits<float>::quiet_NaN());
  for (const Index v : region.roi) {
    distances.push_back(on_scan[v].distance);
    result.distances[v] = static_cast<float>(on_scan[v].distance);
  }
  report.to_scan = measure(std::move(distances));
  report.to_template = distance_from_scan(scan, surface);
  result.counterparts = accepted(on_scan, mean_edge_length(topology.rings, result.positions));
  double area = 0.0;
  double covered = 0.0;
  for (Index v = 0; v < on_scan.size(); ++v) {
    area += surface.areas()[v];
    if (!result.counterparts[v].is_nowhere()) covered += surface.areas()[v];
  }
  report.coverage = covered / area;
  for (std::size_t k = 0; k < region.targets.size(); ++k) {
    const Target& landmark = region.targets[k];
    const double error = (point_of(landmark, result.positions) - landmark.position).norm();
    if (error <= report.landmark_error) continue;
    report.landmark_error = error;
    report.farthest_landmark = k;
  }
  const Certificate& certificate = fitted.certificate;
  report.flipped_triangles = certificate.flipped_triangles;
  report.edge_stretch = certificate.edge_stretch;
  report.most_stretched = {certificate.largest_edge_stretch_vertices,
                           certificate.largest_edge_stretch};
  report.steps = fitted.steps;
  return result;
}

}  // namespace

Wrapped wrap(const Mesh& wrapped, const Mesh& scan, const WrapRequest& request, Kernels& kernels,
             const Progress& progress) {
  const ProgressScope scope(progress);
  require_surface(wrapped, "template");
  const bool is_cloud = scan.face_count() == 0 && scan.vertex_count() > 0;
  const Mesh surfels = is_cloud ? surfels_of(scan, "scan") : Mesh();
  const Mesh& searched = is_cloud ? surfels : scan;
  require_surface(searched, "scan");
  const Topology& topology = wrapped.topology();
  EditRegion region;
  region.roi = surface_vertices(topology);
  region.targets = resolve_targets(request.landmarks, region.roi, {}, wrapped);
  region.stiffness = resolve_stiffness(request.stiffness, region.roi, wrapped);
  const ScanSurface of_scan(searched.topology(), searched.positions, scan.vertex_count());
  report_progress(progress, "align", 0.0);
  Alignment alignment =
      align(ScanSurface(topology, wrapped.positions), of_scan, region.targets, request.aligned);
  FittedTemplate fitted =
      nonrigid_icp(topology, mapped(alignment.map, wrapped.positions),
                   mapped(alignment.start, wrapped.positions), of_scan, region, kernels, progress);
  Wrapped result = measured(topology, std::move(fitted), of_scan, region);
  result.report.alignment = std::move(alignment);
  if (is_cloud) {
    for (SurfacePoint& point : result.counterparts) point = point_of_surfel(point);
  }
  return result;
}

std::vector<SurfacePoint> counterparts_on(const Mesh& scan, const Topology& topology,
                                          std::span<const Vector3d> positions) {
  require_surface(scan, "scan");
  const ScanSurface surface(topology, positions);
  std::vector<Index> hints;
  const std::vector<Counterpart> on_scan = counterparts_of(
      positions, surface.normals(), ScanSurface(scan.topology(), scan.positions), hints);
  return accepted(on_scan, mean_edge_length(topology.rings, positions));
}

std::string why_failed(const WrapReport& report, std::size_t triangle_count) {
  constexpr double kLeastCoverage = 0.5;
  constexpr double kMostFlipped = 1e-3;
  constexpr double kMostStretched = 0.5;
  std::ostringstream text;
  if (report.coverage < kLeastCoverage) {
    text << "Only " << std::lround(100.0 * report.coverage)
         << "% of the template has a counterpart on the scan. Add landmarks, or check that the "
            "faces of both meshes are oriented outward";
  } else if (report.edge_stretch > kMostStretched) {
    const auto& [a, b] = report.most_stretched.vertices;
    text << "The edges are stretched by " << std::lround(100.0 * report.edge_stretch)
         << "% on average, most between vertices " << a << " and " << b << ". ";
    if (report.landmark_error > 0.0) {
      text << "If the two shapes do not differ that much, a landmark is wrong, probably landmark "
           << report.farthest_landmark + 1;
    } else {
      text << "Add landmarks";
    }
  } else if (static_cast<double>(report.flipped_triangles) >
             kMostFlipped * static_cast<double>(triangle_count)) {
    text << report.flipped_triangles << " of " << triangle_count
         << " triangles are flipped. Add landmarks where the result is folded";
  }
  return text.str();
}

}  // namespace lapwing
