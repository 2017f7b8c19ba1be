// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, sections 3 and 4, in the displacement form of the project's design notes, section 2.
#include "lapwing/deform/deformer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_shares.h"
#include "lapwing/deform/pose_tangent.h"
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

// From here on the way round counts, which a linear response does not know.
constexpr double kFarTurnDegrees = 90.0;

// What a rotation is off from no scale by rounding.
constexpr double kSameScale = 1e-12;

bool is_far(const Vector3d& turn) {
  return turn.norm() > kFarTurnDegrees * std::numbers::pi / 180.0;
}

bool any_far(std::span<const Eigen::AngleAxisd> turns) {
  return std::any_of(turns.begin(), turns.end(), [](const Eigen::AngleAxisd& turn) {
    return is_far(turn.angle() * turn.axis());
  });
}

// Whether a handle has turned too far from the last frame to this one to go on from there.
bool any_far(std::span<const Eigen::AngleAxisd> turns, std::span<const Eigen::AngleAxisd> last) {
  for (std::size_t h = 0; h < last.size(); ++h) {
    const Vector3d now = turns[h].angle() * turns[h].axis();
    if (is_far(now - last[h].angle() * last[h].axis())) return true;
  }
  return false;
}

// recent = share recent + (to - from), where nothing is 0.
template <typename T>
void add_change(std::vector<T>& recent, double share, const std::vector<T>& from,
                const std::vector<T>& to) {
  const bool is_first = recent.empty();
  recent.resize(to.size());
  for (std::size_t k = 0; k < to.size(); ++k) {
    const T change = to[k] - from[k];
    recent[k] = is_first ? change : T(share * recent[k] + change);
  }
}

// What the handles made of the surface from one frame to the next. While they rest it settles,
// which says nothing of where it goes with them.
void remember_change(SettledPose& last, SettledPose& next) {
  constexpr double kShareOfOlder = 0.5;
  next.recent_parameters = std::move(last.recent_parameters);
  next.recent_displacement = std::move(last.recent_displacement);
  if (last.parameters == next.parameters) return;
  add_change(next.recent_parameters, kShareOfOlder, last.parameters, next.parameters);
  add_change(next.recent_displacement, kShareOfOlder, last.displacement, next.displacement);
}

// A result is in double precision whatever the device; and a device that is the processor in
// disguise takes about three times as long as the CPU twins (measured on lavapipe).
bool settles_on(const DeviceInfo& device) {
  return device.float64 && device.frames;
}

}  // namespace

struct Deformer::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  Kernels* kernels = nullptr;
  std::unique_ptr<PoseTangent> tangent;  ///< null without settling, as the next
  std::unique_ptr<Settler> settler;
  std::unique_ptr<HandleShares> shares;
  std::vector<double> weights;  ///< of the Laplacians that certificates measure
  std::shared_ptr<const DragResponse> response;
  std::atomic<bool> has_response = false;      ///< `response` does not change from then on
  std::shared_ptr<const DragResponse> latest;  ///< asked for last
  std::string why_not_exact;

  bool hold_response(const Progress& progress);
  void make_settler(Kernels& on);
  bool has_scale_forces() const;
  Numbers forces_of_scales(std::span<const double> q) const;
  Numbers forces_of(std::span<const double> q) const;
  std::vector<Vector3d> linear_displacement(std::span<const Vector3d> wanted,
                                            std::span<const double> forces) const;
  bool has_columns_for(std::span<const double> q) const;
  std::vector<Vector3d> displacement_by(std::span<const double> q) const;
  std::vector<double> asked_scales(std::span<const Eigen::Affine3d> motions) const;
  double share_of_recent(const SettledPose& pose, std::span<const double> change) const;
  Positions gone_on(const SettledPose& pose, std::span<const double> parameters) const;
};

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

std::vector<double> Deformer::State::asked_scales(std::span<const Eigen::Affine3d> motions) const {
  std::vector<double> scales;
  for (const Eigen::Affine3d& motion : motions) scales.push_back(scale_of(motion));
  return shares->scales(scales);
}

void Deformer::State::make_settler(Kernels& on) {
  if (!system->options.settle) return;
  const LaplacianSystem& laplacian = system->systems->laplacian_with_rings();
  tangent = std::make_unique<PoseTangent>(system->topology, system->region.roi,
                                          system->systems->pattern(), laplacian, *system->rest,
                                          system->options, *kernels);
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
  return scale_forces(*system, shares->spread(growth));
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

bool Deformer::State::has_columns_for(std::span<const double> q) const {
  if (latest == nullptr) return false;
  std::size_t covered = 0;
  for (const std::size_t h : latest->handles()) {
    const auto own = q.subspan(h * kMotionParameters, kMotionParameters);
    covered += static_cast<std::size_t>(
        std::count_if(own.begin(), own.end(), [](double number) { return number != 0.0; }));
  }
  return covered == static_cast<std::size_t>(
                        std::count_if(q.begin(), q.end(), [](double n) { return n != 0.0; }));
}

// What the handles alone make of the surface, for drags: by the columns at hand, or else by one
// right-hand side.
std::vector<Vector3d> Deformer::State::displacement_by(std::span<const double> q) const {
  std::vector<Vector3d> u(system->rest->size(), Vector3d::Zero());
  if (has_columns_for(q)) {
    if (latest->handles().size() == system->frames.size()) {
      blend_response(u, latest->columns(), q, u);
      return u;
    }
    std::vector<double> of_columns;
    for (const std::size_t h : latest->handles()) {
      const auto own = q.subspan(h * kMotionParameters, kMotionParameters);
      of_columns.insert(of_columns.end(), own.begin(), own.end());
    }
    blend_response(u, latest->columns(), of_columns, u);
    return u;
  }
  const std::vector<Vector3d> wanted = system->wanted_displacement(q);
  if (why_not_exact.empty()) {
    StageTimings untold;
    system->hold_response(*kernels, {}, untold);
    return lapwing::linear_displacement(*system, wanted, forces_of_scales(q));
  }
  return axis_displacement(*system, wanted, Springs::rest);
}

// How much of the recent change of a pose handles go through again whose parameters change by
// `change`, by the way that their vertices go.
double Deformer::State::share_of_recent(const SettledPose& pose,
                                        std::span<const double> change) const {
  if (pose.recent_parameters.empty()) return 0.0;
  const std::vector<Vector3d> now = system->wanted_displacement(change);
  const std::vector<Vector3d> recent = system->wanted_displacement(pose.recent_parameters);
  double along = 0.0;
  double square = 0.0;
  for (const auto& handle : system->region.handles) {
    for (const Index v : handle) {
      along += now[v].dot(recent[v]);
      square += recent[v].squaredNorm();
    }
  }
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
}

// Where the surface of a pose is at other parameters. As far as the handles go on as they did
// recently, so does the surface; the rest of the way is the linear response, which knows nothing of
// the pose.
Positions Deformer::State::gone_on(const SettledPose& pose,
                                   std::span<const double> parameters) const {
  // Less than all of it: what recent frames have left to settle is in their change, too.
  constexpr double kTrust = 0.75;
  std::vector<double> change(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= pose.parameters[k];
  const double share = kTrust * share_of_recent(pose, change);
  if (share == 0.0) {
    Positions u = displacement_by(change);
    for (const Index v : system->moving) u[v] += pose.displacement[v];
    return u;
  }
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= share * pose.recent_parameters[k];
  Positions u = displacement_by(change);
  for (const Index v : system->moving) {
    u[v] += pose.displacement[v] + share * pose.recent_displacement[v];
  }
  return u;
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
  State& s = *state_;
  s.system = std::move(system);
  s.kernels = &kernels;
  const EditSystem& edit = *s.system;
  s.timings = edit.timings;
  const auto lock = edit.systems->lock();
  s.hold_response(progress);
  edit.hold_laplacian();
  s.weights = edit.systems->laplacian().weights().laplacian;
  report_progress(progress, "shares", 0.0);
  Stopwatch watch;
  if (edit.options.settle || edit.options.response == LinearResponse::tangent) {
    s.shares = std::make_unique<HandleShares>(edit);
  }
  s.timings.add("shares", watch.elapsed_ms());

  watch.restart();
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
  hold_for_settling();
}

void Deformer::hold_for_settling() const {
  state_->system->hold_laplacian();
  if (state_->settler != nullptr) state_->system->systems->laplacian_with_rings();
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

const std::shared_ptr<const DragResponse>& Deformer::response(const Progress& progress) const {
  State& s = *state_;
  if (s.has_response) return s.response;
  const auto lock = s.system->systems->lock();
  if (!s.has_response) make_response(progress);
  return s.response;
}

// Under the lock.
void Deformer::make_response(const Progress& progress) const {
  State& s = *state_;
  const Stopwatch watch;
  s.response = columns_of(s.system->all_handles(), progress);
  s.timings.add("response", watch.elapsed_ms());
  s.has_response = true;
}

std::shared_ptr<const DragResponse> Deformer::response_of(std::span<const std::size_t> handles,
                                                          const Progress& progress) const {
  const auto lock = state_->system->systems->lock();
  return columns_of(in_order(handles), progress);
}

// Under the lock.
std::shared_ptr<const DragResponse> Deformer::columns_of(std::vector<std::size_t> handles,
                                                         const Progress& progress) const {
  State& s = *state_;
  hold(progress);
  report_progress(progress, "response", 0.0);
  const HandleShares* shares = s.has_scale_forces() ? s.shares.get() : nullptr;
  Numbers columns = is_exact() ? response_basis(*s.system, handles, shares, progress)
                               : axis_response(*s.system, handles);
  s.latest = std::make_shared<const DragResponse>(s.system, std::move(handles), std::move(columns),
                                                  !is_exact());
  return s.latest;
}

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
  std::vector<Vector3d> turned = s.shares->turned(motions, turns);
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
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  const auto lock = edit.systems->lock();
  hold(progress);
  std::vector<double> q(edit.column_count());
  edit.set_parameters(motions, q);
  const std::vector<Vector3d> wanted = edit.asked_displacement(q);
  const Numbers forces = s.forces_of(q);
  std::vector<Vector3d> u = s.linear_displacement(wanted, forces);
  std::vector<double> scales;
  if (s.shares != nullptr) scales = s.asked_scales(motions);

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
    }
  }
  for (const Target& target : edit.region.targets) {
    const double off = (point_of(target, result.positions) - target.position).norm();
    certificate.target_error = std::max(certificate.target_error, off);
  }
  measure_region(edit.region, edit.topology, s.weights, *edit.rest, result.positions, certificate,
                 scales);
  require_valid(certificate);
  result.asked_scales = std::move(scales);
  return result;
}

void Deformer::follow(std::span<const Eigen::Affine3d> motions, SettledPose& pose,
                      const std::function<bool()>& go_on, const Progress& progress) const {
  std::vector<Eigen::AngleAxisd> turns;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    TurnTracker tracker = h < pose.turns.size() ? TurnTracker(pose.turns[h]) : TurnTracker();
    tracker.follow(motions[h]);
    turns.push_back(tracker.turn());
  }
  follow(motions, turns, pose, go_on, progress);
}

void Deformer::follow(std::span<const Eigen::Affine3d> motions,
                      std::span<const Eigen::AngleAxisd> turns, SettledPose& pose,
                      const std::function<bool()>& go_on, const Progress& progress) const {
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  if (s.settler == nullptr) {
    throw InputError("a drag can follow settled only with settling in the deform options");
  }
  SettledPose next;
  next.parameters.resize(edit.column_count());
  next.turns.assign(turns.begin(), turns.end());
  edit.set_parameters(motions, next.parameters);
  if (pose.settled.settled && next.parameters == pose.parameters) return;
  const auto lock = edit.systems->lock();
  if (s.latest == nullptr) make_response(progress);
  hold_for_settling();
  const std::vector<Vector3d> wanted = edit.asked_displacement(next.parameters);
  const std::vector<double> scales = s.asked_scales(motions);
  const SettleTarget target{wanted, scales};
  const bool begins = pose.parameters.empty() || any_far(turns, pose.turns);
  if (begins) {
    s.settler->begin_drag();
    next.displacement = edit.region.targets.empty() ? s.displacement_by(next.parameters)
                                                    : axis_displacement(edit, wanted);
    choose_start(motions, turns, target, next.displacement);
  } else {
    next.displacement = s.gone_on(pose, next.parameters);
  }
  next.settled = s.settler->follow(target, next.displacement, go_on, progress);
  edit.loose.carry(wanted, scales, next.displacement);
  Certificate certificate;
  certificate.all_finite = std::all_of(next.displacement.begin(), next.displacement.end(),
                                       [](const Vector3d& v) { return v.allFinite(); });
  require_valid(certificate);
  if (!begins) remember_change(pose, next);
  pose = std::move(next);
}

std::vector<double> Deformer::asked_scales(std::span<const Eigen::Affine3d> motions) const {
  const State& s = *state_;
  const bool keeps_size = std::all_of(motions.begin(), motions.end(), [](const auto& motion) {
    return std::abs(scale_of(motion) - 1.0) < kSameScale;
  });
  if (keeps_size || s.shares == nullptr) return {};
  const auto lock = s.system->systems->lock();
  s.system->hold_laplacian();
  return s.asked_scales(motions);
}

void Deformer::begin_drag() const {
  if (state_->settler != nullptr) state_->settler->begin_drag();
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
