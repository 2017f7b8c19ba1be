#include "lapwing/transplant/reconstruct_seam.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/transplant/collar.h"
#include "lapwing/transplant/seam_zone.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kPasses = 3;

// Upper bound of the ratio between the sizes of a ring and of its image; the scale is clamped to it
// and to its inverse.
constexpr double kLargestRatio = 4.0;

// Returns the smooth positions from which areas and angles are computed.
Positions geometry_of(std::span<const Vector3d> positions, const Topology& topology,
                      const VertexSet& region, const TransplantOptions& options) {
  return Fairing(positions, topology, region, options.weights).smooth(shape_size(options));
}

// The low-frequency surface of a mesh.
struct SmoothSurface {
  Positions positions;
  std::vector<Vector3d> normals;
};

class SeamReconstruction {
 public:
  SeamReconstruction(const TransplantHost& host, const TransplantJoined& joined,
                     const TransplantOptions& options, Kernels& kernels, const std::string& where,
                     StageTimings& timings, const Progress& progress)
      : host_(host),
        joined_(joined),
        options_(options),
        kernels_(kernels),
        where_(where),
        timings_(timings),
        progress_(progress) {}

  TransplantResult run();

 private:
  bool is_host(Index v) const { return joined_.host_vertices[v] != kNoIndex; }

  template <class Body>
  void timed(const char* name, Body body) {
    report_progress(progress_, name, 0.0);
    const Stopwatch watch;
    body();
    timings_.add(name, watch.elapsed_ms());
  }
  void lay_collars();
  void make_system();
  void smooth_geometry();
  void sample();
  SmoothSurface smoothed(const Fairing& fairing, std::span<const Eigen::Vector3d> positions,
                         const Topology& topology) const;

  std::vector<Vector3d> laplacians_of(std::span<const Vector3d> positions) const;
  std::vector<Matrix3d> frames(std::span<const SurfacePoint> points, const SmoothSurface& source,
                               const SmoothSurface& target) const;
  double agreement(std::span<const Eigen::Vector3d> between_on_host,
                   std::span<const Eigen::Vector3d> between) const;
  std::vector<Vector3d> host_detail() const;
  double ring_size(std::size_t r, const Matrix3d& T) const;
  std::vector<Vector3d> wanted(const SmoothSurface& now) const;
  void solve(std::span<const Vector3d> wanted);

  const RegionRings& rings() const { return system_->rings(); }

  const TransplantHost& host_;
  const TransplantJoined& joined_;
  const TransplantOptions& options_;
  Kernels& kernels_;
  const std::string& where_;
  StageTimings& timings_;
  const Progress& progress_;

  SeamZone zone_;
  std::vector<double> cut_distances_;  // per host vertex: distance from the rim inside the cut
  std::vector<SurfacePoint> points_;   // per vertex of the joined mesh: its point on the host
  Positions host_geometry_;
  std::optional<Fairing> host_fairing_;
  std::optional<Fairing> fairing_;
  Constraints constraints_;
  std::unique_ptr<SystemPattern> pattern_;
  std::unique_ptr<LaplacianSystem> system_;
  std::vector<SurfacePoint> on_host_;    // per vertex of the rings
  std::vector<SurfacePoint> on_itself_;  // per vertex of the rings, on the joined mesh
  std::vector<double> shares_;           // w, per row
  std::vector<Vector3d> rest_;           // delta_D, per row; delta_S on the part
  std::vector<Vector3d> sampled_;        // delta_U, per row
  SmoothSurface smooth_host_;
  SmoothSurface smooth_start_;
  TransplantResult result_;
};

// Maps D to the host: host vertices to themselves, vertices of the transition to the removed
// region.
void SeamReconstruction::lay_collars() {
  const auto [below, above] =
      seam_collars(host_, joined_, zone_.seam, cut_distances_, options_.transition.width, where_);
  points_.assign(joined_.positions.size(), SurfacePoint::nowhere());
  // Both cuts must start at the same vertex.
  std::vector<char> starts(host_.positions.size(), 0);
  for (const Index v : cut_starts(above)) starts[joined_.host_vertices[v]] = 1;
  const Index start = below.triangles.empty() || above.triangles.empty()
                          ? kNoIndex
                          : best_cut(below, host_geometry_, starts);
  result_.sampled_host = start != kNoIndex;
  if (result_.sampled_host) {
    const auto at = std::find(host_.hole.begin(), host_.hole.end(), start) - host_.hole.begin();
    const MappedCollar lower = map_collar(below, host_geometry_, start, where_);
    const MappedCollar upper =
        map_collar(above, joined_.geometry, zone_.seam[static_cast<std::size_t>(at)], where_);
    points_ = lay_on(upper, lower, joined_.positions.size());
    result_.flipped = flipped_triangles(lower.patch.triangles, lower.map.points).size() +
                      flipped_triangles(upper.patch.triangles, upper.map.points).size();
  }
  for (Index v = 0; v < points_.size(); ++v) {
    if (is_host(v)) points_[v] = SurfacePoint::at_vertex(joined_.host_vertices[v]);
  }
}

void SeamReconstruction::make_system() {
  constraints_ = constraints_of(zone_.region, joined_.topology, 1.0, false);
  pattern_ =
      std::make_unique<SystemPattern>(joined_.topology, zone_.region.roi, constraints_.unknowns);
  pattern_->order();
  system_ = std::make_unique<LaplacianSystem>(joined_.geometry, joined_.topology, zone_.region.roi,
                                              constraints_, *pattern_,
                                              EnergyTerms{options_.weights, 0.0}, timings_);
  for (const Index v : rings().vertices) {
    on_host_.push_back(points_[v]);
    on_itself_.push_back(SurfacePoint::at_vertex(v));
  }
  for (std::size_t r = 0; r < rings().row_count(); ++r) {
    const Index v = rings().vertices[r];
    const bool before = is_host(v) || zone_.distances[v] <= 0.0;
    shares_.push_back(before ? 0.0 : fade(options_.transition, zone_.distances[v]));
  }
  rest_ = laplacians_of(joined_.positions);
}

// Returns the shape, without features smaller than shape_size.
SmoothSurface SeamReconstruction::smoothed(const Fairing& fairing,
                                           std::span<const Vector3d> positions,
                                           const Topology& topology) const {
  SmoothSurface result;
  result.positions = fairing.smooth(positions, shape_size(options_));
  result.normals.assign(positions.size(), Vector3d::Zero());
  vertex_normals(result.positions, topology.triangles, topology.vertex_triangles,
                 with_ring_neighbours(fairing.free(), topology.rings), result.normals);
  return result;
}

// Returns the correlation, from 0 to 1, of host and joined mesh for features between detail and
// shape. It is 1 if the part equals the removed region, and small if a horn replaces an ear.
double SeamReconstruction::agreement(std::span<const Vector3d> between_on_host,
                                     std::span<const Vector3d> between) const {
  double common = 0.0;
  double on_host = 0.0;
  double on_joined = 0.0;
  for (std::size_t r = 0; r < rings().row_count(); ++r) {
    if (on_host_[r].is_nowhere()) continue;
    const Vector3d a = on_host_[r].of<Vector3d>(between_on_host);
    const Vector3d& b = between[rings().vertices[r]];
    common += a.dot(b);
    on_host += a.squaredNorm();
    on_joined += b.squaredNorm();
  }
  const double most = std::sqrt(on_host * on_joined);
  return most > 0.0 ? std::clamp(common / most, 0.0, 1.0) : 1.0;
}

// Returns the host's offset from its shape: its detail plus `agreement` times the features between
// detail and shape.
std::vector<Vector3d> SeamReconstruction::host_detail() const {
  const double size = detail_size(options_);
  const Positions host_fine = host_fairing_->smooth(host_.positions, size);
  Positions between_on_host = host_fine;
  for (std::size_t v = 0; v < host_fine.size(); ++v) {
    between_on_host[v] -= smooth_host_.positions[v];
  }
  Positions between = fairing_->smooth(joined_.positions, size);
  for (std::size_t v = 0; v < between.size(); ++v) between[v] -= smooth_start_.positions[v];
  const double common = agreement(between_on_host, between);
  std::vector<Vector3d> detail(host_fine.size());
  for (std::size_t v = 0; v < detail.size(); ++v) {
    detail[v] = host_.positions[v] - host_fine[v] + common * between_on_host[v];
  }
  return detail;
}

// Fairs the host in the region that corresponds to the faired region of the joined mesh.
void SeamReconstruction::smooth_geometry() {
  cut_distances_ = distances_in_cut(host_);
  VertexSet region;
  for (const Index v : zone_.region.roi) {
    if (is_host(v)) region.push_back(joined_.host_vertices[v]);
  }
  for (Index v = 0; v < cut_distances_.size(); ++v) {
    if (cut_distances_[v] <= free_on_part(options_) + options_.belt) region.push_back(v);
  }
  region = make_vertex_set(std::move(region));
  host_geometry_ = geometry_of(host_.positions, host_.topology, region, options_);
  host_fairing_.emplace(host_geometry_, host_.topology, region, options_.weights);
  fairing_.emplace(joined_.geometry, joined_.topology, zone_.region.roi, options_.weights);
}

// Returns L x, one vector per row.
std::vector<Vector3d> SeamReconstruction::laplacians_of(std::span<const Vector3d> positions) const {
  std::vector<Vector3d> result(rings().row_count(), Vector3d::Zero());
  for (std::size_t r = 0; r < result.size(); ++r) {
    const Vector3d& here = positions[rings().vertices[r]];
    for (std::size_t e = rings().starts[r]; e < rings().starts[r + 1]; ++e) {
      result[r] += rings().weights[e] * (here - positions[rings().vertices[rings().neighbours[e]]]);
    }
  }
  return result;
}

void SeamReconstruction::sample() {
  smooth_host_ = smoothed(*host_fairing_, host_.positions, host_.topology);
  smooth_start_ = smoothed(*fairing_, joined_.positions, joined_.topology);
  const std::vector<Vector3d> detail = host_detail();
  const MappedRings mapped{rings(), on_host_};
  sampled_.resize(rings().row_count());
  if (options_.sampling == MappedSampling::one_ring) {
    kernels_.sample_mapped_laplacians(mapped, options_.sampling, detail, sampled_);
    return;
  }
  // Densities, unlike Laplacians, do not depend on the edge lengths of the host.
  const auto weights = laplacian_weights(host_.topology, host_geometry_, options_.weights);
  std::vector<Index> all;
  for (Index v = 0; v < host_.positions.size(); ++v) all.push_back(v);
  std::vector<Vector3d> density(all.size());
  kernels_.sample_laplacians({detail, host_.topology.rings, weights, all}, density);
  const auto squares = squared_rings(host_.topology.rings, weights, host_geometry_, all);
  for (std::size_t v = 0; v < all.size(); ++v) density[v] *= 4.0 / squares[v];
  kernels_.sample_mapped_laplacians(mapped, options_.sampling, density, sampled_);
}

std::vector<Matrix3d> SeamReconstruction::frames(std::span<const SurfacePoint> points,
                                                 const SmoothSurface& source,
                                                 const SmoothSurface& target) const {
  std::vector<Vector3d> positions;
  std::vector<Vector3d> normals;
  for (const Index v : rings().vertices) {
    positions.push_back(target.positions[v]);
    normals.push_back(target.normals[v]);
  }
  std::vector<Matrix3d> T(rings().row_count());
  kernels_.rotate_frames({rings(), points}, {source.positions, source.normals},
                         {positions, normals}, T);
  for (Matrix3d& t : T) {
    const double ratio = t.col(0).norm();
    // A ring that is a single point has no frame.
    if (ratio > 0.0) {
      t *= std::clamp(ratio, 1.0 / kLargestRatio, kLargestRatio) / ratio;
    } else {
      t = Matrix3d::Identity();
    }
  }
  return T;
}

// Returns the factor that turns a sampled value into the Laplacian of ring r: 1 for Laplacians; for
// densities, r^2 / 4 with the radius of the ring on the host.
double SeamReconstruction::ring_size(std::size_t r, const Matrix3d& T) const {
  if (options_.sampling == MappedSampling::one_ring) return 1.0;
  double square = 0.0;
  for (std::size_t e = rings().starts[r]; e < rings().starts[r + 1]; ++e) {
    square += rings().weights[e] * rings().edges[e].squaredNorm();
  }
  return 0.25 * square / T.col(0).squaredNorm();
}

// Returns the target Laplacians of the surface if its smooth shape is `now`.
std::vector<Vector3d> SeamReconstruction::wanted(const SmoothSurface& now) const {
  const std::vector<Matrix3d> from_part = frames(on_itself_, smooth_start_, now);
  std::vector<Vector3d> on_host_side = laplacians_of(now.positions);
  if (result_.sampled_host) {
    const std::vector<Matrix3d> from_host = frames(on_host_, smooth_host_, now);
    for (std::size_t r = 0; r < sampled_.size(); ++r) {
      on_host_side[r] += from_host[r] * (ring_size(r, from_host[r]) * sampled_[r]);
    }
  }
  std::vector<Vector3d> result(rings().row_count());
  for (std::size_t r = 0; r < result.size(); ++r) {
    result[r] = (1.0 - shares_[r]) * on_host_side[r] + shares_[r] * (from_part[r] * rest_[r]);
  }
  return result;
}

void SeamReconstruction::solve(std::span<const Vector3d> wanted) {
  const std::size_t n = system_->size();
  std::vector<Vector3d> y(wanted.begin(), wanted.end());
  for (std::size_t r = 0; r < y.size(); ++r) y[r] -= rest_[r];
  const Columns b = transposed(rings(), y, n);
  Columns u = b;
  system_->solve_in_elimination_order(u, 3);

  const Columns Au = transposed(rings(), laplacians(rings(), u, n), n);
  Columns r = b;
  const auto& order = system_->elimination_order();
  for (std::size_t k = 0; k < 3 * n; ++k) {
    r[k] -= Au[k] + constraints_.W[static_cast<std::size_t>(order[k % n])] * u[k];
  }
  result_.relative_residual = norm(b) > 0.0 ? norm(r) / norm(b) : 0.0;
  result_.last_change = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const Index v = rings().vertices[k];
    const Vector3d position = joined_.positions[v] + Vector3d(u[k], u[n + k], u[2 * n + k]);
    result_.last_change = std::max(result_.last_change, (position - result_.positions[v]).norm());
    result_.positions[v] = position;
  }
}

TransplantResult SeamReconstruction::run() {
  timed("collars", [&] {
    zone_ = seam_zone(host_, joined_, options_);
    smooth_geometry();
    lay_collars();
  });
  make_system();
  result_.positions.assign(joined_.positions.begin(), joined_.positions.end());
  timed("sample", [&] { sample(); });
  SmoothSurface now = smooth_start_;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (pass > 0) {
      timed("sample", [&] { now = smoothed(*fairing_, result_.positions, joined_.topology); });
    }
    timed("solve", [&] { solve(wanted(now)); });
  }
  const double edge = mean_edge_length(joined_.topology.rings, joined_.positions);
  if (edge > 0.0) result_.last_change /= edge;
  result_.region = constraints_.unknowns.vertices;
  result_.belt = zone_.region.belt;
  return std::move(result_);
}

}  // namespace

Positions smooth_seam(const TransplantHost& host, const TransplantJoined& joined,
                      const TransplantOptions& options) {
  return geometry_of(joined.positions, joined.topology, seam_zone(host, joined, options).region.roi,
                     options);
}

TransplantResult reconstruct_seam(const TransplantHost& host, const TransplantJoined& joined,
                                  const TransplantOptions& options, Kernels& kernels,
                                  const std::string& where, StageTimings& timings,
                                  const Progress& progress) {
  return SeamReconstruction(host, joined, options, kernels, where, timings, progress).run();
}

}  // namespace lapwing
