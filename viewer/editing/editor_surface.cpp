// What an editor shows: the surface and its colours.

#include <algorithm>
#include <utility>

#include "editing/editor.h"
#include "lapwing/deform/handle_motion.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

// How far a linear response may go beyond the settled pose: an angle in radians, a distance as a
// share of the ROI's diagonal, and a stretch.
constexpr double kLargestLeadTurn = 0.35;
constexpr double kLongestLead = 0.1;
constexpr double kLargestLeadStretch = 0.3;

}  // namespace

// A result must not reset the tools of a user who already chooses elsewhere.
void Editor::state_changed(bool by_result) {
  const AppState& now = state();
  if (part_.role == Part::Role::handle) part_.handle = std::min(part_.handle, handle_count());
  handle_ = handle_count() == 0 ? 0 : std::min(handle_, handle_count() - 1);
  const bool goes_on =
      by_result && (is_dragging() || !postponed_.empty() || !tools_.loop.corners().empty());
  if (shown_.take(now) && !goes_on) {
    tools_.disk.reset();
    tools_.loop.reset();
  }
  moves_as_a_whole_ = viewer::moves_as_a_whole(now);
  warnings_.clear();
  if (const Certificate* certificate = session_->certificate()) {
    warnings_ = warnings_of(*certificate, surface_of(now)->topology());
  }
  Positions roi;
  for (const Index v : now.selection.roi.vertices) roi.push_back(now.rest->positions[v]);
  longest_lead_ = kLongestLead * bounds_of(roi).diagonal();
  classes_are_old_ = true;
  if (!needs_settling(now) || !shown_.has_triangles_of_state()) {
    shown_.show_still();
    live_.reset();
  }
  show_carried();
}

void Editor::show_carried() {
  using Where = ShownCarried::Where;
  attachment_follower_.cancel();
  carried_.take(state(), shown_.shows_before()     ? Where::opened
                         : needs_settling(state()) ? Where::dragged
                                                   : Where::still);
}

// Moves carried objects to the shown surface once their places are computed.
void Editor::follow_carried() {
  if (!shown_.follows() || !any_follows(state().carried)) return;
  say_errors(say_, [&] {
    if (const auto places = attachment_follower_.take()) carried_.place(*places);
  });
  const Drag& drag = *shown_.device().drag_shown();
  attachment_follower_.follow(state(), session_->preparation(),
                              {drag.response(), drag.pose(), shown_.followed()});
}

bool Editor::shows_live_result() const {
  return live_ && shown_.follows() && shown_.pose() == live_->pose;
}

void Editor::show_before(bool before) {
  if (is_dragging() || before == shown_.shows_before()) return;
  shown_.show_before(before);
  state_changed();
}

void Editor::set_feature_angle(double degrees) {
  if (is_dragging() || degrees == shown_.feature_angle()) return;
  shown_.set_feature_angle(degrees);
  state_changed();
}

void Editor::update() {
  if (session_->take_result()) state_changed(true);
  if (!is_dragging()) run_postponed();
  // A step must not change the surface under a stroke.
  if (!is_dragging()) take_step();
  follow_hand();
  follow_carried();
  if (tools_.ruler.is_begun() && shown_.has_triangles_of_state()) {
    tools_.ruler.follow(surface_of(state())->shared_topology(), shown_.positions_on_screen(),
                        !shown_.follows());
  }
  show_classes();
  if (!tools_.gizmo.is_dragging()) shown_.renew_measure();
}

void Editor::take_step() {
  std::optional<StepTaken> taken;
  const bool had_chosen = !state().selection.roi.vertices.empty() || handle_count() > 0;
  const std::size_t steps_before = state().steps.size();
  say_errors(say_, [&] { taken = session_->take_step(); });
  if (!taken) return;
  pointed_at_.clear();
  // If an earlier step was replaced, the warnings may be about any of the steps after it.
  const bool is_new = state().steps.size() > steps_before;
  for (const std::string& warning : taken->warnings) {
    say_({warning, Tone::warning, is_new ? state().steps.back() : nullptr});
  }
  if (taken->changed_triangles && had_chosen) {
    say_("The triangles have changed. Select the region again.");
  }
  state_changed();
}

void Editor::follow_hand() {
  const bool dragging = tools_.gizmo.is_dragging();
  // A settled surface is a pose from which to start.
  const bool from_rest = shown_.pose() == nullptr && needs_settling(state());
  dragged_handles(state(), handle_, from_rest, dragged_);
  session_->drag_by(dragged_);
  if (shown_.shows_before() || shown_.previews()) return;
  if (!dragging && !needs_settling(state())) {
    if (shown_.follows()) {  // the drag was given up
      session_->cancel_settling();
      state_changed();
    }
    return;
  }
  if (dragging) hold_pose();
  if (dragging && settles_while_dragging()) settle_live();
  maps_of(state(), handle_, dragging ? *tools_.gizmo.move() : state().moves[handle_].move,
          motions_);
  turn_free_handles();
  if (settles_while_dragging()) limit_lead();
  shown_.follow(session_->preparation(), motions_);
}

// The next motion starts from the present surface.
void Editor::hold_pose() {
  if (!shown_.has_triangles_of_state() || shown_.pose()) return;
  if (auto pose = session_->pose()) shown_.follow_from(std::move(pose));
}

Eigen::Affine3d Editor::pose_map(std::size_t handle) const {
  const std::shared_ptr<const DragState>& pose = shown_.pose();
  const bool has_one = pose && handle < pose->motions.maps.size();
  return has_one ? pose->motions.maps[handle] : Eigen::Affine3d::Identity();
}

Eigen::Vector3d Editor::centroid_of(std::size_t handle) const {
  return state().mirrored ? state().mirrored->centroids[handle] : handle_centroid(state(), handle);
}

// Shows handles with free orientation turned as in the settled pose.
void Editor::turn_free_handles() {
  if (!shown_.pose()) return;
  const std::vector<std::size_t>* images =
      state().mirrored ? &state().mirrored->handle_images : nullptr;
  for (std::size_t h = 0; h < motions_.size(); ++h) {
    const std::size_t of = h < state().moves.size() ? h : (*images)[h];
    const bool is_dragged = tools_.gizmo.is_dragging() && of == handle_;
    const HandleOrientation orientation =
        is_dragged ? tools_.gizmo.orientation() : state().moves[of].orientation;
    if (orientation == HandleOrientation::kept) continue;
    motions_[h] =
        turned_to(motions_[h], centroid_of(h), shortest_turn(pose_map(h)).toRotationMatrix());
  }
}

// A linear response shears and swells under large turns and moves. Until a settled pose catches up,
// the surface follows the hand only as far as it looks right.
void Editor::limit_lead() {
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

// Takes the settled pose of the drag, and asks for another if the hand has moved on or something is
// left to settle.
void Editor::settle_live() {
  live_moves_.assign(state().moves.begin(), state().moves.end());
  live_moves_[handle_].move = *tools_.gizmo.move();
  live_moves_[handle_].orientation = tools_.gizmo.orientation();
  const std::span<const Move> path = tools_.gizmo.waypoints();
  live_moves_[handle_].path.assign(path.begin(), path.end());
  if (auto result = session_->take_live_result()) {
    shown_.follow_from(result->pose);
    live_ = std::move(result);
  }
  if (resting_moves_ && *resting_moves_ != live_moves_) {
    // The worker may be factorizing, and the hand must not wait for that.
    session_->cancel_settling();
    resting_moves_.reset();
  }
  const bool is_there = live_ ? live_->is_done && live_->moves == live_moves_
                              : !needs_settling(state()) && state().moves == live_moves_;
  if (is_there) return;
  const bool rests = live_ && live_->moves == live_moves_;
  session_->settle_live(live_moves_, shown_.pose(), rests);
  if (rests) resting_moves_ = live_moves_;
}

void Editor::show_classes() {
  if (!std::exchange(classes_are_old_, false) && !shown_.needs_classes()) return;
  if (has_in_hand(tools_.stiffness)) {
    return shown_.set_classes(stiffness_classes(state(), tools_.stiffness.live_stiffness(state())));
  }
  shown_.set_classes(
      shown_classes(state(), part_, tool_->live(), tool_->is_dragging() && tool_->erases()));
}

std::size_t Editor::count(const Part& part) const {
  const VertexSet& chosen = vertices_of(state().selection, part);
  return part == part_ ? tool_->count_with(chosen) : chosen.size();
}

Bounds Editor::bounds() const {
  Bounds all = carried_.united_with(shown_.bounds());
  if (live_ && live_->pose) all = united(all, live_->bounds);
  const auto& followed = shown_.followed();
  for (std::size_t h = 0; h < std::min(followed.size(), handle_count()); ++h) {
    for (const Index v : state().selection.handles[h].vertices) {
      const Eigen::Vector3d place = followed[h] * state().rest->positions[v];
      all = united(all, {place, place});
    }
  }
  return all;
}

}  // namespace lapwing::viewer
