#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/coarse_proxy.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/drag_frame.h"

namespace lapwing {

/// A drag whose frames are computed by CpuDragFrame or VulkanDragFrame. This class minimizes only
/// the coarse proxy; its motions and the prescribed displacements are the input of a frame:
///
///     auto drag = ProxyDrag::make(solver);
///     frame.begin(drag->begin(pose));
///     frame.step(*drag->step(motions));                            // every frame
///     solver->solve_from(drag->pose(frame.displacement()), motions);  // when the drag ends
///
/// A step costs a few milliseconds for every size of the region. Unlike in a DragSession, the fine
/// surface exerts no force on the proxy, so both minima differ by some tenths of a percent of the
/// diagonal. Not thread-safe.
class ProxyDrag {
 public:
  /// Returns null if the edit needs a DragSession: it is small or cannot be decimated, or it has
  /// targets, springs or loose parts. Throws InputError unless the options of the solver settle.
  static std::unique_ptr<ProxyDrag> make(std::shared_ptr<const DeformSolver> solver);

  const std::shared_ptr<const DragFrameProblem>& problem() const { return problem_; }

  /// Starts a drag at a pose of the solver's region, or at rest if `start` is empty. Returns the
  /// displacements of DragFrameProblem::vertices.
  std::vector<Eigen::Vector3d> begin(const DragState& start);

  /// Minimizes the proxy for the next motions. Returns the input of the frame, which is valid until
  /// the next call. Returns null, without any change, if the frame needs a DragSession: a handle
  /// scales, its orientation is free, or it has turned by more than 90 degrees since the last
  /// frame. Throws InputError for invalid motions.
  const DragFrameInput* step(const HandleMotions& motions);

  /// Returns the state of the drag with these displacements of DragFrameProblem::vertices.
  DragState pose(std::span<const Eigen::Vector3d> displacement) const;

 private:
  ProxyDrag(std::shared_ptr<const DeformSolver> solver, const EditSystem& edit,
            std::unique_ptr<CoarseProxy> proxy);
  DragFrameProblem make_problem();

  std::shared_ptr<const DeformSolver> solver_;
  const EditSystem& edit_;
  std::unique_ptr<CoarseProxy> proxy_;
  std::vector<Index> prescribed_vertices_;  ///< of the mesh, per entry of DragFrameInput
  std::shared_ptr<const DragFrameProblem> problem_;
  HandleMotions motions_;
  std::vector<Eigen::Vector3d> prescribed_;       ///< per vertex of the mesh, at `motions_`
  std::vector<Eigen::Vector3d> next_prescribed_;  ///< memory that is reused between frames
  Positions displacement_;                        ///< per vertex of the mesh, at the start
  DragFrameInput input_;
};

}  // namespace lapwing
