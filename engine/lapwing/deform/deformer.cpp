// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of the project's design notes, section 2.
#include "lapwing/deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/deform/turned_start.h"
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
  return std::make_shared<const EditSystem>(prepared, rest, std::move(region), options,
                                            options.settle.has_value(), progress);
}

bool any_far(std::span<const Eigen::AngleAxisd> turns) {
  constexpr double kLimit = kLargestLinearTurnDegrees * std::numbers::pi / 180.0;
  return std::any_of(turns.begin(), turns.end(),
                     [](const Eigen::AngleAxisd& turn) { return std::abs(turn.angle()) > kLimit; });
}

// Whether a handle has turned too far from the last frame to this one to go on from there.
bool any_far(std::span<const Eigen::AngleAxisd> turns, std::span<const Eigen::AngleAxisd> last) {
  std::vector<Eigen::AngleAxisd> since;
  for (std::size_t h = 0; h < last.size(); ++h) {
    const Vector3d change = turns[h].angle() * turns[h].axis() - last[h].angle() * last[h].axis();
    since.emplace_back(change.norm(), Vector3d::UnitX());
  }
  return any_far(since);
}

// A result is in double precision whatever the device; and a device that is the processor in
// disguise takes about three times as long as the CPU twins (measured on lavapipe).
bool settles_on(const DeviceInfo& device) {
  return device.float64 && device.type != "software";
}

// How many times `last` a change goes in that direction, within what a last frame can foretell.
double share_along(std::span<const double> change, std::span<const double> last) {
  constexpr double kMost = 2.0;
  const double size = std::inner_product(last.begin(), last.end(), last.begin(), 0.0);
  if (size == 0.0) return 0.0;
  const double along = std::inner_product(change.begin(), change.end(), last.begin(), 0.0);
  return std::clamp(along / size, -kMost, kMost);
}

}  // namespace

struct Deformer::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  Kernels* kernels = nullptr;
  std::unique_ptr<Settler> settler;  ///< null without settling, as the next
  std::unique_ptr<TurnedStart> turned_start;
  std::vector<double> weights;  ///< of the Laplacians that certificates measure
  Numbers response;             ///< columns as in SurfaceInput::basis, or axis_response
  std::string why_not_exact;
  std::vector<double> parameters;
  std::unique_ptr<DeformedSurface> surface;

  bool hold_rsi(const Progress& progress);
  void compute_response(const Progress& progress);
  void make_surface();
  void make_settler(Kernels& on);
  std::vector<Vector3d> blended_displacement(std::span<const double> q) const;
  Positions moved_on(const SettledPose& pose, std::vector<double>& change) const;
};

// False where it does not fit and settling can do without.
bool Deformer::State::hold_rsi(const Progress& progress) {
  try {
    system->hold_rsi(weights, *kernels, progress, timings);
  } catch (const DoesNotFit& reason) {
    if (!system->options.settle) throw;
    why_not_exact = reason.need();
    return false;
  }
  return true;
}

void Deformer::State::compute_response(const Progress& progress) {
  const EditSystem& s = *system;
  const Unknowns& unknowns = s.constraints.unknowns;
  const RsiSolution& rsi = s.systems->rsi();
  const std::size_t column = 3 * s.moving.size();
  const std::size_t n = 3 * unknowns.size();
  response.resize(column * s.column_count());
  Numbers x(kMotionParameters * n);
  for (std::size_t h = 0; h < s.frames.size(); ++h) {
    report_progress(progress, "response",
                    static_cast<double>(h) / static_cast<double>(s.frames.size()));
    const auto unit_motion = [&](std::size_t k) {
      std::vector<double> q(s.column_count(), 0.0);
      q[h * kMotionParameters + k] = 1.0;
      return s.wanted_displacement(q);
    };
    parallel_for(kMotionParameters, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        rsi.right_hand_side(unit_motion(k), std::span(x).subspan(k * n, n));
      }
    });
    rsi.solve_in_place(x, kMotionParameters);
    parallel_for(kMotionParameters, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        // Vertices that move but are not solved for are handles with hard constraints.
        const std::vector<Vector3d> given = unit_motion(k);
        double* out = response.data() + (h * kMotionParameters + k) * column;
        for (std::size_t m = 0; m < s.moving.size(); ++m) {
          const Index u = unknowns.of_vertex[s.moving[m]];
          Eigen::Map<Vector3d>(out + 3 * m) =
              u == kNoIndex ? given[s.moving[m]]
                            : Vector3d(Eigen::Map<const Vector3d>(x.data() + k * n + 3 * u));
        }
      }
    });
  }
}

void Deformer::State::make_surface() {
  const EditSystem& s = *system;
  surface = kernels->make_surface({*s.rest, s.topology, s.moving, {}, s.column_count()});
  if (why_not_exact.empty()) {
    surface->set_basis(response);
  } else {
    surface->set_axis_basis(response);
  }
}

void Deformer::State::make_settler(Kernels& on) {
  if (!system->options.settle) return;
  settler = std::make_unique<Settler>(on, system->systems->laplacian_with_rings(),
                                      *system->options.settle);
  turned_start = std::make_unique<TurnedStart>(*system);
}

// The displacement of every vertex, in double precision.
std::vector<Vector3d> Deformer::State::blended_displacement(std::span<const double> q) const {
  std::vector<Vector3d> u(system->rest->size(), Vector3d::Zero());
  if (why_not_exact.empty()) {
    blend_response(u, system->moving, response, q, u);
  } else {
    blend_axis_response(system->moving, response, q, u);
  }
  return u;
}

// Where the linear response takes a drag from its last frame; `change` are the parameters and
// becomes what has changed of them.
Positions Deformer::State::moved_on(const SettledPose& pose, std::vector<double>& change) const {
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= pose.parameters[k];
  Positions u = blended_displacement(change);
  for (const Index v : system->moving) u[v] += pose.displacement[v];
  return u;
}

Deformer::Deformer(std::span<const Vector3d> rest, const Topology& topology, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(edit_of(topology, rest, std::move(region), options, progress), kernels, progress) {}

Deformer::Deformer(PreparedRegion& prepared, std::span<const Vector3d> rest, EditRegion region,
                   const DeformOptions& options, Kernels& kernels, const Progress& progress)
    : Deformer(std::make_shared<const EditSystem>(prepared, rest, std::move(region), options,
                                                  options.settle.has_value(), progress),
               kernels, progress) {}

Deformer::Deformer(const DragPreview& preview, Kernels& kernels, const Progress& progress)
    : Deformer(preview.system(), kernels, progress) {}

Deformer::Deformer(std::shared_ptr<const EditSystem> system, Kernels& kernels,
                   const Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.system = std::move(system);
  s.kernels = &kernels;
  const EditSystem& edit = *s.system;
  s.timings = edit.timings;
  s.parameters.resize(edit.column_count());
  s.weights = laplacian_weights(edit.topology, *edit.rest, edit.options.weights);
  const auto lock = edit.systems->lock();
  const bool exact = s.hold_rsi(progress);
  if (edit.options.settle) edit.hold_laplacian();
  Stopwatch watch;
  if (exact) {
    s.compute_response(progress);
  } else {
    report_progress(progress, "response", 0.0);
    s.response = axis_response(edit);
  }
  s.timings.add("response", watch.elapsed_ms());

  watch.restart();
  report_progress(progress, "upload", 0.0);
  if (settles_on(kernels.device())) {
    s.make_surface();
    s.make_settler(kernels);
  } else {
    CpuKernels cpu;
    parallel_invoke([&] { s.make_surface(); }, [&] { s.make_settler(cpu); });
  }
  s.timings.add("upload", watch.elapsed_ms());
  report_progress(progress, "upload", 1.0);
}

// The systems may be another edit's meanwhile.
void Deformer::hold(const Progress& progress) const {
  const State& s = *state_;
  StageTimings untold;
  if (is_exact()) s.system->hold_rsi(s.weights, *s.kernels, progress, untold);
  if (s.settler != nullptr) hold_for_settling();
}

void Deformer::hold_for_settling() const {
  state_->system->hold_laplacian();
  state_->system->systems->laplacian_with_rings();
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

void Deformer::drag(std::span<const Eigen::Affine3d> motions) {
  state_->system->set_parameters(motions, state_->parameters);
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
  std::vector<Eigen::AngleAxisd> turns;
  for (const Eigen::Affine3d& motion : motions) turns.push_back(shortest_turn(motion));
  return solve(motions, turns, progress);
}

// Settles u, the linear solution, from there or from the turned start.
void Deformer::settle(std::span<const Eigen::Affine3d> motions,
                      std::span<const Eigen::AngleAxisd> turns, std::span<const Vector3d> wanted,
                      std::vector<Vector3d>& u, Certificate& certificate,
                      const Progress& progress) const {
  const State& s = *state_;
  if (any_far(turns)) u = s.turned_start->displacement(motions, turns);
  const SettleResult settled = s.settler->settle(wanted, u, progress);
  certificate.settle_iterations = settled.iterations;
  certificate.settled = settled.settled;
  certificate.settle_last_step = settled.last_step;
}

DeformResult Deformer::solve(std::span<const Eigen::Affine3d> motions,
                             std::span<const Eigen::AngleAxisd> turns,
                             const Progress& progress) const {
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  const auto lock = edit.systems->lock();
  hold(progress);
  std::vector<double> q(edit.column_count());
  edit.set_parameters(motions, q);
  const std::vector<Vector3d> wanted = edit.wanted_displacement(q);
  std::vector<Vector3d> u = s.blended_displacement(q);

  DeformResult result;
  result.certificate.why_not_exact = s.why_not_exact;
  if (is_exact()) result.certificate.relative_residual = edit.systems->rsi().refine(wanted, u);
  const bool still =
      std::all_of(u.begin(), u.end(), [](const Vector3d& v) { return v.isZero(0.0); });
  if (s.settler != nullptr && (!still || any_far(turns))) {
    settle(motions, turns, wanted, u, result.certificate, progress);
  }
  result.positions = *edit.rest;
  for (const Index v : edit.moving) {
    // Adding 0 would turn a coordinate of -0 into +0.
    if (!u[v].isZero(0.0)) result.positions[v] += u[v];
  }
  for (const auto& handle : edit.region.handles) {
    for (const Index v : handle) {
      result.certificate.handle_error =
          std::max(result.certificate.handle_error, (u[v] - wanted[v]).norm());
    }
  }
  measure_region(edit.region, edit.topology, s.weights, *edit.rest, result.positions,
                 result.certificate);
  require_valid(result.certificate);
  return result;
}

void Deformer::follow(std::span<const Eigen::Affine3d> motions, SettledPose& pose,
                      const Progress& progress) const {
  std::vector<Eigen::AngleAxisd> turns;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    TurnTracker tracker = h < pose.turns.size() ? TurnTracker(pose.turns[h]) : TurnTracker();
    tracker.follow(motions[h]);
    turns.push_back(tracker.turn());
  }
  follow(motions, turns, pose, progress);
}

void Deformer::follow(std::span<const Eigen::Affine3d> motions,
                      std::span<const Eigen::AngleAxisd> turns, SettledPose& pose,
                      const Progress& progress) const {
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  if (s.settler == nullptr) {
    throw InputError("a drag can follow settled only with settling in the deform options");
  }
  const auto lock = edit.systems->lock();
  hold_for_settling();
  SettledPose next;
  next.parameters.resize(edit.column_count());
  next.turns.assign(turns.begin(), turns.end());
  edit.set_parameters(motions, next.parameters);
  next.change = next.parameters;
  const bool anew = pose.parameters.empty() || any_far(turns, pose.turns);
  if (anew) s.settler->begin_drag();
  const Positions linear = !anew            ? s.moved_on(pose, next.change)
                           : any_far(turns) ? s.turned_start->displacement(motions, turns)
                                            : s.blended_displacement(next.parameters);
  Positions u = linear;
  if (!anew && !pose.correction.empty()) {
    // What the linear response does not know changes with the motion as it did in the last frame.
    const double share = share_along(next.change, pose.change);
    for (const Index v : edit.moving) u[v] += share * pose.correction[v];
  }
  next.settled = s.settler->follow(edit.wanted_displacement(next.parameters), u, progress);
  Certificate certificate;
  certificate.all_finite =
      std::all_of(u.begin(), u.end(), [](const Vector3d& v) { return v.allFinite(); });
  require_valid(certificate);
  if (!anew) {
    next.correction = u;
    for (const Index v : edit.moving) next.correction[v] -= linear[v];
  }
  next.displacement = std::move(u);
  pose = std::move(next);
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
  return is_exact() ? systems.rsi().solver_name() : systems.laplacian().solver_name();
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

void Deformer::back_substitute(std::span<double> x) const {
  const auto lock = state_->system->systems->lock();
  hold({});
  if (is_exact()) {
    state_->system->systems->rsi().solve_in_place(x, 1);
  } else {
    state_->system->systems->laplacian().solve_in_place(x, 3);
  }
}

}  // namespace lapwing
