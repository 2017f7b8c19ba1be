#include "editing/live_drag.h"

#include <algorithm>
#include <utility>

#include "lapwing/deform/handle_motion.h"

namespace lapwing::viewer {
namespace {

// How far a linear response may go beyond the settled pose: an angle in radians, a distance as a
// share of the ROI's diagonal, and a stretch.
constexpr double kLargestLeadTurn = 0.35;
constexpr double kLongestLead = 0.1;
constexpr double kLargestLeadStretch = 0.3;

}  // namespace

void LiveDrag::begin(bool is_of_last_step) {
  is_of_last_step_ = is_of_last_step;
  view_.shown().end_preview();
  view_.shown().show_before(false);
  view_.point_at({});
  // The result that is being computed is outdated, and it delays the exact response.
  session_.cancel_settling();
  live_.reset();
  dragged_from_ = view_.shown().pose();
}

void LiveDrag::give_up() {
  if (!needs_settling(state())) return;
  view_.shown().follow_from(dragged_from_);
  session_.prepare(dragged_from_);
}

void LiveDrag::hold_pose() {
  if (!view_.shown().has_triangles_of_state() || view_.shown().pose()) return;
  if (auto pose = session_.pose()) view_.shown().follow_from(std::move(pose));
}

void LiveDrag::take_state() {
  const AppState& now = state();
  Positions roi;
  for (const Index v : now.selection.roi.vertices) roi.push_back(now.rest->positions[v]);
  longest_lead_ = kLongestLead * bounds_of(roi).diagonal();
  if (needs_settling(now) && view_.shown().has_triangles_of_state()) return;
  view_.shown().show_still();
  live_.reset();
}

void LiveDrag::update() {
  const GizmoTool& gizmo = active_.tools().gizmo;
  const std::size_t handle = active_.handle();
  ShownSurface& shown = view_.shown();
  const bool dragging = gizmo.is_dragging();
  // The drag starts from the rest pose if the surface shows no pose and has not settled.
  const bool from_rest = shown.pose() == nullptr && needs_settling(state());
  dragged_handles(state(), handle, from_rest, dragged_);
  session_.drag_by(dragged_);
  if (shown.shows_before() || shown.previews()) return;
  if (!dragging && !needs_settling(state())) {
    if (shown.follows()) {  // the drag was given up
      session_.cancel_settling();
      view_.take_state();
      take_state();
    }
    return;
  }
  if (dragging) hold_pose();
  if (dragging && settles()) settle();
  maps_of(state(), handle, dragging ? *gizmo.move() : state().moves[handle].move, motions_);
  turn_free_handles();
  if (settles()) limit_lead();
  shown.follow(session_.preparation(), motions_);
}

Eigen::Affine3d LiveDrag::pose_map(std::size_t handle) const {
  const std::shared_ptr<const DragState>& pose = view_.shown().pose();
  const bool has_one = pose && handle < pose->motions.maps.size();
  return has_one ? pose->motions.maps[handle] : Eigen::Affine3d::Identity();
}

Eigen::Vector3d LiveDrag::centroid_of(std::size_t handle) const {
  return state().mirrored ? state().mirrored->centroids[handle] : handle_centroid(state(), handle);
}

// Shows handles with free orientation rotated as in the settled pose.
void LiveDrag::turn_free_handles() {
  if (!view_.shown().pose()) return;
  const GizmoTool& gizmo = active_.tools().gizmo;
  const std::vector<std::size_t>* images =
      state().mirrored ? &state().mirrored->handle_images : nullptr;
  for (std::size_t h = 0; h < motions_.size(); ++h) {
    const std::size_t of = h < state().moves.size() ? h : (*images)[h];
    const bool is_dragged = gizmo.is_dragging() && of == active_.handle();
    const HandleOrientation orientation =
        is_dragged ? gizmo.orientation() : state().moves[of].orientation;
    if (orientation == HandleOrientation::kept) continue;
    motions_[h] =
        turned_to(motions_[h], centroid_of(h), shortest_turn(pose_map(h)).toRotationMatrix());
  }
}

// A linear response shears and swells the surface under large rotations and translations. Until a
// settled pose is ready, the surface follows the mouse only up to a limit.
void LiveDrag::limit_lead() {
  double share = 1.0;
  const auto keep = [&share](double amount, double most) {
    if (amount * share > most) share = most / amount;
  };
  for (std::size_t h = 0; h < motions_.size(); ++h) {
    const Eigen::Affine3d lead = motions_[h] * pose_map(h).inverse();
    const Eigen::AngleAxisd turn = shortest_turn(lead);
    const Eigen::Vector3d from = pose_map(h) * centroid_of(h);
    const Eigen::Matrix3d stretch = turn.toRotationMatrix().transpose() * lead.linear();
    keep(std::abs(turn.angle()), kLargestLeadTurn);
    keep((lead * from - from).norm(), longest_lead_);
    keep((stretch - Eigen::Matrix3d::Identity()).norm(), kLargestLeadStretch);
  }
  if (share == 1.0) return;
  for (std::size_t h = 0; h < motions_.size(); ++h) {
    const Eigen::Affine3d lead = motions_[h] * pose_map(h).inverse();
    const Eigen::Vector3d from = pose_map(h) * centroid_of(h);
    motions_[h] = partial_motion(lead, shortest_turn(lead), from, share) * pose_map(h);
  }
}

// Takes the settled pose of the drag. Requests another if the mouse has moved on or the surface has
// not settled completely.
void LiveDrag::settle() {
  const GizmoTool& gizmo = active_.tools().gizmo;
  moves_.assign(state().moves.begin(), state().moves.end());
  HandleMove& dragged = moves_[active_.handle()];
  dragged.move = *gizmo.move();
  dragged.orientation = gizmo.orientation();
  const std::span<const Move> path = gizmo.waypoints();
  dragged.path.assign(path.begin(), path.end());
  if (auto result = session_.take_live_result()) {
    view_.shown().follow_from(result->pose);
    live_ = std::move(result);
  }
  if (resting_moves_ && *resting_moves_ != moves_) {
    // The worker may be factorizing, and the drag must not wait for that.
    session_.cancel_settling();
    resting_moves_.reset();
  }
  const bool is_there = live_ ? live_->is_done && live_->moves == moves_
                              : !needs_settling(state()) && state().moves == moves_;
  if (is_there) return;
  const bool rests = live_ && live_->moves == moves_;
  session_.settle_live(moves_, view_.shown().pose(), rests);
  if (rests) resting_moves_ = moves_;
}

bool LiveDrag::shows_live_result() const {
  return live_ && view_.shown().follows() && view_.shown().pose() == live_->pose;
}

Bounds LiveDrag::united_with(Bounds bounds) const {
  if (live_ && live_->pose) bounds = united(bounds, live_->bounds);
  const auto& followed = view_.shown().followed();
  const auto& handles = state().selection.handles;
  for (std::size_t h = 0; h < std::min(followed.size(), handles.size()); ++h) {
    for (const Index v : handles[h].vertices) {
      const Eigen::Vector3d place = followed[h] * state().rest->positions[v];
      bounds = united(bounds, {place, place});
    }
  }
  return bounds;
}

}  // namespace lapwing::viewer
