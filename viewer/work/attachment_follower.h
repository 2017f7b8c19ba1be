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
  std::shared_ptr<const DragState> pose;  ///< where it starts; null for the rest shape
  std::vector<Eigen::Affine3d> motions;   ///< one per handle of the edit

  bool is_same_as(const DraggedFrame& other) const;
};

/// Computes the positions of carried objects during a drag on a background thread
/// (AttachmentCache). Computes one frame at a time and skips the frames that arrive meanwhile. Call
/// all members from the window's thread. They return at once, except the destructor, which waits
/// until the current object is done.
class AttachmentFollower {
 public:
  /// `wake` is called on the worker when a frame is done.
  explicit AttachmentFollower(std::function<void()> wake = {});

  /// Requests the positions of the objects of `state` in `frame`. Does nothing if the last request
  /// was the same, or if a frame is under way.
  void follow(const AppState& state, const Preparation& preparation, const DraggedFrame& frame);
  /// Returns the computed positions once, in the order of AppState::carried. Returns nullopt until
  /// they are computed. Throws the exception of the computation, once.
  std::optional<std::vector<Positions>> take() { return job_.take(); }
  /// Cancels the frame under way and drops one that was not taken.
  void cancel();

 private:
  DraggedFrame asked_;
  Job<std::vector<Positions>> job_;
};

}  // namespace lapwing::viewer
