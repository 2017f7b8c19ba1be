#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/numbers.h"
#include "lapwing/deform/drag_state.h"
#include "lapwing/kernels/response_columns.h"

namespace lapwing {

struct EditSystem;

/// How the surface of an edit follows some of its handles linearly: a column for each of the 12
/// numbers of each. Not changed after construction, so that one thread may drag by it while another
/// settles.
class DragResponse {
 public:
  /// `numbers` as ResponseColumns has them, for each of `handles` in turn.
  DragResponse(std::shared_ptr<const EditSystem> system, std::vector<std::size_t> handles,
               Numbers numbers, bool along_axes, std::string why_not_exact = {});

  const Positions& rest() const;  ///< of the whole mesh
  const Topology& topology() const;
  ResponseColumns columns() const;
  /// Those that a drag by it may move, ascending; the others stay where its pose has them.
  const std::vector<std::size_t>& handles() const { return handles_; }

  /// The parameters of handles() among one motion per handle of the edit. Throws InputError for
  /// another number of motions. Allocates nothing.
  void set_parameters(std::span<const Eigen::Affine3d> motions, std::span<double> parameters) const;

  /// If the 3n x 3n system did not fit in memory and these columns replace its own: what it needs
  /// and what it may take, in words. Otherwise empty, also for a DragPreview's.
  const std::string& why_not_exact() const { return why_not_exact_; }

  /// A pose of this region: the surface at `positions`, of the whole mesh, for handles moved by
  /// `motions`.
  DragState pose_at(std::span<const Eigen::Vector3d> positions, HandleMotions motions) const;

 private:
  std::shared_ptr<const EditSystem> system_;
  std::vector<std::size_t> handles_;
  Numbers numbers_;
  bool along_axes_;
  std::string why_not_exact_;
};

/// Each of them once, ascending.
std::vector<std::size_t> in_order(std::span<const std::size_t> handles);

/// A drag by a response, from rest or from a pose on:
///
///     Drag drag(solver.response());
///     drag.move(motions, positions);                       // on the processor
///     surface.blend(on_device, drag.parameters(motions));  // or where it is drawn
class Drag {
 public:
  /// `pose` null is the rest shape. From another one on the surface is that pose and the linear
  /// response to what the motions have changed since, so that at its motions it is that pose.
  explicit Drag(std::shared_ptr<const DragResponse> response,
                std::shared_ptr<const DragState> pose = nullptr);

  /// By how much each column of the response counts once its handles have moved by `motions`, one
  /// per handle of the edit, each a map of space that acts on the rest position of the handle's
  /// vertices. Valid until the next call. Allocates nothing.
  std::span<const double> parameters(std::span<const Eigen::Affine3d> motions);
  /// Puts the vertices that can move where they are then; `positions` is of the whole mesh.
  /// Allocates nothing.
  void move(std::span<const Eigen::Affine3d> motions, std::span<Eigen::Vector3d> positions);

  const std::shared_ptr<const DragResponse>& response() const { return response_; }
  const std::shared_ptr<const DragState>& pose() const { return pose_; }

 private:
  std::shared_ptr<const DragResponse> response_;
  std::shared_ptr<const DragState> pose_;
  std::vector<double> of_pose_;     ///< the pose's parameters of the response's handles
  std::vector<double> parameters_;  ///< of the frame at hand
};

}  // namespace lapwing
