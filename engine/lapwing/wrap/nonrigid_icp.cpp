#include "lapwing/wrap/nonrigid_icp.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/elastic/coarse_surfaces.h"
#include "lapwing/laplacian/ring_fit.h"

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

// A pair pulls with a quarter of its weight at the distance `far_distance`, and at least at this
// multiple of the reach. With smaller multiples, a thin limb does not swell to a thick limb of the
// scan: once most of the template fits, its pairs would count as outliers.
constexpr double kTolerated = 2.0;

// From the first step on, the weight of landmarks is this multiple of the springs' final weight.
constexpr double kLandmarkWeight = 3.0 / (kLastReach * kLastReach);
// Factor on the weight of hard landmarks.
constexpr double kHard = 1e3;

// The limits of each minimization. They are loose, because its result is only the start of the next
// one.
constexpr SettleOptions kStep{.tolerance = 1e-2, .max_iterations = 20};

// Number of vertices of the decimated copy of a larger template.
constexpr std::size_t kCoarseVertices = 3000;

// Denser scans are sampled with this number of points per vertex of the template.
constexpr std::size_t kSamplesPerVertex = 4;

// Returns the factor on the weight of a pair (Geman and McClure 1985).
double robust_factor(double distance, double scale) {
  const double ratio = distance / scale;
  return 1.0 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
}

Target at_vertex(Index v, const Vector3d& position, double weight) {
  return {{v, v, v}, {1.0, 0.0, 0.0}, position, weight};
}

// Alternates closest points and minimizations, for a template or a decimated copy of it.
class Wrapping {
 public:
  // `start` is the pose from which the first step begins.
  Wrapping(const Topology& topology, std::shared_ptr<const Positions> rest, Positions start,
           std::span<const ScanSurface> scans, const TemplateMirror* mirror, EditRegion region,
           Kernels& kernels)
      : topology_(topology),
        rest_(std::move(rest)),
        now_(std::move(start)),
        mirror_(mirror),
        kernels_(kernels),
        prepared_(topology),
        edge_(mean_edge_length(topology.rings, *rest_)),
        region_(std::move(region)),
        landmarks_(std::exchange(region_.targets, {})),
        hard_landmarks_(std::exchange(region_.hard_targets, false)) {
    for (const ScanSurface& scan : scans) {
      pulls_.push_back({scan, scan.samples(kSamplesPerVertex * region_.roi.size()), {}, {}});
    }
    if (mirror_ != nullptr) mirror_->make_symmetric(now_);
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
  FittedTemplate result() const { return {now_, steps_}; }

  // If `detail` is true, prescribes the vertices that have a counterpart and minimizes once more.
  // Also minimizes once more without springs on rigid parts, so that these become exactly rigid.
  void finish(bool detail) {
    if (detail) prescribe_counterparts();
    const auto is_rigid = [](const VertexStiffness& part) {
      return part.factor == kRigidStiffness;
    };
    const bool has_rigid_parts = std::ranges::any_of(region_.stiffness, is_rigid);
    if (has_rigid_parts) {
      std::vector<char> rigid(now_.size(), 0);
      for (const auto& [vertex, factor] : region_.stiffness) {
        rigid[vertex] = factor == kRigidStiffness ? 1 : 0;
      }
      std::erase_if(region_.targets, [&](const Target& target) {
        return std::ranges::any_of(target.corners, [&](Index v) { return rigid[v] != 0; });
      });
    }
    if (detail || has_rigid_parts) minimize();
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
  // A scan that pulls the template.
  struct Pull {
    const ScanSurface& scan;
    SurfaceSamples samples;
    std::vector<Index> hints;
    std::vector<Index> scan_hints;
  };

  // Moves the surface once. Returns false if nothing pulls it.
  bool step(double weight) {
    const ScanSurface surface(topology_, now_);
    region_.targets.clear();
    add_landmarks();
    // The energy of a spring is proportional to the square of its weight.
    const double of_scan = weight / std::sqrt(static_cast<double>(pulls_.size()));
    for (Pull& pull : pulls_) {
      const SurfaceSamples& samples = pull.samples;
      add_pull_of(counterparts_of(now_, surface.normals(), pull.scan, pull.hints), of_scan);
      add_pull_from(counterparts_of(samples.points, samples.normals, surface, pull.scan_hints),
                    samples.points, of_scan);
    }
    if (region_.targets.empty()) return false;
    minimize();
    return true;
  }

  // Replaces the springs by prescribed positions on the scan.
  void prescribe_counterparts() {
    const ScanSurface surface(topology_, now_);
    Pull& pull = pulls_.front();
    const std::vector<Counterpart> on_scan =
        counterparts_of(now_, surface.normals(), pull.scan, pull.hints);
    const std::vector<SurfacePoint> points = accepted(on_scan, edge_);
    region_.targets = hard_landmarks_ ? landmarks_ : std::vector<Target>();
    region_.hard_targets = true;
    const std::vector<char> prescribed = vertex_mask(now_.size(), corners_of(region_.targets));
    for (Index v = 0; v < on_scan.size(); ++v) {
      if (!points[v].is_nowhere() && prescribed[v] == 0) {
        region_.targets.push_back(at_vertex(v, on_scan[v].position, 1.0));
      }
    }
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
    if (mirror_ != nullptr) mirror_->make_symmetric(result.positions);
    double sum = 0.0;
    for (std::size_t v = 0; v < now_.size(); ++v) sum += (result.positions[v] - now_[v]).norm();
    moved_ = sum / static_cast<double>(now_.size());
    now_ = std::move(result.positions);
  }

  void add_landmarks() {
    for (const Target& landmark : landmarks_) {
      region_.targets.push_back(landmark);
      region_.targets.back().weight *= hard_landmarks_ ? kHard * kLandmarkWeight : kLandmarkWeight;
    }
  }

  // Adds springs from the template's vertices to the scan.
  void add_pull_of(std::span<const Counterpart> on_scan, double weight) {
    const double scale = std::max(far_distance(on_scan), tolerated_);
    for (Index v = 0; v < on_scan.size(); ++v) {
      if (!on_scan[v].agrees || is_landmark_[v] != 0) continue;
      const double factor = robust_factor(on_scan[v].distance, scale);
      const double of_pair = weight * std::sqrt(factor);
      if (of_pair >= kMinWeight) {
        region_.targets.push_back(at_vertex(v, on_scan[v].position, of_pair));
      }
    }
  }

  // Adds springs from the samples of the scan to points of the template. The total weight of all
  // samples is at most that of the template's vertices.
  void add_pull_from(std::span<const Counterpart> on_surface, std::span<const Vector3d> samples,
                     double weight) {
    const double scale = std::max(far_distance(on_surface), tolerated_);
    const double share = std::min(
        1.0, static_cast<double>(region_.roi.size()) / static_cast<double>(on_surface.size()));
    for (std::size_t s = 0; s < on_surface.size(); ++s) {
      const Counterpart& c = on_surface[s];
      if (!c.agrees) continue;
      const double of_pair = weight * std::sqrt(share * robust_factor(c.distance, scale));
      if (of_pair < kMinWeight) continue;
      region_.targets.push_back({c.point.corners, c.point.weights, samples[s], of_pair});
    }
  }

  const Topology& topology_;
  const std::shared_ptr<const Positions> rest_;
  Positions now_;
  const TemplateMirror* mirror_;
  Kernels& kernels_;
  PreparedRegion prepared_;
  const double edge_;
  EditRegion region_;
  const std::vector<Target> landmarks_;
  const bool hard_landmarks_;
  DeformOptions options_;
  std::vector<Pull> pulls_;
  std::vector<char> is_landmark_;
  double moved_ = 0.0;
  double tolerated_ = 0.0;
  int steps_ = 0;
};

// Follows the reaches in [begin, end) of `reaches` and reports each.
void follow(Wrapping& wrapping, std::span<const double> reaches, std::size_t begin, std::size_t end,
            const Progress& progress) {
  for (std::size_t k = begin; k < end; ++k) {
    report_progress(progress, "wrap", static_cast<double>(k) / static_cast<double>(reaches.size()));
    wrapping.follow(reaches[k]);
  }
}

struct CoarseSteps {
  int steps = 0;
  std::size_t reaches = 0;  // number of the reaches that were followed
};

// Wraps a decimated copy of a large template at all reaches that its edges can follow. The
// deformations at such reaches have long wavelengths and do not need more vertices. Sets
// `task.start` from the decimated copy.
CoarseSteps wrap_coarse(FittingTask& task, const std::shared_ptr<const Positions>& rest,
                        Kernels& kernels, std::span<const double> reaches,
                        const Progress& progress) {
  CoarseSurfaces surfaces;
  const auto level = surfaces.of(task.region, task.topology, rest, kCoarseVertices);
  if (level == nullptr) return {};
  const CoarseSurface& coarse = level->surface;
  Positions start;
  for (const Index v : coarse.kept) start.push_back(task.start[v]);
  const auto own_rest = std::make_shared<const Positions>(coarse.rest);
  EditRegion own_region = coarse_region_of(task.region, inverse_index(coarse.kept, rest->size()));
  // The vertices of the decimated copy do not form pairs.
  Wrapping wrapping(coarse.topology, own_rest, std::move(start), task.scans, nullptr,
                    std::move(own_region), kernels);
  std::size_t followed = 0;
  while (reaches[followed] > wrapping.edge()) ++followed;
  follow(wrapping, reaches, 0, followed, progress);
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
  level->embedding.prolongate(level->embedding.motions(at_rest, reached), displacement);
  for (std::size_t v = 0; v < rest->size(); ++v) task.start[v] = (*rest)[v] + displacement[v];
  return {wrapping.steps(), followed};
}

}  // namespace

std::vector<double> reaches_of(const Positions& rest, double edge) {
  const double first = kFirstReach * bounds_of(rest).diagonal();
  std::vector<double> reaches;
  for (int k = 0; k < kReaches; ++k) {
    const double fraction = static_cast<double>(k) / (kReaches - 1);
    reaches.push_back(first * std::pow(kLastReach * edge / first, fraction));
  }
  return reaches;
}

FittedTemplate nonrigid_icp(FittingTask task, Kernels& kernels, const Progress& progress) {
  const Topology& topology = task.topology;
  const auto rest = std::make_shared<const Positions>(std::move(task.rest));
  const std::vector<double> reaches = reaches_of(*rest, mean_edge_length(topology.rings, *rest));
  report_progress(progress, "wrap", 0.0);
  const CoarseSteps coarse = wrap_coarse(task, rest, kernels, reaches, progress);
  Wrapping wrapping(topology, rest, std::move(task.start), task.scans, task.mirror,
                    std::move(task.region), kernels);
  follow(wrapping, reaches, coarse.reaches, reaches.size(), progress);
  wrapping.finish(task.detail);
  FittedTemplate fitted = wrapping.result();
  fitted.steps += coarse.steps;
  return fitted;
}

}  // namespace lapwing
