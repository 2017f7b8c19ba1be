#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lapwing/deform/drag.h"
#include "work/job.h"
#include "work/preparation.h"

namespace lapwing::viewer {

/// Where a frame of a drag shows the surface of an edit.
struct DraggedFrame {
  std::shared_ptr<const DragResponse> response;
  std::shared_ptr<const DragState> pose;    ///< what it goes on from; null: the rest shape
  std::vector<Eigen::Affine3d> motions;     ///< one per handle of the edit

  bool is_same_as(const DraggedFrame& other) const;
};

/// Finds beside the window where the carried objects of a state go as its surface is dragged
/// (CarryContacts). One frame at a time: while one is under way others are passed over, so that
/// what is shown is at most that much behind the surface.
///
/// All members are called from one thread, the window's, and return at once, but for the
/// destructor, which waits for the end of an object.
class CarryFollower {
 public:
  /// `wake` is called on the worker when a frame is done.
  explicit CarryFollower(std::function<void()> wake = {});

  /// Asks for the objects of `state` in `frame`, a drag by what `preparation` has made ready,
  /// unless that is what was asked for last or something is under way.
  void follow(const AppState& state, const Preparation& preparation, const DraggedFrame& frame);
  /// Where they are in the frame that was done last, in the order of AppState::carried; once, and
  /// nothing before it is done. Throws, once, what finding it threw.
  std::optional<std::vector<Positions>> take() { return job_.take(); }
  /// Gives up what is under way or was not taken.
  void cancel();

 private:
  DraggedFrame asked_;
  Job<std::vector<Positions>> job_;
};

}  // namespace lapwing::viewer
