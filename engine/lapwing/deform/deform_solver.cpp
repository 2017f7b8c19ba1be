// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of ENERGY.md section 2.
#include "lapwing/deform/deform_solver.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/coarse_proxy.h"
#include "lapwing/deform/deform_solver_state.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/linear_response.h"
#include "lapwing/deform/modifiers/rigid_parts.h"
#include "lapwing/deform/motion_target.h"
#include "lapwing/deform/predictor.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

std::shared_ptr<const EditSystem> edit_of(const Topology& topology, std::span<const Vector3d> rest,
                                          EditRegion region, const DeformOptions& options,
                                          const Progress& progress) {
  PreparedRegion prepared(topology);
  return std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress);
}

// Returns true if all prescribed displacements are 0.
bool rests(const EditSystem& edit, std::span<const Vector3d> prescribed) {
  return std::ranges::all_of(prescribed, [](const Vector3d& d) { return d.isZero(0.0); }) &&
         std::ranges::all_of(edit.laplacian->springs(),
                             [](const Spring& spring) { return spring.prescribed.isZero(0.0); });
}

// Minimization needs double precision. Software devices (Mesa lavapipe) take about three times as
// long as the CPU twins, so they are not used.
bool minimizes_on(const DeviceInfo& device) {
  return device.float64 && device.frames;
}

// The RSI system has no scale forces.
bool has_scale_forces(const EditSystem& edit) {
  return edit.options.response == LinearResponse::tangent;
}

// Returns the forces of the springs and of the handles' scales on the unknowns; empty if there are
// no forces.
Numbers linear_forces(const EditSystem& edit, const HandleWeights* weights,
                      std::span<const double> parameters) {
  Numbers forces = spring_forces(edit.laplacian->springs(), edit.constraints.unknowns);
  if (!has_scale_forces(edit)) return forces;
  std::vector<double> growth;
  for (std::size_t h = 0; h < edit.frames.size(); ++h) {
    growth.push_back(growth_of(edit.frames[h], parameters.subspan(h * kMotionParameters)));
  }
  if (std::ranges::all_of(growth, [](double g) { return g == 0.0; })) return forces;
  Numbers of_scales = scale_forces(edit, weights->spread(growth));
  for (std::size_t i = 0; i < forces.size(); ++i) of_scales[i] += forces[i];
  return of_scales;
}

// Minimizes at each waypoint of a path in turn, on the coarse proxy if the region has one.
DragState follow_path(std::span<const HandleMotions> path, const EditSystem& edit,
                      const HandleWeights& weights, EnergyMinimizer& minimizer,
                      const Progress& progress) {
  const std::unique_ptr<CoarseProxy> coarse = CoarseProxy::make(edit);
  bool coarse_is_there = false;
  DragState pose;
  MotionTarget target;
  for (const HandleMotions& motions : path) {
    const bool begins = pose.empty() || any_turned_far_since(pose.motions, motions);
    const std::vector<Vector3d> last_prescribed = target.prescribed;
    const std::vector<Eigen::Matrix3d> last_stretch = std::move(target.stretch.of_vertices);
    target = motion_target(edit, begins ? motions : turned_as(motions, pose.motions, edit),
                           std::move(target.prescribed));
    DragState next;
    if (begins || coarse == nullptr) {
      next.displacement.assign(edit.rest->size(), Vector3d::Zero());
      next.last_result = minimize_from(begins ? nullptr : &pose, edit, weights, minimizer, target,
                                       next.displacement, progress);
      coarse_is_there = false;
    } else {
      if (!std::exchange(coarse_is_there, true)) {
        coarse->begin({last_prescribed, last_stretch}, pose.displacement);
      }
      next.displacement = pose.displacement;
      coarse->settle(target.settle_target(), progress, next.displacement);
      set_free_rotations(edit, coarse->handle_rotations(), target);
      move_held(edit, last_prescribed, target.prescribed, pose.displacement, next.displacement);
    }
    next.motions = target.motions;
    pose = std::move(next);
  }
  return pose;
}

// Measures the prescribed motion of handles and targets, and their distance from the prescribed
// positions.
void measure_constraints(const EditSystem& edit, std::span<const Vector3d> u,
                         std::span<const Vector3d> prescribed, const Positions& positions,
                         Certificate& certificate) {
  for (const auto& handle : edit.region.handles) {
    for (const Index v : handle) {
      certificate.handle_error = std::max(certificate.handle_error, (u[v] - prescribed[v]).norm());
      certificate.prescribed_motion = std::max(certificate.prescribed_motion, prescribed[v].norm());
    }
  }
  for (const Target& target : edit.region.targets) {
    const double off = (point_of(target, positions) - target.position).norm();
    certificate.target_error = std::max(certificate.target_error, off);
    const double way = (target.position - point_of(target, *edit.rest)).norm();
    certificate.prescribed_motion = std::max(certificate.prescribed_motion, way);
  }
}

}  // namespace

MinimizerWorkspace::MinimizerWorkspace(const EditSystem& edit, Kernels& kernels)
    : hessian(edit.topology, edit.region.roi, edit.factors->pattern(), *edit.laplacian,
              edit.options, [&edit, &kernels] { return edit.tangent_rows(kernels); }),
      minimizer(kernels, *edit.laplacian, *edit.options.settle, &hessian) {}

std::shared_ptr<MinimizerWorkspace> DeformSolverState::take_workspace() const {
  {
    const std::scoped_lock lock(mutex_);
    if (unused_ != nullptr) return std::move(unused_);
  }
  return std::make_shared<MinimizerWorkspace>(*edit, *minimizer_kernels);
}

void DeformSolverState::give_back(std::shared_ptr<MinimizerWorkspace> workspace) const {
  const std::scoped_lock lock(mutex_);
  if (unused_ == nullptr) unused_ = std::move(workspace);
}

MinimizerResult minimize_from(const DragState* pose, const EditSystem& edit,
                              const HandleWeights& weights, EnergyMinimizer& minimizer,
                              MotionTarget& target, std::span<Vector3d> u,
                              const Progress& progress) {
  if (pose == nullptr) {
    std::ranges::copy(start_by_handle_weights(edit, weights, target), u.begin());
  } else {
    std::vector<double> parameters(edit.column_count());
    edit.set_parameters(pose->motions.maps, parameters);
    if (parameters == target.parameters) {
      std::ranges::copy(pose->displacement, u.begin());
    } else {
      const std::vector<Vector3d> prescribed = edit.prescribed_displacement(parameters);
      std::ranges::copy(
          Predictor().predict(edit, prescribed, target.prescribed, pose->displacement), u.begin());
    }
  }
  const MinimizerResult result = minimizer.settle(target.settle_target(), u, progress);
  set_free_rotations(edit, minimizer.handle_rotations(), target);
  return result;
}

DeformSolver::DeformSolver(std::span<const Vector3d> rest, const Topology& topology,
                           EditRegion region, const DeformOptions& options, Kernels& kernels,
                           const Progress& progress)
    : DeformSolver(edit_of(topology, rest, std::move(region), options, progress), kernels,
                   progress) {}

DeformSolver::DeformSolver(PreparedRegion& prepared, std::span<const Vector3d> rest,
                           EditRegion region, const DeformOptions& options, Kernels& kernels,
                           const Progress& progress)
    : DeformSolver(
          std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress),
          kernels, progress) {}

DeformSolver::DeformSolver(const DragPreview& preview, Kernels& kernels, const Progress& progress)
    : DeformSolver(preview.system(), kernels, progress) {}

DeformSolver::DeformSolver(std::shared_ptr<const EditSystem> edit, Kernels& kernels,
                           const Progress& progress) {
  const ProgressScope scope(progress);
  auto state = std::make_unique<DeformSolverState>();
  state->edit = std::move(edit);
  state->kernels = &kernels;
  state->minimizer_kernels = minimizes_on(kernels.device()) ? &kernels : &state->cpu;
  state->timings = state->edit->timings;
  if (!state->edit->options.settle) {
    state->response = state->edit->response(kernels, progress, state->timings);
  }
  report_progress(progress, "shares", 0.0);
  const Stopwatch watch;
  if (state->edit->takes_rest_stretch()) {
    state->weights = std::make_unique<const HandleWeights>(*state->edit);
  }
  state->timings.add("shares", watch.elapsed_ms());
  report_progress(progress, "shares", 1.0);
  const EditSystem& system = *state->edit;
  if (system.options.settle) {
    if (auto rigid =
            with_rigid_handles(system.region, system.topology, system.options.constraint_weight)) {
      state->with_rigid_parts = std::make_unique<const DeformSolver>(
          *system.rest, system.topology, std::move(*rigid), system.options, kernels, progress);
    }
  }
  state_ = std::move(state);
}

DeformSolver::~DeformSolver() = default;
DeformSolver::DeformSolver(DeformSolver&&) noexcept = default;
DeformSolver& DeformSolver::operator=(DeformSolver&&) noexcept = default;

DeformResult DeformSolver::solve(std::span<const Eigen::Affine3d> motions,
                                 const Progress& progress) const {
  return solve(handle_motions(motions), progress);
}

DeformResult DeformSolver::solve(const HandleMotions& motions, const Progress& progress) const {
  return solved(nullptr, motions, progress);
}

DeformResult DeformSolver::solve_along(std::span<const HandleMotions> path,
                                       const HandleMotions& motions,
                                       const Progress& progress) const {
  const EditSystem& edit = *state_->edit;
  if (!edit.options.settle || path.empty()) return solved(nullptr, motions, progress);
  const ProgressScope scope(progress);
  DragState pose;
  {
    const BorrowedWorkspace workspace(*state_);
    pose = follow_path(path, edit, *state_->weights, workspace->minimizer, progress);
  }
  return solved(&pose, motions, progress);
}

DeformResult DeformSolver::solve_from(const DragState& pose, const HandleMotions& motions,
                                      const Progress& progress) const {
  return solved(pose.displacement.empty() ? nullptr : &pose, motions, progress);
}

DeformResult DeformSolver::solved(const DragState* pose, const HandleMotions& motions,
                                  const Progress& progress) const {
  const ProgressScope scope(progress);
  const EditSystem& edit = *state_->edit;
  const bool settles = edit.options.settle.has_value();
  if (!settles || (pose != nullptr && any_turned_far_since(pose->motions, motions))) pose = nullptr;
  MotionTarget target =
      motion_target(edit, pose != nullptr ? turned_as(motions, pose->motions, edit) : motions);
  DeformResult result;
  Certificate& certificate = result.certificate;
  std::vector<Vector3d> u(edit.rest->size(), Vector3d::Zero());
  if (!settles) {
    const Numbers forces = linear_forces(edit, state_->weights.get(), target.parameters);
    u = linear_displacement(edit, *state_->response, target.prescribed, forces);
    certificate.relative_residual = state_->response->refine(target.prescribed, forces, u);
  } else if (any_turned_far(target.motions.turns) || !rests(edit, target.prescribed)) {
    const BorrowedWorkspace workspace(*state_);
    const MinimizerResult settled =
        minimize_from(pose, edit, *state_->weights, workspace->minimizer, target, u, progress);
    certificate.settle_iterations = settled.iterations;
    certificate.settled = settled.settled;
    certificate.settle_last_step = settled.last_step;
    certificate.lacks_hessian = settled.lacks_hessian;
    certificate.relative_gradient = settled.relative_gradient;
    if (const DeformSolver* rigid = state_->with_rigid_parts.get()) {
      const DragState bent{
          with_rigid_motions(target.motions, rigid->region(), *edit.rest, u), u, {}};
      result = rigid->solve_from(bent, bent.motions, progress);
      certificate.settle_iterations += settled.iterations;
      certificate.settled = certificate.settled && settled.settled;
      result.motions = std::move(target.motions);
      return result;
    }
  }
  const std::vector<Vector3d>& prescribed = target.prescribed;
  std::vector<Eigen::Matrix3d>& stretch = target.stretch.of_vertices;
  edit.loose.carry(prescribed, mean_scales(stretch), u);
  result.positions = *edit.rest;
  for (const Index v : edit.moving) {
    // Adding 0 would change a coordinate of -0 to +0.
    if (!u[v].isZero(0.0)) result.positions[v] += u[v];
  }
  for (const Target& of_vertex : edit.region.targets) {
    // Set exactly, because the sum of position and displacement is rounded.
    if (edit.region.hard_targets && of_vertex.is_vertex()) {
      result.positions[of_vertex.corners[0]] = of_vertex.position;
    }
  }
  measure_constraints(edit, u, prescribed, result.positions, certificate);
  measure_region(edit.region, edit.topology, edit.laplacian->weights().laplacian, *edit.rest,
                 result.positions, certificate, stretch);
  require_valid(certificate);
  result.rest_stretch = std::move(stretch);
  result.motions = std::move(target.motions);
  return result;
}

std::shared_ptr<const DragResponse> DeformSolver::response(const Progress& progress) const {
  return response_of(state_->edit->all_handles(), progress);
}

std::shared_ptr<const DragResponse> DeformSolver::response_of(std::span<const std::size_t> handles,
                                                              const Progress& progress) const {
  const ProgressScope scope(progress);
  const EditSystem& edit = *state_->edit;
  std::vector<std::size_t> dragged = in_order(handles);
  StageTimings untold;
  try {
    const auto system =
        state_->response ? state_->response : edit.response(*state_->kernels, progress, untold);
    report_progress(progress, "response", 0.0);
    const HandleWeights* weights = has_scale_forces(edit) ? state_->weights.get() : nullptr;
    Numbers columns = response_basis(edit, *system, dragged, weights, progress);
    return std::make_shared<const DragResponse>(state_->edit, std::move(dragged),
                                                std::move(columns), false);
  } catch (const DoesNotFit& reason) {
    if (!edit.options.settle) throw;
    Numbers columns = laplacian_response(edit, dragged);
    return std::make_shared<const DragResponse>(state_->edit, std::move(dragged),
                                                std::move(columns), true, reason.need());
  }
}

std::vector<Eigen::Matrix3d> DeformSolver::rest_stretch(
    std::span<const Eigen::Affine3d> motions) const {
  if (!state_->edit->takes_rest_stretch()) return {};
  return lapwing::rest_stretch(*state_->edit, motions).of_vertices;
}

bool DeformSolver::is_of(std::span<const Vector3d> rest, const Topology& topology,
                         const EditRegion& region, const DeformOptions& options,
                         const Kernels& kernels) const {
  const EditSystem& edit = *state_->edit;
  return &edit.topology == &topology && state_->kernels == &kernels && edit.options == options &&
         edit.region == region && same_bits(*edit.rest, rest);
}

const EditRegion& DeformSolver::region() const {
  return state_->edit->region;
}
const StageTimings& DeformSolver::timings() const {
  return state_->timings;
}
std::string_view DeformSolver::solver_name() const {
  return state_->response ? state_->response->solver_name()
                          : state_->edit->laplacian->solver_name();
}
std::size_t DeformSolver::unknown_count() const {
  return state_->edit->constraints.unknowns.size();
}

}  // namespace lapwing
