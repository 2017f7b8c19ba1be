#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/numbers.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/minimizer_result.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

struct EditSystem;

/// A pose of a surface during or after a drag. At rest, the state is empty.
struct DragState {
  /// The handles' motions. For a handle with free orientation, this includes the rotation that the
  /// minimization has found.
  HandleMotions motions;
  Positions displacement;       ///< from the rest pose, per vertex of the mesh
  MinimizerResult last_result;  ///< of the last frame's minimization

  bool empty() const { return motions.maps.empty(); }
};

/// The linear response of a surface to some of its handles: one column for each of the 12
/// parameters of a handle. Immutable, so one thread may drag with it while another settles.
class DragResponse {
 public:
  /// `numbers` contains the columns of each of `handles` in turn, in the layout of ResponseColumns.
  DragResponse(std::shared_ptr<const EditSystem> system, std::vector<std::size_t> handles,
               Numbers numbers, bool along_axes, std::string why_not_exact = {});

  const Positions& rest() const;  ///< rest positions of the whole mesh
  const Topology& topology() const;
  ResponseColumns columns() const;
  /// The handles that a drag may move, ascending. All other handles remain as in the drag's pose.
  const std::vector<std::size_t>& handles() const { return handles_; }

  /// Sets the parameters of handles() from `motions`, which has one map per handle of the edit.
  /// Throws InputError if the number of motions is wrong. Does not allocate memory.
  void set_parameters(std::span<const Eigen::Affine3d> motions, std::span<double> parameters) const;

  /// If the 3n x 3n system exceeded the memory limit, this message states the required and the
  /// allowed memory. The columns are then those of the n x n system. Otherwise the message is
  /// empty, also for a DragPreview.
  const std::string& why_not_exact() const { return why_not_exact_; }

  /// Returns the pose of this region if the whole mesh has `positions` and the handles have moved
  /// by `motions`.
  DragState pose_at(std::span<const Eigen::Vector3d> positions, HandleMotions motions) const;

 private:
  std::shared_ptr<const EditSystem> system_;
  std::vector<std::size_t> handles_;
  Numbers numbers_;
  bool along_axes_;
  std::string why_not_exact_;
};

/// Returns the distinct `handles` in ascending order.
std::vector<std::size_t> in_order(std::span<const std::size_t> handles);

/// A linear drag from rest or from a pose:
///
///     Drag drag(solver.response());
///     drag.move(motions, positions);                       // on the CPU
///     surface.blend(on_device, drag.parameters(motions));  // or where it is drawn
class Drag {
 public:
  /// Starts at `pose`, or at rest if `pose` is null. The surface is the pose plus the linear
  /// response to the handles' motion since that pose.
  explicit Drag(std::shared_ptr<const DragResponse> response,
                std::shared_ptr<const DragState> pose = nullptr);

  /// Returns the coefficient of each column for `motions`, which has one map from the rest position
  /// per handle of the edit. The returned span is valid until the next call. Does not allocate
  /// memory.
  std::span<const double> parameters(std::span<const Eigen::Affine3d> motions);
  /// Writes the new positions of the vertices that can move to `positions`, which has one entry per
  /// vertex of the mesh. Does not allocate memory.
  void move(std::span<const Eigen::Affine3d> motions, std::span<Eigen::Vector3d> positions);

  const std::shared_ptr<const DragResponse>& response() const { return response_; }
  const std::shared_ptr<const DragState>& pose() const { return pose_; }

 private:
  std::shared_ptr<const DragResponse> response_;
  std::shared_ptr<const DragState> pose_;
  std::vector<double> of_pose_;     ///< parameters of the response's handles at the pose
  std::vector<double> parameters_;  ///< parameters of the current frame, relative to the pose
};

}  // namespace lapwing
