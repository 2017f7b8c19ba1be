#include "lapwing/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/elastic/coarse_surfaces.h"
#include "lapwing/laplacian/ring_fit.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/wrap/surfels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The reach of the springs is the wavelength below which a deformation resists them: a vertex whose
// ring has edges of length h is held with the weight (h / reach)^2. It decreases from this fraction
// of the template's diagonal to this fraction of the mean edge length.
constexpr double kFirstReach = 0.5;
constexpr double kLastReach = 0.5;
constexpr int kReaches = 12;
constexpr int kStepsPerReach = 4;

// The steps at one reach end when the vertices move less than this fraction of an edge on average.
constexpr double kStill = 0.005;

// The distance at which a pair pulls with a quarter of its weight: this multiple of the median
// distance, and at least this fraction of the reach, so that a limb that does not fit yet is still
// pulled.
constexpr double kFar = 3.0;
constexpr double kTolerated = 0.5;

// From the first step on, the weight of landmarks is this multiple of the springs' final weight.
constexpr double kLandmarkWeight = 3.0 / (kLastReach * kLastReach);

// The limits of each minimization. They are loose, because its result is only the start of the next
// one.
constexpr SettleOptions kStep{.tolerance = 1e-2, .max_iterations = 20};

// Number of vertices of the decimated copy of a larger template.
constexpr std::size_t kCoarseVertices = 3000;

// Denser scans are sampled with this number of points per vertex of the template.
constexpr std::size_t kSamplesPerVertex = 4;

// The distance from the scan to the result is measured at this many points or more.
constexpr std::size_t kMeasured = 10000;

constexpr std::size_t kPointsPerTask = 512;

VertexSet surface_vertices(const Topology& topology) {
  VertexSet vertices;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (topology.rings.size(v) > 0) vertices.push_back(v);
  }
  return vertices;
}

// Returns the counterpart of each point on `surface`.
std::vector<Counterpart> counterparts_of(std::span<const Vector3d> points,
                                         std::span<const Vector3d> normals,
                                         const ScanSurface& surface, std::vector<Index>& hints) {
  hints.resize(points.size(), kNoIndex);
  std::vector<Counterpart> counterparts(points.size());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      counterparts[k] = surface.counterpart(points[k], normals[k], hints[k]);
    }
  });
  return counterparts;
}

// Returns the median distance of the pairs that agree; 0 if there is none.
double median_distance(std::span<const Counterpart> counterparts) {
  std::vector<double> distances;
  for (const Counterpart& c : counterparts) {
    if (c.agrees) distances.push_back(c.distance);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return *middle;
}

// Returns the factor on the weight of a pair (Geman and McClure 1985).
double robust_factor(double distance, double scale) {
  const double ratio = distance / scale;
  return 1.0 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
}

Target at_vertex(Index v, const Vector3d& position, double weight) {
  return {{v, v, v}, {1.0, 0.0, 0.0}, position, weight};
}

SurfaceDistance measure(std::vector<double> distances) {
  std::ranges::sort(distances);
  const auto count = static_cast<double>(distances.size());
  return {std::accumulate(distances.begin(), distances.end(), 0.0) / count,
          distances[static_cast<std::size_t>(0.95 * (count - 1.0))], distances.back()};
}

// Returns the counterparts whose normals agree and that are not much farther away than most.
std::vector<SurfacePoint> accepted(std::span<const Counterpart> counterparts, double edge) {
  const double far = std::max(edge, kFar * median_distance(counterparts));
  std::vector<SurfacePoint> points;
  for (const Counterpart& c : counterparts) {
    points.push_back(c.agrees && c.distance <= far ? c.point : SurfacePoint::nowhere());
  }
  return points;
}

// Returns the cloud point to which a point on a surfel belongs.
SurfacePoint point_of_surfel(const SurfacePoint& place) {
  return place.is_nowhere() ? place : SurfacePoint::at_vertex(std::ranges::min(place.corners));
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

// Alternates closest points and minimizations, for a template or a decimated copy of it.
class Wrapping {
 public:
  // `start` is the pose from which the first step begins.
  Wrapping(const Topology& topology, std::shared_ptr<const Positions> rest, Positions start,
           const ScanSurface& scan, std::vector<Target> landmarks,
           std::vector<VertexStiffness> stiffness, Kernels& kernels)
      : topology_(topology),
        rest_(std::move(rest)),
        now_(std::move(start)),
        scan_(scan),
        landmarks_(std::move(landmarks)),
        kernels_(kernels),
        prepared_(topology),
        edge_(mean_edge_length(topology.rings, *rest_)) {
    region_.roi = surface_vertices(topology);
    region_.stiffness = std::move(stiffness);
    samples_ = scan.samples(kSamplesPerVertex * region_.roi.size());
    is_landmark_.resize(topology.vertex_count(), 0);
    for (const Target& landmark : landmarks_) {
      if (landmark.is_vertex()) is_landmark_[landmark.corners[0]] = 1;
    }
    options_.constraint_weight = 1.0;
    options_.settle = kStep;
  }

  const Positions& positions() const { return now_; }
  double edge() const { return edge_; }
  int steps() const { return steps_; }
  const Certificate& certificate() const { return certificate_; }

  // Makes the rigid parts of the template exactly rigid: minimizes again without springs on their
  // vertices.
  void finish() {
    const auto is_rigid = [](const VertexStiffness& part) {
      return part.factor == kRigidStiffness;
    };
    if (std::ranges::none_of(region_.stiffness, is_rigid)) return;
    std::vector<char> rigid(now_.size(), 0);
    for (const auto& [vertex, factor] : region_.stiffness) {
      rigid[vertex] = factor == kRigidStiffness ? 1 : 0;
    }
    std::erase_if(region_.targets, [&](const Target& target) {
      return std::ranges::any_of(target.corners, [&](Index v) { return rigid[v] != 0; });
    });
    minimize();
  }

  // Deforms the template until it follows springs of this reach.
  void follow(double reach) {
    tolerated_ = kTolerated * reach;
    const double weight = std::max(std::pow(edge_ / reach, 2.0), kMinWeight);
    for (int k = 0; k < kStepsPerReach; ++k) {
      check_cancelled();
      if (!step(weight) || moved_ < kStill * edge_) return;
    }
  }

 private:
  // Moves the surface once. Returns false if nothing pulls it.
  bool step(double weight) {
    const ScanSurface surface(topology_, now_);
    const std::vector<Counterpart> on_scan =
        counterparts_of(now_, surface.normals(), scan_, hints_);
    const std::vector<Counterpart> on_surface =
        counterparts_of(samples_.points, samples_.normals, surface, scan_hints_);
    region_.targets.clear();
    add_landmarks();
    add_pull_of(on_scan, weight);
    add_pull_from(on_surface, weight);
    if (region_.targets.empty()) return false;
    minimize();
    return true;
  }

  void minimize() {
    EditRegion region = region_;
    separate_loose_parts(region, *rest_, topology_, LoosePolicy::carry, "template");
    const DeformSolver solver(prepared_, *rest_, std::move(region), options_, kernels_);
    DragState pose;
    for (std::size_t v = 0; v < now_.size(); ++v) {
      pose.displacement.push_back(now_[v] - (*rest_)[v]);
    }
    DeformResult result = solver.solve_from(pose, {});
    ++steps_;
    certificate_ = std::move(result.certificate);
    double sum = 0.0;
    for (std::size_t v = 0; v < now_.size(); ++v) sum += (result.positions[v] - now_[v]).norm();
    moved_ = sum / static_cast<double>(now_.size());
    now_ = std::move(result.positions);
  }

  void add_landmarks() {
    for (const Target& landmark : landmarks_) {
      region_.targets.push_back(landmark);
      region_.targets.back().weight *= kLandmarkWeight;
    }
  }

  // Springs from the template's vertices to the scan.
  void add_pull_of(std::span<const Counterpart> on_scan, double weight) {
    const double scale = std::max(kFar * median_distance(on_scan), tolerated_);
    for (Index v = 0; v < on_scan.size(); ++v) {
      if (!on_scan[v].agrees || is_landmark_[v] != 0) continue;
      const double factor = robust_factor(on_scan[v].distance, scale);
      const double of_pair = weight * std::sqrt(factor);
      if (of_pair >= kMinWeight) {
        region_.targets.push_back(at_vertex(v, on_scan[v].position, of_pair));
      }
    }
  }

  // Springs from the samples of the scan to points of the template. All samples together pull at
  // most as much as the vertices of the template.
  void add_pull_from(std::span<const Counterpart> on_surface, double weight) {
    const double scale = std::max(kFar * median_distance(on_surface), tolerated_);
    const double share = std::min(
        1.0, static_cast<double>(region_.roi.size()) / static_cast<double>(on_surface.size()));
    for (std::size_t s = 0; s < on_surface.size(); ++s) {
      const Counterpart& c = on_surface[s];
      if (!c.agrees) continue;
      const double of_pair = weight * std::sqrt(share * robust_factor(c.distance, scale));
      if (of_pair < kMinWeight) continue;
      region_.targets.push_back({c.point.corners, c.point.weights, samples_.points[s], of_pair});
    }
  }

  const Topology& topology_;
  const std::shared_ptr<const Positions> rest_;
  Positions now_;
  const ScanSurface& scan_;
  const std::vector<Target> landmarks_;
  Kernels& kernels_;
  PreparedRegion prepared_;
  const double edge_;
  EditRegion region_;
  DeformOptions options_;
  SurfaceSamples samples_;  // of the scan
  std::vector<char> is_landmark_;
  std::vector<Index> hints_;
  std::vector<Index> scan_hints_;
  double moved_ = 0.0;
  double tolerated_ = 0.0;
  Certificate certificate_;  // of the last step
  int steps_ = 0;
};

// The reaches of the springs, descending.
std::vector<double> reaches_of(const Positions& rest, double edge) {
  const double first = kFirstReach * bounds_of(rest).diagonal();
  std::vector<double> reaches;
  for (int k = 0; k < kReaches; ++k) {
    const double fraction = static_cast<double>(k) / (kReaches - 1);
    reaches.push_back(first * std::pow(kLastReach * edge / first, fraction));
  }
  return reaches;
}

// Returns the landmarks on the coarse surface. Decimation keeps their corners.
std::vector<Target> on_coarse(std::vector<Target> landmarks, std::span<const Index> coarse_of) {
  for (Target& landmark : landmarks) {
    for (Index& corner : landmark.corners) corner = coarse_of[corner];
  }
  return landmarks;
}

std::vector<VertexStiffness> on_coarse(std::span<const VertexStiffness> stiffness,
                                       std::span<const Index> coarse_of) {
  std::vector<VertexStiffness> kept;
  for (const auto& [vertex, factor] : stiffness) {
    if (coarse_of[vertex] != kNoIndex) kept.push_back({coarse_of[vertex], factor});
  }
  return kept;
}

// Wraps a decimated copy of a large template at all reaches that its edges can follow, and removes
// these from `reaches`. The deformations at such reaches have long wavelengths and do not need more
// vertices. Sets `pose` from the decimated copy. Returns the number of steps.
int wrap_coarse(const Topology& topology, const std::shared_ptr<const Positions>& rest,
                const ScanSurface& scan, const std::vector<Target>& landmarks,
                std::span<const VertexStiffness> stiffness, Kernels& kernels,
                std::vector<double>& reaches, Positions& pose) {
  EditRegion region;
  region.roi = surface_vertices(topology);
  region.targets = landmarks;
  CoarseSurfaces surfaces;
  const auto level = surfaces.of(region, topology, rest, kCoarseVertices);
  if (level == nullptr) return 0;
  const CoarseSurface& coarse = level->surface;
  Positions start;
  for (const Index v : coarse.kept) start.push_back(pose[v]);
  const auto own_rest = std::make_shared<const Positions>(coarse.rest);
  const std::vector<Index> coarse_of = inverse_index(coarse.kept, rest->size());
  Wrapping wrapping(coarse.topology, own_rest, std::move(start), scan,
                    on_coarse(landmarks, coarse_of), on_coarse(stiffness, coarse_of), kernels);
  auto reach = reaches.begin();
  for (; *reach > wrapping.edge(); ++reach) wrapping.follow(*reach);
  reaches.erase(reaches.begin(), reach);
  CoarseEmbedding::Pose reached;
  for (Index c = 0; c < coarse.kept.size(); ++c) {
    reached.displacement.push_back(wrapping.positions()[c] - coarse.rest[c]);
    reached.transforms.push_back(
        fit_rotation(c, coarse.topology.rings[c], coarse.rest, wrapping.positions()));
  }
  const CoarseEmbedding::Pose at_rest{
      Positions(coarse.kept.size(), Vector3d::Zero()),
      std::vector<Eigen::Matrix3d>(coarse.kept.size(), Eigen::Matrix3d::Identity())};
  Positions displacement(rest->size(), Vector3d::Zero());
  level->embedding.prolongate(at_rest, reached, displacement);
  for (std::size_t v = 0; v < pose.size(); ++v) pose[v] = (*rest)[v] + displacement[v];
  return wrapping.steps();
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
  const std::vector<Target> landmarks =
      resolve_targets(request.landmarks, surface_vertices(topology), {}, wrapped);
  const std::vector<VertexStiffness> stiffness =
      resolve_stiffness(request.stiffness, surface_vertices(topology), wrapped);
  const ScanSurface of_scan(searched.topology(), searched.positions, scan.vertex_count());
  Wrapped result;
  WrapReport& report = result.report;
  report_progress(progress, "align", 0.0);
  report.alignment =
      align(ScanSurface(topology, wrapped.positions), of_scan, landmarks, request.aligned);
  const auto rest =
      std::make_shared<const Positions>(mapped(report.alignment.map, wrapped.positions));
  Positions pose = mapped(report.alignment.start, wrapped.positions);
  std::vector<double> reaches = reaches_of(*rest, mean_edge_length(topology.rings, *rest));
  report_progress(progress, "wrap", 0.0);
  report.steps = wrap_coarse(topology, rest, of_scan, landmarks, stiffness, kernels, reaches, pose);
  Wrapping wrapping(topology, rest, std::move(pose), of_scan, landmarks, stiffness, kernels);
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    report_progress(progress, "wrap",
                    static_cast<double>(k + 1) / static_cast<double>(reaches.size() + 1));
    wrapping.follow(reaches[k]);
  }
  wrapping.finish();
  result.positions = wrapping.positions();
  const ScanSurface surface(topology, result.positions);
  std::vector<Index> hints;
  const std::vector<Counterpart> on_scan =
      counterparts_of(result.positions, surface.normals(), of_scan, hints);
  std::vector<double> distances;
  result.distances.assign(on_scan.size(), std::numeric_limits<float>::quiet_NaN());
  for (const Index v : surface_vertices(topology)) {
    distances.push_back(on_scan[v].distance);
    result.distances[v] = static_cast<float>(on_scan[v].distance);
  }
  report.to_scan = measure(std::move(distances));
  const SurfaceSamples samples = of_scan.samples(std::max(kMeasured, result.positions.size()));
  hints.clear();
  distances.clear();
  for (const Counterpart& c : counterparts_of(samples.points, samples.normals, surface, hints)) {
    distances.push_back(c.distance);
  }
  report.to_template = measure(std::move(distances));
  const Certificate& certificate = wrapping.certificate();
  report.flipped_triangles = certificate.flipped_triangles;
  report.edge_stretch = certificate.edge_stretch;
  report.most_stretched = {certificate.largest_edge_stretch_vertices,
                           certificate.largest_edge_stretch};
  report.steps += wrapping.steps();
  double area = 0.0;
  double covered = 0.0;
  result.counterparts = accepted(on_scan, wrapping.edge());
  for (Index v = 0; v < on_scan.size(); ++v) {
    area += surface.areas()[v];
    if (!result.counterparts[v].is_nowhere()) covered += surface.areas()[v];
  }
  if (is_cloud) {
    for (SurfacePoint& point : result.counterparts) point = point_of_surfel(point);
  }
  report.coverage = covered / area;
  for (std::size_t k = 0; k < landmarks.size(); ++k) {
    const double error = (point_of(landmarks[k], result.positions) - landmarks[k].position).norm();
    if (error <= report.landmark_error) continue;
    report.landmark_error = error;
    report.farthest_landmark = k;
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
      text << "A landmark contradicts the others, probably landmark "
           << report.farthest_landmark + 1 << ". Correct or remove it";
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
