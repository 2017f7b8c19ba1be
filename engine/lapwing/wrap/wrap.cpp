#include "lapwing/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/region/edit_region.h"

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

constexpr std::size_t kPointsPerTask = 512;

VertexSet surface_vertices(const Topology& topology) {
  VertexSet vertices;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (topology.rings.size(v) > 0) vertices.push_back(v);
  }
  return vertices;
}

std::vector<Counterpart> counterparts_of(const ScanSurface& surface, const ScanSurface& other,
                                         std::vector<Index>& hints) {
  const std::size_t count = surface.positions().size();
  hints.resize(count, kNoIndex);
  std::vector<Counterpart> counterparts(count);
  parallel_for(count, kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (surface.topology().rings.size(v) == 0) continue;
      counterparts[v] = other.counterpart(surface.positions()[v], surface.normals()[v], hints[v]);
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

SurfaceDistance measure(std::span<const Counterpart> counterparts, const ScanSurface& surface) {
  std::vector<double> distances;
  for (std::size_t v = 0; v < counterparts.size(); ++v) {
    if (surface.topology().rings.size(v) > 0) distances.push_back(counterparts[v].distance);
  }
  std::ranges::sort(distances);
  const auto count = static_cast<double>(distances.size());
  return {std::accumulate(distances.begin(), distances.end(), 0.0) / count,
          distances[static_cast<std::size_t>(0.95 * (count - 1.0))], distances.back()};
}

// Returns the counterparts that agree and are not much farther than most.
std::vector<SurfacePoint> accepted(std::span<const Counterpart> counterparts, double edge) {
  const double far = std::max(edge, kFar * median_distance(counterparts));
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

// The loop of closest points and minimizations.
class Wrapping {
 public:
  // `start` is the pose from which the first step begins.
  Wrapping(const Topology& topology, Positions rest, Positions start, const ScanSurface& scan,
           std::vector<Target> landmarks, Kernels& kernels)
      : topology_(topology),
        rest_(std::move(rest)),
        now_(std::move(start)),
        scan_(scan),
        landmarks_(std::move(landmarks)),
        kernels_(kernels),
        prepared_(topology),
        edge_(mean_edge_length(topology.rings, rest_)) {
    region_.roi = surface_vertices(topology);
    is_landmark_.resize(topology.vertex_count(), 0);
    for (const Target& landmark : landmarks_) {
      if (landmark.is_vertex()) is_landmark_[landmark.corners[0]] = 1;
    }
    pose_.displacement.resize(rest_.size());
    for (std::size_t v = 0; v < rest_.size(); ++v) pose_.displacement[v] = now_[v] - rest_[v];
    options_.constraint_weight = 1.0;
    options_.settle = kStep;
  }

  const Positions& positions() const { return now_; }
  double edge() const { return edge_; }
  int steps() const { return steps_; }
  std::size_t flipped_triangles() const { return flipped_; }

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
    const std::vector<Counterpart> on_scan = counterparts_of(surface, scan_, hints_);
    const std::vector<Counterpart> on_surface = counterparts_of(scan_, surface, scan_hints_);
    region_.targets.clear();
    add_landmarks();
    add_pull_of(on_scan, weight);
    add_pull_from(on_surface, weight);
    if (region_.targets.empty()) return false;
    EditRegion region = region_;
    separate_loose_parts(region, rest_, topology_, LoosePolicy::carry, "template");
    const DeformSolver solver(prepared_, rest_, std::move(region), options_, kernels_);
    DeformResult result = solver.solve_from(pose_, {});
    ++steps_;
    flipped_ = result.certificate.flipped_triangles;
    double sum = 0.0;
    for (std::size_t v = 0; v < rest_.size(); ++v) {
      sum += (result.positions[v] - now_[v]).norm();
      pose_.displacement[v] = result.positions[v] - rest_[v];
    }
    moved_ = sum / static_cast<double>(rest_.size());
    now_ = std::move(result.positions);
    return true;
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

  // Springs from the scan's vertices to points of the template. All vertices of the scan together
  // pull as much as those of the template, however dense the scan is.
  void add_pull_from(std::span<const Counterpart> on_surface, double weight) {
    const double scale = std::max(kFar * median_distance(on_surface), tolerated_);
    const double share = std::min(
        1.0, static_cast<double>(region_.roi.size()) / static_cast<double>(on_surface.size()));
    for (std::size_t s = 0; s < on_surface.size(); ++s) {
      const Counterpart& c = on_surface[s];
      if (!c.agrees) continue;
      const double of_pair = weight * std::sqrt(share * robust_factor(c.distance, scale));
      if (of_pair < kMinWeight) continue;
      region_.targets.push_back({c.point.corners, c.point.weights, scan_.positions()[s], of_pair});
    }
  }

  const Topology& topology_;
  const Positions rest_;
  Positions now_;
  const ScanSurface& scan_;
  const std::vector<Target> landmarks_;
  Kernels& kernels_;
  PreparedRegion prepared_;
  const double edge_;
  EditRegion region_;
  DeformOptions options_;
  DragState pose_;
  std::vector<char> is_landmark_;
  std::vector<Index> hints_;
  std::vector<Index> scan_hints_;
  double moved_ = 0.0;
  double tolerated_ = 0.0;
  std::size_t flipped_ = 0;
  int steps_ = 0;
};

}  // namespace

Wrapped wrap(const Mesh& wrapped, const Mesh& scan, const WrapRequest& request, Kernels& kernels,
             const Progress& progress) {
  const ProgressScope scope(progress);
  require_surface(wrapped, "template");
  require_surface(scan, "scan");
  const Topology& topology = wrapped.topology();
  const std::vector<Target> landmarks =
      resolve_targets(request.landmarks, surface_vertices(topology), {}, wrapped);
  const ScanSurface of_scan(scan.topology(), scan.positions);
  Wrapped result;
  WrapReport& report = result.report;
  report_progress(progress, "align", 0.0);
  report.alignment =
      align(ScanSurface(topology, wrapped.positions), of_scan, landmarks, request.aligned);
  Positions rest = mapped(report.alignment.map, wrapped.positions);
  const double first = kFirstReach * bounds_of(rest).diagonal();
  Wrapping wrapping(topology, std::move(rest), mapped(report.alignment.start, wrapped.positions),
                    of_scan, landmarks, kernels);
  for (int k = 0; k < kReaches; ++k) {
    const double fraction = static_cast<double>(k) / (kReaches - 1);
    report_progress(progress, "wrap", fraction);
    wrapping.follow(first * std::pow(kLastReach * wrapping.edge() / first, fraction));
  }
  result.positions = wrapping.positions();
  const ScanSurface surface(topology, result.positions);
  std::vector<Index> hints;
  std::vector<Index> scan_hints;
  const std::vector<Counterpart> on_scan = counterparts_of(surface, of_scan, hints);
  const std::vector<Counterpart> on_surface = counterparts_of(of_scan, surface, scan_hints);
  report.to_scan = measure(on_scan, surface);
  report.to_template = measure(on_surface, of_scan);
  report.flipped_triangles = wrapping.flipped_triangles();
  report.steps = wrapping.steps();
  double area = 0.0;
  double covered = 0.0;
  result.counterparts = accepted(on_scan, wrapping.edge());
  for (Index v = 0; v < on_scan.size(); ++v) {
    area += surface.areas()[v];
    if (!result.counterparts[v].is_nowhere()) covered += surface.areas()[v];
  }
  report.coverage = covered / area;
  for (const Target& landmark : landmarks) {
    report.landmark_error = std::max(
        report.landmark_error, (point_of(landmark, result.positions) - landmark.position).norm());
  }
  return result;
}

std::vector<SurfacePoint> counterparts_on(const Mesh& scan, const Topology& topology,
                                          std::span<const Vector3d> positions) {
  require_surface(scan, "scan");
  std::vector<Index> hints;
  const std::vector<Counterpart> on_scan = counterparts_of(
      ScanSurface(topology, positions), ScanSurface(scan.topology(), scan.positions), hints);
  return accepted(on_scan, mean_edge_length(topology.rings, positions));
}

std::string why_failed(const WrapReport& report, std::size_t triangle_count) {
  constexpr double kLeastCoverage = 0.5;
  constexpr double kMostFlipped = 1e-3;
  std::ostringstream text;
  if (report.coverage < kLeastCoverage) {
    text << "Only " << std::lround(100.0 * report.coverage)
         << "% of the template has a counterpart on the scan. Add landmarks, or check that the "
            "faces of both meshes are oriented outward";
  } else if (static_cast<double>(report.flipped_triangles) >
             kMostFlipped * static_cast<double>(triangle_count)) {
    text << report.flipped_triangles << " of " << triangle_count
         << " triangles are flipped. Add landmarks where the result is folded";
  }
  return text.str();
}

}  // namespace lapwing
