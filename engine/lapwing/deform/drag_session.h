#pragma once

#include <functional>
#include <memory>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/minimizer_result.h"

namespace lapwing {

/// Moves the surface of an edit frame by frame. In each frame, it minimizes the energy as far as
/// the time budget allows:
///
///     DragSession drag(solver);
///     drag.step(motions, budget);  // every frame
///     draw(drag.state());
///     solver->solve_from(drag.state(), motions);  // when the drag ends
///
/// A frame starts from a prediction (Predictor). If the budget does not suffice to settle, a region
/// of 6,500 vertices or more follows its coarse proxy (CoarseProxy). The class is not thread-safe.
class DragSession {
 public:
  /// Throws InputError unless the options of the solver settle.
  explicit DragSession(std::shared_ptr<const DeformSolver> solver);
  ~DragSession();
  DragSession(DragSession&&) noexcept;
  DragSession& operator=(DragSession&&) noexcept;

  /// Starts another drag at `start`, a pose of the solver's region, or at rest if `start` is empty.
  void begin(DragState start = {});

  /// Computes the next frame and minimizes it as far as `budget` allows (EnergyMinimizer::follow).
  /// A call with the same motions continues the minimization; after the surface has settled, it
  /// changes nothing. The first frame from rest starts from displacements interpolated by the
  /// handle weights. So does a frame in which a handle has turned by more than 90 degrees since the
  /// last frame. Throws InputError for invalid motions, SolverError if the surface is not finite,
  /// and Cancelled. An error leaves the state unchanged.
  const DragState& step(const HandleMotions& motions, const TimeBudget& budget = {},
                        const Progress& progress = {});
  /// Like `step` above, but accumulates the turns of the handles from frame to frame (TurnTracker).
  const DragState& step(std::span<const Eigen::Affine3d> motions, const TimeBudget& budget = {},
                        const Progress& progress = {});

  const DragState& state() const;

  /// Returns the minimizer's memory to the solver for other uses. The next frame borrows it again.
  void release_memory();

  /// Starts to build the coarse proxy on another thread. This takes a third of a second for 26,000
  /// vertices and some seconds for a million. Without this call, the build starts in the first
  /// frame that runs out of time.
  void prepare();
  /// Calls `prepare` and waits for the coarse proxy, so that no frame depends on the duration of
  /// this work. Throws Cancelled.
  void wait_until_prepared(const Progress& progress = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapwing
