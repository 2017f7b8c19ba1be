#include "lapwing/deform/drag_session.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/coarse_proxy.h"
#include "lapwing/deform/deform_solver_state.h"
#include "lapwing/deform/linear_response.h"
#include "lapwing/deform/motion_target.h"
#include "lapwing/deform/predictor.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/elastic/background_task.h"

namespace lapwing {

using Eigen::Vector3d;

struct DragSession::State {
  std::shared_ptr<const DeformSolver> solver;
  const DeformSolverState& of_solver;
  const EditSystem& edit = *of_solver.edit;
  std::shared_ptr<MinimizerWorkspace> workspace;  // null while it is lent to the solver

  DragState pose;
  std::vector<double> parameters;        // parameters of pose.motions
  std::vector<Vector3d> prescribed;      // displacements prescribed by pose.motions
  std::vector<Eigen::Matrix3d> stretch;  // S_i of pose.motions; empty for the identity
  Positions next;  // the displacement in the current frame; memory is reused between frames
  std::vector<Vector3d> next_prescribed;  // for `next`; memory is reused between frames

  Predictor predictor;
  // Null until it is built, and if the region does not need a proxy.
  std::unique_ptr<CoarseProxy> coarse;
  bool coarse_is_at_pose = false;
  bool lacks_time = false;     // true if a frame of this drag ran out of time
  double iteration_ms = 0.0;   // time of one iteration on the fine surface
  double ending_ms = 0.0;      // time for the work after the iterations of a frame
  std::vector<Vector3d> pull;  // half of the energy gradient of the fine surface
  // Last member, because it uses the solver.
  BackgroundTask<std::unique_ptr<CoarseProxy>> coarse_task;

  State(std::shared_ptr<const DeformSolver> of, const DeformSolverState& internals)
      : solver(std::move(of)), of_solver(internals) {}
  ~State() {
    if (workspace != nullptr) of_solver.give_back(std::move(workspace));
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  EnergyMinimizer& minimizer() {
    if (workspace == nullptr) {
      workspace = of_solver.take_workspace();
      workspace->minimizer.begin_drag();
    }
    return workspace->minimizer;
  }

  void copy_to_next(const Positions& displacement) {
    constexpr std::size_t kVerticesPerTask = 4096;
    if (next.empty()) next.assign(edit.rest->size(), Vector3d::Zero());
    const std::vector<Index>& moving = edit.moving;
    parallel_for(moving.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) next[moving[k]] = displacement[moving[k]];
    });
  }

  // Computes `next` with the coarse proxy, within the budget.
  void step_by_proxy(MotionTarget& target, bool is_at_pose, const TimeBudget& budget) {
    if (!is_at_pose) coarse->begin({prescribed, stretch}, pose.displacement);
    copy_to_next(pose.displacement);
    const auto ask = [&](double ms) { return budget(ms + ending_ms); };
    coarse->step(target.settle_target(), budget ? TimeBudget(ask) : TimeBudget(), iteration_ms,
                 next);
    const Stopwatch ending;
    set_free_rotations(edit, coarse->handle_rotations(), target);
    move_held(edit, prescribed, target.prescribed, pose.displacement, next);
    ending_ms = ending.elapsed_ms();
  }

  // Moves the surface with the proxy while the handles rest. Does nothing if the minimizer uses the
  // Hessian, which finds the minimum sooner. Returns true if the energy of `next` is lower than
  // that of the pose.
  bool carry_at_rest(MotionTarget& target, bool is_at_pose) {
    if (!is_at_pose || minimizer().uses_hessian()) return false;
    const double before = minimizer().energy(target.settle_target(), pose.displacement);
    step_by_proxy(target, is_at_pose, {});
    return minimizer().energy(target.settle_target(), next) < before;
  }

  // Minimizes `next` as far as the budget allows. If `must` is true, runs at least one iteration.
  MinimizerResult minimize(MotionTarget& target, bool at_rest, bool must, const TimeBudget& budget,
                           const Progress& progress) {
    if (!must && budget && !budget(iteration_ms)) {
      minimizer().end_rest();
      return {};
    }
    const Stopwatch watch;
    bool is_first = must;
    const auto ask = [&](double ms) { return budget(std::exchange(is_first, false) ? 0.0 : ms); };
    const TimeBudget goes_on = budget ? TimeBudget(ask) : TimeBudget();
    MinimizerResult result;
    if (at_rest) {
      result = minimizer().follow_at_rest(target.settle_target(), next, goes_on, progress);
    } else {
      result = minimizer().follow(target.settle_target(), next, goes_on, progress);
      iteration_ms = watch.elapsed_ms() / std::max(result.iterations, 1);
    }
    set_free_rotations(edit, minimizer().handle_rotations(), target);
    return result;
  }

  // Passes the remaining gradient of the fine surface to the proxy if the fine surface is smooth.
  // The gradient of a rough surface would crumple the proxy.
  void correct_coarse(const MinimizerResult& result) {
    if (result.iterations == 0 || result.last_step > kLongStep) return;
    pull.resize(next.size(), Vector3d::Zero());
    minimizer().gradient(pull);
    coarse->correct(next, pull);
  }

  void accept(MotionTarget target, const MinimizerResult& result, bool tells_of_motion) {
    if (tells_of_motion) {
      predictor.add_frame(edit, prescribed, target.prescribed, pose.displacement, next);
    }
    std::swap(pose.displacement, next);
    pose.motions = std::move(target.motions);
    pose.last_result = result;
    parameters = std::move(target.parameters);
    stretch = std::move(target.stretch.of_vertices);
    next_prescribed = std::exchange(prescribed, std::move(target.prescribed));
  }
};

DragSession::DragSession(std::shared_ptr<const DeformSolver> solver) {
  const DeformSolverState& internals = *solver->state_;
  if (!internals.edit->options.settle) {
    throw InputError("a drag session requires settling; set \"settle\" in the deform options");
  }
  state_ = std::make_unique<State>(std::move(solver), internals);
}

DragSession::~DragSession() = default;
DragSession::DragSession(DragSession&&) noexcept = default;
DragSession& DragSession::operator=(DragSession&&) noexcept = default;

void DragSession::begin(DragState start) {
  State& s = *state_;
  s.pose = std::move(start);
  s.parameters.clear();
  s.predictor.clear();
  if (!s.pose.empty()) {
    // The pose of another region may displace vertices that do not move here.
    Positions own(s.edit.rest->size(), Vector3d::Zero());
    for (const Index v : s.edit.moving) own[v] = s.pose.displacement[v];
    s.pose.displacement = std::move(own);
    s.parameters.resize(s.edit.column_count());
    s.edit.set_parameters(s.pose.motions.maps, s.parameters);
    s.prescribed = s.edit.prescribed_displacement(s.parameters, std::move(s.prescribed));
    s.stretch = rest_stretch(s.edit, s.pose.motions.maps).of_vertices;
  }
  s.coarse_is_at_pose = false;
  s.lacks_time = false;
  if (s.workspace != nullptr) s.workspace->minimizer.begin_drag();
}

const DragState& DragSession::step(std::span<const Eigen::Affine3d> motions,
                                   const TimeBudget& budget, const Progress& progress) {
  return step(followed(state_->pose.motions, motions), budget, progress);
}

const DragState& DragSession::step(const HandleMotions& motions, const TimeBudget& budget,
                                   const Progress& progress) {
  const ProgressScope scope(progress);
  State& s = *state_;
  const EditSystem& edit = s.edit;
  const bool begins = s.pose.empty() || any_turned_far_since(s.pose.motions, motions);
  MotionTarget target =
      motion_target(edit, begins ? motions : turned_as(motions, s.pose.motions, edit),
                    std::move(s.next_prescribed));
  const bool at_rest = !begins && target.parameters == s.parameters;
  if (at_rest && s.pose.last_result.settled) {
    s.next_prescribed = std::move(target.prescribed);
    return s.pose;
  }

  // If this frame throws, the proxy is not at the pose of the session.
  const bool coarse_was_there = std::exchange(s.coarse_is_at_pose, false);
  bool by_coarse = false;
  if (begins) {
    s.minimizer().begin_drag();
    s.predictor.clear();
    s.lacks_time = false;
    s.copy_to_next(start_by_handle_weights(edit, *s.of_solver.weights, target));
  } else if (at_rest) {
    by_coarse = s.carry_at_rest(target, coarse_was_there);
    if (!by_coarse) s.copy_to_next(s.pose.displacement);
  } else {
    if (s.coarse_task.is_made()) s.coarse = s.coarse_task.take();
    const bool is_short = budget && (s.lacks_time || !budget(s.iteration_ms));
    by_coarse = is_short && s.coarse != nullptr;
    if (by_coarse) {
      s.step_by_proxy(target, coarse_was_there, budget);
    } else {
      s.next = s.predictor.predict(edit, s.prescribed, target.prescribed, s.pose.displacement);
    }
  }
  // While the proxy is being built, frames that have no time left only predict.
  const bool must = at_rest || !(by_coarse || (budget && s.coarse_task.is_pending()));
  const MinimizerResult result = s.minimize(target, at_rest, must, budget, progress);
  if (!begins && !at_rest && !result.settled && !std::exchange(s.lacks_time, true)) prepare();
  if (by_coarse) s.correct_coarse(result);

  const Stopwatch ending;
  edit.loose.carry(target.prescribed, mean_scales(target.stretch.of_vertices), s.next);
  Certificate certificate;
  certificate.all_finite =
      std::ranges::all_of(edit.moving, [&](Index v) { return s.next[v].allFinite(); });
  require_valid(certificate);
  s.accept(std::move(target), result, !begins && !at_rest && !by_coarse);
  s.coarse_is_at_pose = by_coarse;
  if (by_coarse) s.ending_ms += ending.elapsed_ms();
  return s.pose;
}

const DragState& DragSession::state() const {
  return state_->pose;
}

void DragSession::release_memory() {
  if (state_->workspace != nullptr) state_->of_solver.give_back(std::move(state_->workspace));
}

void DragSession::prepare() {
  State& s = *state_;
  s.minimizer();
  if (!s.edit.needs_coarse_surface()) return s.workspace->hessian.prepare();
  s.coarse_task.begin([&edit = s.edit, workspace = s.workspace] {
    std::unique_ptr<CoarseProxy> made = CoarseProxy::make(edit);
    workspace->hessian.prepare();
    return made;
  });
}

void DragSession::wait_until_prepared(const Progress& progress) {
  const ProgressScope scope(progress);
  State& s = *state_;
  prepare();
  report_progress(progress, "coarse surface", 0.0);
  if (s.coarse_task.is_pending()) s.coarse = s.coarse_task.take();
  report_progress(progress, "coarse surface", 1.0);
}

}  // namespace lapwing
