// How a Deformer is dragged: by columns, linearly or settled frame by frame.
#include <algorithm>
#include <atomic>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/deformer_state.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/recent_change.h"
#include "lapwing/deform/response_basis.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

// A surface is smooth where its last step was no longer, in mean edges. A first iteration, which
// takes out what carrying left, goes 0.01 to 0.1 of them, and 0.6 where details are steep: what
// pulls on that surface would have the coarse one crumple.
constexpr double kSmoothStep = 0.05;
// What a frame takes that the coarse surface does not lead, in iterations: where it begins is a
// solve, too.
constexpr double kLeastWithoutCoarse = 2.0;
// Frames at rest in which the coarse surface may still help.
constexpr int kCoarseMovesAtRest = 20;

// What the handles made of the surface from one frame to the next. While they rest it settles,
// which says nothing of where it goes with them.
void remember_change(SettledPose& last, std::span<const Index> moving, SettledPose& next) {
  next.recent_parameters = std::move(last.recent_parameters);
  next.recent_displacement = std::move(last.recent_displacement);
  if (last.parameters == next.parameters) return;
  add_change(next.recent_parameters, last.parameters, next.parameters);
  add_change(next.recent_displacement, last.displacement, next.displacement, moving);
}

std::uint64_t next_frame() {
  static std::atomic<std::uint64_t> frames = 0;
  return ++frames;
}

}  // namespace

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

// A displacement for what moves to be written into; nothing else does.
Positions Deformer::State::unwritten() const {
  Positions u = std::exchange(spare, {});
  if (u.empty()) u.assign(system->rest->size(), Vector3d::Zero());
  return u;
}

Positions Deformer::State::still() const {
  Positions u = unwritten();
  for (const Index v : system->moving) u[v].setZero();
  return u;
}

Positions Deformer::State::moved_as(const Positions& displacement) const {
  constexpr std::size_t kMovingPerTask = 4096;
  Positions u = unwritten();
  const std::vector<Index>& moving = system->moving;
  parallel_for(moving.size(), kMovingPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) u[moving[k]] = displacement[moving[k]];
  });
  return u;
}

// What the handles alone make of the surface, for drags: by the columns at hand, or else by one
// right-hand side.
Positions Deformer::State::displacement_by(std::span<const double> q) const {
  if (has_columns_for(q)) {
    Positions u = still();
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
  if (latest != nullptr && !latest->columns().along_axes) {
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
  const auto way_of = [&](std::size_t h, Index v, std::span<const double> parameters) {
    return handle_displacement(system->frames[h],
                               parameters.subspan(h * kMotionParameters, kMotionParameters),
                               (*system->rest)[v]);
  };
  ShareOfRecent again;
  for (std::size_t h = 0; h < system->frames.size(); ++h) {
    for (const Index v : system->region.handles[h]) {
      again.add(way_of(h, v, change), way_of(h, v, pose.recent_parameters));
    }
  }
  return again.value();
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

// Begins to make one, which takes from a tenth of a second at 26,000 vertices to some seconds at a
// million. Then comes the tangent's memory, which no frame needs before the handles rest.
void Deformer::State::begin_coarse() {
  if (!system->needs_coarse_surface()) return tangent->prepare();
  coarse_aside.begin([this] {
    std::unique_ptr<CoarseDrag> made = CoarseDrag::make(*system);
    tangent->prepare();
    return made;
  });
}

// Whether there is one by now.
bool Deformer::State::find_coarse() {
  if (coarse_aside.is_made()) coarse = coarse_aside.take();
  return coarse != nullptr;
}

// Returns the displacements that the handles of `pose` asked for. Valid until the next call.
std::span<const Vector3d> Deformer::State::wanted_of(const SettledPose& pose) {
  system->asked_displacement(pose.parameters, asked_fields[1]);
  return asked_fields[1];
}

// From `pose`, whose handles asked for `wanted`, by way of the coarse surface.
void Deformer::State::take_along(const SettledPose& pose, std::span<const Vector3d> wanted,
                                 AskedOfSurface& asked, const GoOn& go_on, SettledPose& next) {
  next.displacement = moved_as(pose.displacement);
  // In the time that is left to it.
  const auto ask = [&](double ms) { return go_on(ms + ending_ms); };
  coarse->move(asked.target(), go_on ? GoOn(ask) : GoOn(), smoothing_ms, next.displacement);
  const Stopwatch ending;
  take_rotations(coarse->handle_rotations(), asked);
  place_held(pose, wanted, asked, next.displacement);
  ending_ms = ending.elapsed_ms();
}

// Belt and handles go as they are held.
void Deformer::State::place_held(const SettledPose& pose, std::span<const Vector3d> wanted,
                                 const AskedOfSurface& asked, std::span<Vector3d> u) const {
  for (const Index v : system->region.belt) u[v] = pose.displacement[v];
  for (const auto& handle : system->region.handles) {
    for (const Index v : handle) u[v] = pose.displacement[v] + ((*asked.wanted)[v] - wanted[v]);
  }
}

void Deformer::State::follow_by_coarse(const SettledPose& pose, AskedOfSurface& asked,
                                       bool is_there, const GoOn& go_on, SettledPose& next) {
  const std::span<const Vector3d> wanted = wanted_of(pose);
  if (!is_there) coarse->begin({wanted, asked.stretch.of_vertices}, pose.displacement);
  coarse_moves_at_rest = 0;
  take_along(pose, wanted, asked, go_on, next);
}

// The same without a limit of time: until the coarse surface has settled.
void Deformer::State::follow_by_coarse(const SettledPose& pose, AskedOfSurface& asked,
                                       bool is_there, const Progress& progress, SettledPose& next) {
  const std::span<const Vector3d> wanted = wanted_of(pose);
  if (!is_there) coarse->begin({wanted, asked.stretch.of_vertices}, pose.displacement);
  next.displacement = moved_as(pose.displacement);
  coarse->settle(asked.target(), progress, next.displacement);
  take_rotations(coarse->handle_rotations(), asked);
  place_held(pose, wanted, asked, next.displacement);
}

// Where the handles rest the coarse surface still finds the way, as long as the energy falls and
// the tangent does not find it sooner; false where it does not.
bool Deformer::State::go_on_at_rest(const SettledPose& pose, AskedOfSurface& asked,
                                    SettledPose& next) {
  if (coarse_moves_at_rest >= kCoarseMovesAtRest || settler->goes_by_tangent()) return false;
  ++coarse_moves_at_rest;
  const double before = settler->energy(asked.target(), pose.displacement);
  const std::span<const Vector3d> wanted = wanted_of(pose);
  take_along(pose, wanted, asked, {}, next);
  return settler->energy(asked.target(), next.displacement) < before;
}

// Settles the surface itself, as far as there is time; a frame may do without where a coarse
// surface has taken it along. Whether the surface is smooth then.
bool Deformer::State::smooth(AskedOfSurface& asked, bool at_rest, bool must, const GoOn& go_on,
                             const Progress& progress, SettledPose& next) {
  if (!must && go_on && !go_on(smoothing_ms)) {
    settler->end_rest();
    return false;
  }
  const Stopwatch watch;
  bool is_first = must;
  const auto ask = [&](double ms) { return go_on(std::exchange(is_first, false) ? 0.0 : ms); };
  const GoOn goes_on = go_on ? GoOn(ask) : GoOn();
  if (at_rest) {
    next.settled = settler->rest(asked.target(), next.displacement, goes_on, progress);
  } else {
    next.settled = settler->follow(asked.target(), next.displacement, goes_on, progress);
    smoothing_ms = watch.elapsed_ms() / std::max(next.settled.iterations, 1);
  }
  take_rotations(settler->handle_rotations(), asked);
  return next.settled.iterations > 0 && next.settled.last_step <= kSmoothStep;
}

const std::shared_ptr<const DragResponse>& Deformer::response(const Progress& progress) const {
  const ProgressScope scope(progress);
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

// Where a coarse surface leads, frames need no more than columns along axes. Where it does not, the
// response saves iterations, and is made soon. Under the lock.
void Deformer::make_columns_to_follow(const Progress& progress) const {
  State& s = *state_;
  if (response_helps_to_follow()) return make_response(progress);
  hold_for_settling();
  std::vector<std::size_t> all = s.system->all_handles();
  Numbers columns = axis_response(*s.system, all);
  s.latest =
      std::make_shared<const DragResponse>(s.system, std::move(all), std::move(columns), true);
}

std::shared_ptr<const DragResponse> Deformer::response_of(std::span<const std::size_t> handles,
                                                          const Progress& progress) const {
  const ProgressScope scope(progress);
  const auto lock = state_->system->systems->lock();
  return columns_of(in_order(handles), progress);
}

// Under the lock.
std::shared_ptr<const DragResponse> Deformer::columns_of(std::vector<std::size_t> handles,
                                                         const Progress& progress) const {
  State& s = *state_;
  hold(progress);
  report_progress(progress, "response", 0.0);
  const HandleShares* shares = s.has_scale_forces() ? &s.held_shares() : nullptr;
  Numbers columns = is_exact() ? response_basis(*s.system, handles, shares, progress)
                               : axis_response(*s.system, handles);
  s.latest = std::make_shared<const DragResponse>(s.system, std::move(handles), std::move(columns),
                                                  !is_exact());
  return s.latest;
}

HandleMotions turned_as(HandleMotions motions, const HandleMotions& pose,
                        const EditSystem& system) {
  for (std::size_t h = 0; h < motions.maps.size() && h < pose.maps.size(); ++h) {
    if (!motions.is_free_handle(h)) continue;
    const Vector3d& centroid = system.frames[h].centroid;
    const Eigen::Affine3d turned =
        turned_to(motions.maps[h], centroid, nearest_rotation(pose.maps[h].linear()));
    // Where nothing moves the same bits, though they came about by other roundings.
    constexpr double kRounding = 1e-12;
    const Vector3d place = turned * centroid;
    const double size = place.norm() + centroid.norm() + system.frames[h].radius;
    const bool is_same =
        (place - pose.maps[h] * centroid).norm() <= kRounding * size &&
        (turned.linear() - pose.maps[h].linear()).norm() <= kRounding * turned.linear().norm();
    motions.maps[h] = is_same ? pose.maps[h] : turned;
    motions.turns[h] = pose.turns[h];
  }
  return motions;
}

void Deformer::follow(std::span<const Eigen::Affine3d> motions, SettledPose& pose,
                      const GoOn& go_on, const Progress& progress) const {
  HandleMotions with_turns;
  with_turns.maps.assign(motions.begin(), motions.end());
  const std::vector<Eigen::AngleAxisd>& last = pose.motions.turns;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    TurnTracker tracker = h < last.size() ? TurnTracker(last[h]) : TurnTracker();
    tracker.follow(motions[h]);
    with_turns.turns.push_back(tracker.turn());
  }
  follow(with_turns, pose, go_on, progress);
}

void Deformer::follow(const HandleMotions& motions, SettledPose& pose, const GoOn& go_on,
                      const Progress& progress) const {
  const ProgressScope scope(progress);
  const State& s = *state_;
  const EditSystem& edit = *s.system;
  if (s.settler == nullptr) {
    throw InputError("a drag can follow settled only with settling in the deform options");
  }
  const bool begins = pose.parameters.empty() || any_far_since(pose.motions, motions);
  HandleMotions now = begins ? motions : turned_as(motions, pose.motions, edit);
  SettledPose next;
  next.parameters.resize(edit.column_count());
  edit.set_parameters(now.maps, next.parameters);
  const bool at_rest = next.parameters == pose.parameters;
  if (pose.settled.settled && at_rest) return;
  const auto lock = edit.systems->lock();
  if (s.latest == nullptr) make_columns_to_follow(progress);
  hold_for_settling();
  AskedOfSurface asked = s.asked_of(std::move(now), s.asked_fields[0]);
  const std::vector<double> scales = mean_scales(asked.stretch.of_vertices);
  State& on = *state_;
  if (begins || (at_rest && pose.settled.settled)) on.lacks_time = false;
  const bool coarse_was_there =
      std::exchange(on.coarse_is_there, false) && pose.frame == s.last_frame;
  bool by_coarse = false;
  if (begins) {
    s.settler->begin_drag();
    next.displacement = edit.region.targets.empty() ? s.displacement_by(next.parameters)
                                                    : axis_displacement(edit, *asked.wanted);
    Positions turned = turned_start(asked.motions, asked.stretch);
    if (any_far(asked.motions.turns) || s.settler->energy(asked.target(), turned) <
                                            s.settler->energy(asked.target(), next.displacement)) {
      next.displacement = std::move(turned);
    }
  } else if (at_rest) {
    by_coarse = coarse_was_there && on.go_on_at_rest(pose, asked, next);
    if (!by_coarse) next.displacement = s.moved_as(pose.displacement);
  } else {
    by_coarse =
        go_on && (s.lacks_time || !go_on(kLeastWithoutCoarse * s.smoothing_ms)) && on.find_coarse();
    if (by_coarse) {
      on.follow_by_coarse(pose, asked, coarse_was_there, go_on, next);
    } else {
      next.displacement = s.gone_on(pose, next.parameters);
    }
  }
  // While the coarse surface is being made, frames that lack time go on as they can without.
  const bool must = at_rest || (!by_coarse && !(go_on && on.coarse_aside.is_at_work()));
  const bool is_smooth = on.smooth(asked, at_rest, must, go_on, progress, next);
  if (!begins && !at_rest && !next.settled.settled && !std::exchange(on.lacks_time, true)) {
    on.begin_coarse();
  }
  // What pulls on the surface before it is smooth tells the coarse one nothing.
  if (is_smooth && by_coarse) {
    on.pull.resize(next.displacement.size(), Vector3d::Zero());
    s.settler->gradient(on.pull);
    on.coarse->learn(next.displacement, on.pull);
  }
  const Stopwatch ending;
  next.motions = std::move(asked.motions);
  next.parameters = std::move(asked.parameters);
  edit.loose.carry(*asked.wanted, scales, next.displacement);
  Certificate certificate;
  certificate.all_finite = std::all_of(edit.moving.begin(), edit.moving.end(),
                                       [&](Index v) { return next.displacement[v].allFinite(); });
  require_valid(certificate);
  if (!begins && !by_coarse) remember_change(pose, edit.moving, next);
  // Of any other pose it is not known that nothing else has moved.
  if (pose.frame != 0 && pose.frame == s.last_frame) s.spare = std::move(pose.displacement);
  next.frame = on.last_frame = next_frame();
  on.coarse_is_there = by_coarse;
  pose = std::move(next);
  if (by_coarse) on.ending_ms += ending.elapsed_ms();
}

bool Deformer::response_helps_to_follow() const {
  return state_->settler != nullptr && !state_->system->needs_coarse_surface();
}

void Deformer::begin_to_follow() const {
  if (state_->system->needs_coarse_surface()) state_->begin_coarse();
}

void Deformer::prepare_to_follow(const Progress& progress) const {
  const ProgressScope scope(progress);
  State& s = *state_;
  begin_to_follow();
  {
    const auto lock = s.system->systems->lock();
    if (s.settler != nullptr && s.latest == nullptr) make_columns_to_follow(progress);
  }
  wait_for_coarse(progress);
}

void Deformer::wait_for_coarse(const Progress& progress) const {
  State& s = *state_;
  begin_to_follow();
  report_progress(progress, "coarse surface", 0.0);
  if (s.coarse_aside.is_at_work()) s.coarse = s.coarse_aside.take();
  report_progress(progress, "coarse surface", 1.0);
}

void Deformer::begin_drag() const {
  state_->coarse_is_there = false;
  state_->lacks_time = false;
  if (state_->settler != nullptr) state_->settler->begin_drag();
}

}  // namespace lapwing
