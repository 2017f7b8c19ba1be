// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of the project's design notes, section 2.
#include "lapwing/deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/rsi_solution.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/settle/settle.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The vertices that any motion can displace: all of the region but loose vertices outside the
// handles and, with hard constraints, the belt.
std::vector<Index> moving_vertices(const EditRegion& region, const Unknowns& unknowns) {
  std::vector<Index> moving = unknowns.vertices;
  for (const auto& handle : region.handles) {
    for (const Index v : handle) {
      if (unknowns.of_vertex[v] == kNoIndex) moving.push_back(v);
    }
  }
  std::sort(moving.begin(), moving.end());
  return moving;
}

}  // namespace

struct Deformer::State {
  Positions rest;
  const Topology& topology;
  EditRegion region;
  StageTimings timings;
  std::vector<HandleFrame> frames;
  std::unique_ptr<RsiSolution> solution;
  std::unique_ptr<Settler> settler;  ///< null without settling
  std::vector<double> weights;       ///< of the Laplacians that certificates measure
  std::vector<Index> moving;
  std::vector<double> response;  ///< columns as in SurfaceInput::basis
  std::vector<double> parameters;
  std::unique_ptr<DeformedSurface> surface;

  State(std::span<const Vector3d> positions, const Topology& t, EditRegion r)
      : rest(positions.begin(), positions.end()), topology(t), region(std::move(r)) {}

  std::size_t column_count() const { return kMotionParameters * region.handles.size(); }
  void set_parameters(std::span<const Eigen::Affine3d> motions, std::span<double> out) const;
  void compute_response(const Progress& progress);
  std::vector<Vector3d> blended_displacement(std::span<const double> q) const;
  std::vector<Vector3d> wanted_displacement(std::span<const double> q) const;
  std::vector<Index> free_vertices() const;
};

void Deformer::State::set_parameters(std::span<const Eigen::Affine3d> motions,
                                     std::span<double> out) const {
  if (motions.size() != frames.size()) {
    throw InputError("the region has " + std::to_string(frames.size()) + " handles, but " +
                     std::to_string(motions.size()) + " motions were given; give one per handle");
  }
  for (std::size_t h = 0; h < frames.size(); ++h) {
    motion_parameters(frames[h], motions[h], out.subspan(h * kMotionParameters, kMotionParameters));
  }
}

// What the handles' motions ask for; 0 everywhere else.
std::vector<Vector3d> Deformer::State::wanted_displacement(std::span<const double> q) const {
  std::vector<Vector3d> wanted(rest.size(), Vector3d::Zero());
  for (std::size_t h = 0; h < frames.size(); ++h) {
    const auto own = q.subspan(h * kMotionParameters, kMotionParameters);
    for (const Index v : region.handles[h]) {
      for (std::size_t k = 0; k < kMotionParameters; ++k) {
        wanted[v] += own[k] * unit_displacement(frames[h], rest[v], k);
      }
    }
  }
  return wanted;
}

// Unknowns that neither belt nor handle holds.
std::vector<Index> Deformer::State::free_vertices() const {
  const Constraints& constraints = solution->constraints();
  std::vector<Index> free;
  for (std::size_t k = 0; k < constraints.W.size(); ++k) {
    if (constraints.W[k] == 0.0) free.push_back(constraints.unknowns.vertices[k]);
  }
  return free;
}

void Deformer::State::compute_response(const Progress& progress) {
  const Unknowns& unknowns = solution->unknowns();
  moving = moving_vertices(region, unknowns);
  const std::size_t column = 3 * moving.size();
  const std::size_t n = 3 * unknowns.size();
  response.assign(column * column_count(), 0.0);
  std::vector<double> q(column_count(), 0.0);
  std::vector<double> x(kMotionParameters * n);
  for (std::size_t h = 0; h < frames.size(); ++h) {
    report_progress(progress, "response",
                    static_cast<double>(h) / static_cast<double>(frames.size()));
    const auto unit_motion = [&](std::size_t k) {
      std::fill(q.begin(), q.end(), 0.0);
      q[h * kMotionParameters + k] = 1.0;
      return wanted_displacement(q);
    };
    for (std::size_t k = 0; k < kMotionParameters; ++k) {
      solution->right_hand_side(unit_motion(k), std::span(x).subspan(k * n, n));
    }
    solution->solve_in_place(x, kMotionParameters);
    for (std::size_t k = 0; k < kMotionParameters; ++k) {
      // Vertices that move but are not solved for are handles with hard constraints.
      const std::vector<Vector3d> given = unit_motion(k);
      double* out = response.data() + (h * kMotionParameters + k) * column;
      for (std::size_t m = 0; m < moving.size(); ++m) {
        const Index u = unknowns.of_vertex[moving[m]];
        Eigen::Map<Vector3d>(out + 3 * m) =
            u == kNoIndex ? given[moving[m]]
                          : Vector3d(Eigen::Map<const Vector3d>(x.data() + k * n + 3 * u));
      }
    }
  }
}

// The displacement of every vertex, in double precision.
std::vector<Vector3d> Deformer::State::blended_displacement(std::span<const double> q) const {
  std::vector<Vector3d> u(rest.size(), Vector3d::Zero());
  blend_response(u, moving, response, q, u);
  return u;
}

Deformer::Deformer(std::span<const Vector3d> rest, const Topology& topology, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : state_(std::make_unique<State>(rest, topology, std::move(region))) {
  if (!(options.constraint_weight > 0.0) || !std::isfinite(options.constraint_weight)) {
    throw InputError("the constraint weight must be a positive number, not " +
                     std::to_string(options.constraint_weight));
  }
  State& s = *state_;
  check_anchors(s.region, s.rest, topology, "region");
  for (const auto& handle : s.region.handles) s.frames.push_back(handle_frame(handle, s.rest));
  s.parameters.resize(s.column_count());
  s.solution = std::make_unique<RsiSolution>(s.rest, topology, s.region, options, kernels, progress,
                                             s.timings);
  s.weights = laplacian_weights(topology, s.rest, options.weights);
  if (options.settle) {
    s.settler = std::make_unique<Settler>(s.rest, topology, s.region.roi, s.solution->constraints(),
                                          *options.settle, progress, s.timings);
  }
  Stopwatch watch;
  s.compute_response(progress);
  s.timings.add("response", watch.elapsed_ms());

  watch.restart();
  report_progress(progress, "upload", 0.0);
  s.surface = kernels.make_surface({s.rest, topology, s.moving, s.response, s.column_count()});
  s.timings.add("upload", watch.elapsed_ms());
  report_progress(progress, "upload", 1.0);
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

void Deformer::drag(std::span<const Eigen::Affine3d> motions) {
  state_->set_parameters(motions, state_->parameters);
  state_->surface->blend(state_->parameters);
}

void Deformer::show(std::span<const Vector3d> positions) {
  state_->surface->place(positions);
}

DeformedSurface& Deformer::surface() {
  return *state_->surface;
}

DeformResult Deformer::solve(std::span<const Eigen::Affine3d> motions,
                             const Progress& progress) const {
  const State& s = *state_;
  std::vector<double> q(s.column_count());
  s.set_parameters(motions, q);
  const std::vector<Vector3d> wanted = s.wanted_displacement(q);
  std::vector<Vector3d> u = s.blended_displacement(q);

  DeformResult result;
  result.certificate.relative_residual = s.solution->refine(wanted, u);
  const bool still =
      std::all_of(u.begin(), u.end(), [](const Vector3d& v) { return v.isZero(0.0); });
  if (s.settler != nullptr && !still) {
    const SettleResult settled = s.settler->settle(wanted, u, progress);
    result.certificate.settle_iterations = settled.iterations;
    result.certificate.settled = settled.settled;
    result.certificate.settle_last_step = settled.last_step;
  }
  result.positions = s.rest;
  for (const Index v : s.moving) {
    // Adding 0 would turn a coordinate of -0 into +0.
    if (!u[v].isZero(0.0)) result.positions[v] += u[v];
  }
  for (const auto& handle : s.region.handles) {
    for (const Index v : handle) {
      result.certificate.handle_error =
          std::max(result.certificate.handle_error, (u[v] - wanted[v]).norm());
    }
  }
  measure_shape(s.region.roi, s.topology, s.rest, result.positions, result.certificate);
  const auto free = s.free_vertices();
  result.certificate.detail_error =
      detail_error(free, s.topology, s.weights, s.rest, result.positions);
  result.certificate.edge_stretch =
      edge_stretch(s.region.roi, s.topology, s.rest, result.positions);
  require_valid(result.certificate);
  return result;
}

const EditRegion& Deformer::region() const {
  return state_->region;
}
const StageTimings& Deformer::timings() const {
  return state_->timings;
}
std::string_view Deformer::solver_name() const {
  return state_->solution->solver_name();
}
std::size_t Deformer::unknown_count() const {
  return state_->solution->unknowns().size();
}

std::size_t Deformer::free_count() const {
  std::size_t constrained = state_->region.belt.size();
  for (const auto& handle : state_->region.handles) constrained += handle.size();
  return state_->region.roi.size() - constrained;
}

void Deformer::back_substitute(std::span<double> x) const {
  state_->solution->solve_in_place(x, 1);
}

}  // namespace lapwing
