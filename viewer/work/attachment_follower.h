#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lapwing/deform/drag.h"
#include "work/job.h"
#include "work/preparation.h"

namespace lapwing::viewer {

/// The surface of an edit in a frame of a drag.
struct DraggedFrame {
  std::shared_ptr<const DragResponse> response;
  std::shared_ptr<const DragState> pose;  ///< pose before the frame; null for the rest shape
  std::vector<Eigen::Affine3d> motions;   ///< one per handle of the edit

  bool is_same_as(const DraggedFrame& other) const;
};

/// Computes the positions of carried objects during a drag on a background thread, with an
/// AttachmentCache. Computes one frame at a time and ignores requests during a computation. Call
/// all members from the window's thread. They do not block, except the destructor, which waits
/// until the current object is finished.
class AttachmentFollower {
 public:
  /// `wake` is called on the worker when a frame is done.
  explicit AttachmentFollower(std::function<void()> wake = {});

  /// Requests the positions of the carried objects of `state` in `frame`. Does nothing if `frame`
  /// equals the last request, or if another frame is still being computed.
  void follow(const AppState& state, const Preparation& preparation, const DraggedFrame& frame);
  /// Returns the positions for the requested frame, in the order of AppState::carried. Returns them
  /// once; before and after that, returns nullopt. If the computation has thrown an exception,
  /// rethrows it once.
  std::optional<std::vector<Positions>> take() { return job_.take(); }
  /// Cancels the current computation and discards positions that were not taken.
  void cancel();

 private:
  DraggedFrame asked_;
  Job<std::vector<Positions>> job_;
};

}  // namespace lapwing::viewer
