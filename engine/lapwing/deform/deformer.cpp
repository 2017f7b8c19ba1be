// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of ENERGY.md section 2.
#include "lapwing/deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/deformer_state.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/response_basis.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rotation.h"
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

// Whether nothing asks the surface to leave its rest.
bool rests(const EditSystem& edit, std::span<const Vector3d> wanted) {
  return std::ranges::all_of(wanted, [](const Vector3d& d) { return d.isZero(0.0); }) &&
         std::ranges::all_of(edit.systems->laplacian().springs(),
                             [](const Spring& spring) { return spring.wanted.isZero(0.0); });
}

// A result is in double precision whatever the device; and a device that is the processor in
// disguise takes about three times as long as the CPU twins (measured on lavapipe).
bool settles_on(const DeviceInfo& device) {
  return device.float64 && device.frames;
}

}  // namespace

// False where it does not fit and settling can do without.
bool Deformer::State::hold_response(const Progress& progress, StageTimings& stages) {
  try {
    system->hold_response(*kernels, progress, stages);
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

// Under the lock. A linear response that scales nothing does without the factor of the n x n
// system.
RestStretch Deformer::State::asked_stretch(std::span<const Eigen::Affine3d> motions) const {
  if (are_rigid(motions)) return {};
  system->hold_laplacian();
  return lapwing::rest_stretch(*system, motions);
}

void Deformer::State::make_settler(Kernels& on) {
  if (!system->options.settle) return;
  const LaplacianSystem& laplacian = system->systems->laplacian_with_rings();
  tangent = std::make_unique<PoseTangent>(
      system->topology, system->region.roi, system->systems->pattern(), laplacian, system->options,
      [edit = system.get(), on_kernels = kernels] { return edit->tangent_rows(*on_kernels); });
  settler = std::make_unique<Settler>(on, laplacian, *system->options.settle, tangent.get());
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

Deformer::Deformer(std::span<const Vector3d> rest, const Topology& topology, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(edit_of(topology, rest, std::move(region), options, progress), kernels, progress) {}

Deformer::Deformer(PreparedRegion& prepared, std::span<const Vector3d> rest, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(
          std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress),
          kernels, progress) {}

Deformer::Deformer(const DragPreview& preview, Kernels& kernels, const Progress& progress)
    : Deformer(preview.system(), kernels, progress) {
  const DragResponse& columns = *preview.response();
  const bool has_all = columns.handles().size() == state_->system->frames.size();
  if (has_all && !response_helps_to_follow()) state_->latest = preview.response();
}

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
  if (!edit.options.settle) s.hold_response(progress, s.timings);
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
  StageTimings untold;
  if (is_exact()) state_->hold_response(progress, untold);
  if (state_->settler != nullptr) {
    hold_for_settling();
  } else {
    state_->system->assemble_laplacian();
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
  return solve(handle_motions(motions), progress);
}

DeformResult Deformer::solve(const HandleMotions& motions, const Progress& progress) const {
  const ProgressScope scope(progress);
  const auto lock = state_->system->systems->lock();
  return solved(nullptr, motions, progress);
}

DeformResult Deformer::solve_along(std::span<const HandleMotions> path,
                                   const HandleMotions& motions, const Progress& progress) const {
  const ProgressScope scope(progress);
  const bool has_path = state_->settler != nullptr && !path.empty();
  if (has_path) wait_for_coarse(progress);
  const auto lock = state_->system->systems->lock();
  if (!has_path) return solved(nullptr, motions, progress);
  const SettledPose pose = followed(path, progress);
  return solved(&pose, motions, progress);
}

DeformResult Deformer::solve_from(const SettledPose& pose, const HandleMotions& motions,
                                  const Progress& progress) const {
  const ProgressScope scope(progress);
  const auto lock = state_->system->systems->lock();
  return solved(pose.parameters.empty() ? nullptr : &pose, motions, progress);
}

FreeHandle Deformer::State::free_handle(std::size_t handle, const Eigen::Affine3d& map) const {
  const EditSystem& edit = *system;
  const Vector3d& centroid = edit.frames[handle].centroid;
  const Vector3d centre = map * centroid;
  const Eigen::Matrix3d stretch = nearest_rotation(map.linear()).transpose() * map.linear();
  FreeHandle free;
  const auto add = [&](Index v) {
    if (edit.constraints.unknowns.of_vertex[v] == kNoIndex) return;
    free.vertices.push_back(v);
    free.shape.push_back(stretch * ((*edit.rest)[v] - centroid));
    free.to_centre.push_back(centre - (*edit.rest)[v]);
  };
  for (const Index v : edit.region.handles[handle]) add(v);
  for (const GradedVertex& graded : edit.region.graded) {
    if (graded.handle == handle) add(graded.vertex);
  }
  return free;
}

// Under the lock.
AskedOfSurface Deformer::State::asked_of(HandleMotions motions,
                                         std::vector<Vector3d>& wanted) const {
  AskedOfSurface asked;
  asked.parameters.resize(system->column_count());
  system->set_parameters(motions.maps, asked.parameters);
  system->asked_displacement(asked.parameters, wanted);
  asked.wanted = &wanted;
  if (has_shares()) asked.stretch = asked_stretch(motions.maps);
  if (motions.any_free() && (settler == nullptr || system->options.hard)) {
    throw InputError(
        "a handle whose orientation is free needs a surface that settles, with soft constraints; "
        "set its orientation, or leave out \"hard\" and \"settle\"");
  }
  for (std::size_t h = 0; h < motions.maps.size(); ++h) {
    if (motions.is_free_handle(h)) asked.free_handles.push_back(free_handle(h, motions.maps[h]));
  }
  asked.motions = std::move(motions);
  return asked;
}

// Updates the motions of the free handles to the rotations found.
void Deformer::State::take_rotations(std::span<const Eigen::Matrix3d> rotations,
                                     AskedOfSurface& asked) const {
  if (rotations.empty()) return;
  std::size_t next = 0;
  for (std::size_t h = 0; h < asked.motions.maps.size(); ++h) {
    if (!asked.motions.is_free_handle(h)) continue;
    asked.motions.maps[h] =
        turned_to(asked.motions.maps[h], system->frames[h].centroid, rotations[next++]);
    TurnTracker tracker(asked.motions.turns[h]);
    tracker.follow(asked.motions.maps[h]);
    asked.motions.turns[h] = tracker.turn();
  }
  system->set_parameters(asked.motions.maps, asked.parameters);
  system->asked_displacement(asked.parameters, *asked.wanted);
}

// Where the handles' shares take the surface, and targets draw it by the n x n system.
std::vector<Vector3d> Deformer::turned_start(const HandleMotions& motions,
                                             const RestStretch& stretch) const {
  const State& s = *state_;
  std::vector<Vector3d> turned = s.held_shares().turned(motions.maps, motions.turns, stretch);
  if (!s.system->region.targets.empty()) {
    const std::vector<double> still(s.system->column_count(), 0.0);
    const std::vector<Vector3d> drawn =
        axis_displacement(*s.system, s.system->asked_displacement(still));
    for (const Index v : s.system->moving) turned[v] += drawn[v];
  }
  return turned;
}

// Minimizes from a pose, or without one from the handle weights.
void Deformer::settle_to(AskedOfSurface& asked, const SettledPose* pose, std::span<Vector3d> u,
                         SettleResult& result, const Progress& progress) const {
  State& s = *state_;
  if (pose != nullptr) {
    std::ranges::copy(pose->displacement, u.begin());
    if (pose->parameters != asked.parameters) {
      std::vector<double> change = asked.parameters;
      for (std::size_t k = 0; k < change.size(); ++k) change[k] -= pose->parameters[k];
      const std::vector<Vector3d> response =
          axis_displacement(*s.system, s.system->wanted_displacement(change), Springs::rest);
      for (const Index v : s.system->moving) u[v] += response[v];
    }
    result = s.settler->settle(asked.target(), u, progress);
  } else {
    std::ranges::copy(turned_start(asked.motions, asked.stretch), u.begin());
    result = s.settler->settle(asked.target(), u, progress);
  }
  if (!asked.free_handles.empty()) s.take_rotations(s.settler->handle_rotations(), asked);
}

// Minimizes at each waypoint of a path in turn. Call under the lock.
SettledPose Deformer::followed(std::span<const HandleMotions> path,
                               const Progress& progress) const {
  State& s = *state_;
  hold_for_settling();
  SettledPose pose;
  bool coarse_is_there = false;
  for (const HandleMotions& motions : path) {
    const bool begins = pose.parameters.empty() || any_far_since(pose.motions, motions);
    AskedOfSurface asked = s.asked_of(
        begins ? motions : turned_as(motions, pose.motions, *s.system), s.asked_fields[0]);
    SettledPose next;
    if (begins || s.coarse == nullptr) {
      next.displacement.assign(s.system->rest->size(), Vector3d::Zero());
      settle_to(asked, begins ? nullptr : &pose, next.displacement, next.settled, progress);
      coarse_is_there = false;
    } else {
      s.follow_by_coarse(pose, asked, std::exchange(coarse_is_there, true), progress, next);
    }
    next.motions = std::move(asked.motions);
    next.parameters = std::move(asked.parameters);
    pose = std::move(next);
  }
  return pose;
}

// Under the lock.
DeformResult Deformer::solved(const SettledPose* pose, const HandleMotions& motions,
                              const Progress& progress) const {
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  const bool settles = s.settler != nullptr;
  if (settles) {
    hold_for_settling();
  } else {
    hold(progress);
  }
  if (pose != nullptr && any_far_since(pose->motions, motions)) pose = nullptr;
  AskedOfSurface asked =
      s.asked_of(pose != nullptr && settles ? turned_as(motions, pose->motions, edit) : motions,
                 s.asked_fields[0]);
  const std::vector<Vector3d>& wanted = *asked.wanted;
  DeformResult result;
  Certificate& certificate = result.certificate;
  std::vector<Vector3d> u(edit.rest->size(), Vector3d::Zero());
  if (!settles) {
    const Numbers forces = s.forces_of(asked.parameters);
    u = linear_displacement(edit, wanted, forces);
    certificate.relative_residual = edit.systems->response().refine(wanted, forces, u);
  } else if (any_far(asked.motions.turns) || !rests(edit, wanted)) {
    SettleResult settled;
    settle_to(asked, pose, u, settled, progress);
    certificate.settle_iterations = settled.iterations;
    certificate.settled = settled.settled;
    certificate.settle_last_step = settled.last_step;
    certificate.relative_gradient = settled.relative_gradient;
  }
  std::vector<Eigen::Matrix3d>& stretch = asked.stretch.of_vertices;
  edit.loose.carry(wanted, mean_scales(stretch), u);
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
                 certificate, stretch);
  require_valid(certificate);
  result.rest_stretch = std::move(stretch);
  result.motions = std::move(asked.motions);
  return result;
}

std::vector<Eigen::Matrix3d> Deformer::rest_stretch(
    std::span<const Eigen::Affine3d> motions) const {
  const State& s = *state_;
  if (are_rigid(motions) || !s.has_shares()) return {};
  const auto lock = s.system->systems->lock();
  return s.asked_stretch(motions).of_vertices;
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
  return state_->settler == nullptr ? systems.response().solver_name()
                                    : systems.laplacian().solver_name();
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
