// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of the project's design notes, section 2.
#include "lapwing/deform/deformer.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/deformer_state.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/response_basis.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

// An edit of whose preparation nothing is kept.
std::shared_ptr<const EditSystem> edit_of(const Topology& topology, std::span<const Vector3d> rest,
                                          EditRegion region, const DeformOptions& options,
                                          const Progress& progress) {
  PreparedRegion prepared(topology);
  return std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress);
}

bool all_keep_size(std::span<const Eigen::Affine3d> motions) {
  // What a rotation is off from no scale by rounding.
  constexpr double kSameScale = 1e-12;
  return std::all_of(motions.begin(), motions.end(), [](const Eigen::Affine3d& motion) {
    return std::abs(scale_of(motion) - 1.0) < kSameScale;
  });
}

// A result is in double precision whatever the device; and a device that is the processor in
// disguise takes about three times as long as the CPU twins (measured on lavapipe).
bool settles_on(const DeviceInfo& device) {
  return device.float64 && device.frames;
}

}  // namespace

// False where it does not fit and settling can do without.
bool Deformer::State::hold_response(const Progress& progress) {
  try {
    system->hold_response(*kernels, progress, timings);
  } catch (const DoesNotFit& reason) {
    if (!system->options.settle) throw;
    why_not_exact = reason.need();
    return false;
  }
  return true;
}

// The RSI system does without, unless it settles.
bool Deformer::State::has_shares() const {
  return system->options.settle || has_scale_forces();
}

// They take the factor of the n x n system, which a linear response that scales nothing needs for
// nothing else. Under the lock.
const HandleShares& Deformer::State::held_shares() const {
  system->hold_laplacian();
  if (shares == nullptr) shares = std::make_unique<HandleShares>(*system);
  return *shares;
}

std::vector<double> Deformer::State::asked_scales(std::span<const Eigen::Affine3d> motions) const {
  if (all_keep_size(motions)) return {};
  std::vector<double> scales;
  for (const Eigen::Affine3d& motion : motions) scales.push_back(scale_of(motion));
  return held_shares().scales(scales);
}

void Deformer::State::make_settler(Kernels& on) {
  if (!system->options.settle) return;
  const LaplacianSystem& laplacian = system->systems->laplacian_with_rings();
  tangent = std::make_unique<PoseTangent>(
      system->topology, system->region.roi, system->systems->pattern(), laplacian, *system->rest,
      system->options, *kernels, why_not_exact.empty() ? system->systems->tangent_rows() : nullptr);
  parts = std::make_unique<RegionPartSettler>(*system);
  settler =
      std::make_unique<Settler>(on, laplacian, *system->options.settle, tangent.get(), parts.get());
}

// The RSI system has none.
bool Deformer::State::has_scale_forces() const {
  return system->options.response == LinearResponse::tangent;
}

// What the scale that handles ask for pulls the unknowns by; empty for nothing.
Numbers Deformer::State::forces_of_scales(std::span<const double> q) const {
  if (!has_scale_forces() || !why_not_exact.empty()) return {};
  std::vector<double> growth;
  for (std::size_t h = 0; h < system->frames.size(); ++h) {
    growth.push_back(growth_of(system->frames[h], q.subspan(h * kMotionParameters)));
  }
  if (std::all_of(growth.begin(), growth.end(), [](double g) { return g == 0.0; })) return {};
  return scale_forces(*system, held_shares().spread(growth));
}

// That, and what the springs pull them by.
Numbers Deformer::State::forces_of(std::span<const double> q) const {
  const LaplacianSystem& laplacian = system->systems->laplacian();
  Numbers forces = spring_forces(laplacian.springs(), system->constraints.unknowns);
  Numbers of_scales = forces_of_scales(q);
  if (of_scales.empty()) return forces;
  for (std::size_t i = 0; i < forces.size(); ++i) of_scales[i] += forces[i];
  return of_scales;
}

// Of one motion, by one right-hand side and without columns.
std::vector<Vector3d> Deformer::State::linear_displacement(std::span<const Vector3d> wanted,
                                                           std::span<const double> forces) const {
  if (why_not_exact.empty()) return lapwing::linear_displacement(*system, wanted, forces);
  return axis_displacement(*system, wanted);
}

Deformer::Deformer(std::span<const Vector3d> rest, const Topology& topology, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(edit_of(topology, rest, std::move(region), options, progress), kernels, progress) {}

Deformer::Deformer(PreparedRegion& prepared, std::span<const Vector3d> rest, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(
          std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress),
          kernels, progress) {}

Deformer::Deformer(const DragPreview& preview, Kernels& kernels, const Progress& progress)
    : Deformer(preview.system(), kernels, progress) {}

Deformer::Deformer(std::shared_ptr<const EditSystem> system, Kernels& kernels,
                   const Progress& progress)
    : state_(std::make_unique<State>()) {
  const ProgressScope scope(progress);
  State& s = *state_;
  s.system = std::move(system);
  s.kernels = &kernels;
  const EditSystem& edit = *s.system;
  s.timings = edit.timings;
  const auto lock = edit.systems->lock();
  s.hold_response(progress);
  edit.assemble_laplacian();
  s.weights = edit.systems->laplacian().shared_weights();
  Stopwatch watch;
  if (edit.options.settle) {
    report_progress(progress, "shares", 0.0);
    s.held_shares();
    s.timings.add("shares", watch.elapsed_ms());
    watch.restart();
  }
  report_progress(progress, "upload", 0.0);
  CpuKernels cpu;
  s.make_settler(settles_on(kernels.device()) ? kernels : cpu);
  s.timings.add("upload", watch.elapsed_ms());
  report_progress(progress, "upload", 1.0);
}

// The systems may be another edit's meanwhile.
void Deformer::hold(const Progress& progress) const {
  const State& s = *state_;
  StageTimings untold;
  if (is_exact()) s.system->hold_response(*s.kernels, progress, untold);
  if (s.settler != nullptr) {
    hold_for_settling();
  } else {
    s.system->assemble_laplacian();
  }
}

void Deformer::hold_for_settling() const {
  state_->system->hold_laplacian();
  state_->system->systems->laplacian_with_rings();
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

DeformResult Deformer::solve(std::span<const Eigen::Affine3d> motions,
                             const Progress& progress) const {
  std::vector<Eigen::AngleAxisd> turns;
  for (const Eigen::Affine3d& motion : motions) turns.push_back(shortest_turn(motion));
  return solve(motions, turns, progress);
}

// u is where the linear response ends; becomes where to settle from.
void Deformer::choose_start(std::span<const Eigen::Affine3d> motions,
                            std::span<const Eigen::AngleAxisd> turns, const SettleTarget& target,
                            std::vector<Vector3d>& u) const {
  const State& s = *state_;
  std::vector<Vector3d> turned = s.held_shares().turned(motions, turns);
  if (!s.system->region.targets.empty()) {
    const std::vector<double> still(s.system->column_count(), 0.0);
    const std::vector<Vector3d> drawn =
        axis_displacement(*s.system, s.system->asked_displacement(still));
    for (const Index v : s.system->moving) turned[v] += drawn[v];
  }
  if (any_far(turns) || s.settler->energy(target, turned) < s.settler->energy(target, u)) {
    u = std::move(turned);
  }
}

DeformResult Deformer::solve(std::span<const Eigen::Affine3d> motions,
                             std::span<const Eigen::AngleAxisd> turns,
                             const Progress& progress) const {
  const ProgressScope scope(progress);
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  const auto lock = edit.systems->lock();
  hold(progress);
  std::vector<double> q(edit.column_count());
  edit.set_parameters(motions, q);
  std::vector<Vector3d>& wanted = s.asked[0];
  edit.asked_displacement(q, wanted);
  const Numbers forces = s.forces_of(q);
  std::vector<Vector3d> u = s.linear_displacement(wanted, forces);
  std::vector<double> scales;
  if (s.has_shares()) scales = s.asked_scales(motions);

  DeformResult result;
  Certificate& certificate = result.certificate;
  certificate.why_not_exact = s.why_not_exact;
  const bool still =
      std::all_of(u.begin(), u.end(), [](const Vector3d& v) { return v.isZero(0.0); });
  if (s.settler == nullptr) {
    certificate.relative_residual = edit.systems->response().refine(wanted, forces, u);
  } else if (!still || any_far(turns)) {
    const SettleTarget target{wanted, scales};
    choose_start(motions, turns, target, u);
    const SettleResult settled = s.settler->settle(target, u, progress);
    certificate.settle_iterations = settled.iterations;
    certificate.settled = settled.settled;
    certificate.settle_last_step = settled.last_step;
    certificate.relative_gradient = settled.relative_gradient;
  }
  edit.loose.carry(wanted, scales, u);
  result.positions = *edit.rest;
  for (const Index v : edit.moving) {
    // Adding 0 would turn a coordinate of -0 into +0.
    if (!u[v].isZero(0.0)) result.positions[v] += u[v];
  }
  for (const Target& target : edit.region.targets) {
    // To the bit: the sum of place and displacement is rounded.
    if (edit.region.hard_targets && target.is_vertex()) {
      result.positions[target.corners[0]] = target.position;
    }
  }
  for (const auto& handle : edit.region.handles) {
    for (const Index v : handle) {
      certificate.handle_error = std::max(certificate.handle_error, (u[v] - wanted[v]).norm());
      certificate.asked_motion = std::max(certificate.asked_motion, wanted[v].norm());
    }
  }
  for (const Target& target : edit.region.targets) {
    const double off = (point_of(target, result.positions) - target.position).norm();
    certificate.target_error = std::max(certificate.target_error, off);
    const double way = (target.position - point_of(target, *edit.rest)).norm();
    certificate.asked_motion = std::max(certificate.asked_motion, way);
  }
  measure_region(edit.region, edit.topology, s.weights->laplacian, *edit.rest, result.positions,
                 certificate, scales);
  require_valid(certificate);
  result.asked_scales = std::move(scales);
  return result;
}

std::vector<double> Deformer::asked_scales(std::span<const Eigen::Affine3d> motions) const {
  const State& s = *state_;
  if (all_keep_size(motions) || !s.has_shares()) return {};
  const auto lock = s.system->systems->lock();
  return s.asked_scales(motions);
}

bool Deformer::is_of(std::span<const Vector3d> rest, const Topology& topology,
                     const EditRegion& region, const DeformOptions& options,
                     const Kernels& kernels) const {
  const EditSystem& edit = *state_->system;
  return &edit.topology == &topology && state_->kernels == &kernels && edit.options == options &&
         edit.region == region && same_bits(*edit.rest, rest);
}

bool Deformer::is_exact() const {
  return state_->why_not_exact.empty();
}
std::string_view Deformer::why_not_exact() const {
  return state_->why_not_exact;
}
const EditRegion& Deformer::region() const {
  return state_->system->region;
}
const StageTimings& Deformer::timings() const {
  return state_->timings;
}
std::string_view Deformer::solver_name() const {
  const RegionSystem& systems = *state_->system->systems;
  return is_exact() ? systems.response().solver_name() : systems.laplacian().solver_name();
}
std::size_t Deformer::unknown_count() const {
  return state_->system->constraints.unknowns.size();
}

std::size_t Deformer::free_count() const {
  const EditRegion& region = state_->system->region;
  std::size_t constrained = region.belt.size();
  for (const auto& handle : region.handles) constrained += handle.size();
  return region.roi.size() - constrained;
}

}  // namespace lapwing
