#include "lapwing/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/region/joined_regions.h"
#include "lapwing/wrap/nonrigid_icp.h"
#include "lapwing/wrap/scan_surface.h"
#include "lapwing/wrap/surfels.h"
#include "lapwing/wrap/template_mirror.h"

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

// Returns the fitted template with its report, without the alignment. `rest` contains the aligned
// template.
Wrapped measured(const Topology& topology, std::span<const Vector3d> rest, FittedTemplate fitted,
                 const ScanSurface& scan, const EditRegion& region) {
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
  Certificate certificate;
  measure_shape(region.roi, topology, rest, result.positions, certificate);
  report.flipped_triangles = certificate.flipped_triangles;
  report.edge_stretch = certificate.edge_stretch;
  report.most_stretched = {certificate.largest_edge_stretch_vertices,
                           certificate.largest_edge_stretch};
  report.steps = fitted.steps;
  return result;
}

// Adds the mirror images of the landmarks and of the scan, after the mirror has followed the
// alignment. `image` contains the mirror image of the scan.
void add_mirror_images(const TemplateMirror& mirror, const Mesh& aligned, const Mesh& scan,
                       std::size_t measured, Mesh& image, std::vector<ScanSurface>& scans,
                       EditRegion& region) {
  image = scan;
  transform(image, reflection(mirror.plane()));
  scans.emplace_back(image.topology(), image.positions, measured);
  const std::vector<Target> images = mirror.images_of(region.targets, region.roi, aligned);
  region.targets.insert(region.targets.end(), images.begin(), images.end());
}

// Wraps a template without seams onto a surface or onto surfels. The first `measured_vertices`
// vertices of the scan are samples.
Wrapped wrap_joined(const Mesh& wrapped, const Mesh& scan, std::size_t measured_vertices,
                    const WrapRequest& request, Kernels& kernels, const Progress& progress) {
  const Topology& topology = wrapped.topology();
  EditRegion region;
  region.roi = surface_vertices(topology);
  region.targets = resolve_targets(request.landmarks, region.roi, {}, wrapped);
  region.hard_targets = request.landmarks.hard;
  region.stiffness = resolve_stiffness(request.stiffness, region.roi, wrapped);
  std::optional<TemplateMirror> mirror;
  if (request.mirror) mirror.emplace(wrapped, *request.mirror);
  std::vector<ScanSurface> scans;
  scans.emplace_back(scan.topology(), scan.positions, measured_vertices);
  report_progress(progress, "align", 0.0);
  Alignment alignment =
      align(ScanSurface(topology, wrapped.positions), scans[0], region.targets, request.aligned);
  Mesh aligned = wrapped;
  aligned.positions = mapped(alignment.map, wrapped.positions);
  FittingTask task{.topology = topology,
                   .rest = aligned.positions,
                   .start = mapped(alignment.start, wrapped.positions),
                   .region = region,
                   .detail = request.detail};
  Mesh image;
  if (mirror) {
    mirror->transform(alignment.map);
    add_mirror_images(*mirror, aligned, scan, measured_vertices, image, scans, task.region);
    task.mirror = &*mirror;
  }
  task.scans = scans;
  Wrapped result = measured(topology, aligned.positions,
                            nonrigid_icp(std::move(task), kernels, progress), scans[0], region);
  result.report.alignment = std::move(alignment);
  return result;
}

}  // namespace

Wrapped wrap(const Mesh& wrapped, const Mesh& scan, const WrapRequest& request, Kernels& kernels,
             const Progress& progress) {
  const ProgressScope scope(progress);
  require_surface(wrapped, "template");
  const bool is_cloud = scan.face_count() == 0 && scan.vertex_count() > 0;
  if (!is_cloud) require_surface(scan, "scan");
  const JoinedSurface scan_seams = is_cloud ? JoinedSurface() : joined_surface(scan);
  const Mesh surfels = is_cloud ? surfels_of(scan, "scan") : Mesh();
  const Mesh& searched = is_cloud ? surfels : scan_seams.empty() ? scan : scan_seams.surface;
  const JoinedSurface seams = joined_surface(wrapped);
  WrapRequest on_leaders = request;
  if (!seams.empty()) {
    on_leaders.landmarks = led(request.landmarks, seams);
    for (StiffnessSpec& spec : on_leaders.stiffness) spec = led(std::move(spec), seams);
  }
  Wrapped result = wrap_joined(seams.empty() ? wrapped : seams.surface, searched,
                               scan.vertex_count(), on_leaders, kernels, progress);
  seams.close(result.positions);
  for (const Index v : seams.followers) {
    result.counterparts[v] = result.counterparts[seams.leaders[v]];
    result.distances[v] = result.distances[seams.leaders[v]];
  }
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
