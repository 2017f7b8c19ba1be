// What of an editor is on the screen: the surface and its colours.

#include <algorithm>
#include <utility>

#include "editing/editor.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

Bounds united(const Bounds& a, const Bounds& b) {
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

}  // namespace

void Editor::state_changed() {
  const AppState& now = state();
  if (part_.role == Part::Role::handle) part_.handle = std::min(part_.handle, handle_count());
  handle_ = handle_count() == 0 ? 0 : std::min(handle_, handle_count() - 1);
  if (rest_ != now.rest || settled_ != now.settled) {
    rest_ = now.rest;
    settled_ = now.settled;
    positions_ = positions_of(now);
    bounds_ = bounds_of(positions_);
    disk_.reset();
    loop_.reset();
  }
  warnings_.clear();
  if (const Certificate* certificate = session_->certificate()) {
    warnings_ = warnings_of(*certificate, *now.topology, opened_bounds_.diagonal());
  }
  following_ = false;
  followed_.clear();
  classes_are_old_ = true;
  if (!needs_settling(now)) show_still();
}

void Editor::show_still() {
  device_->surface.place(before_ ? opened_->positions : positions_);
}

void Editor::show_before(bool before) {
  if (is_dragging() || before == before_) return;
  before_ = before;
  state_changed();
}

void Editor::update() {
  if (session_->take_result()) state_changed();
  follow_hand();
  show_classes();
  show_measure();
}

void Editor::follow_hand() {
  const bool dragging = gizmo_.is_dragging();
  if (before_) return;
  if (!dragging && !needs_settling(state())) {
    if (following_) state_changed();  // the drag was given up
    return;
  }
  if (dragging && continuous_ && follow_settled()) return;
  motions_of(state(), handle_, dragging ? *gizmo_.live() : state().moves[handle_], motions_);
  const bool could_be_exact =
      device_->surface.source() != SurfaceSource::exact &&
      session_->preparation().status().phase == PreparationStatus::Phase::ready;
  const bool same =
      std::equal(motions_.begin(), motions_.end(), followed_.begin(), followed_.end(),
                 [](const auto& a, const auto& b) { return a.matrix() == b.matrix(); });
  if (same && !could_be_exact) return;
  if (!device_->surface.drag(session_->preparation(), motions_)) return;
  following_ = true;
  followed_.assign(motions_.begin(), motions_.end());
}

// What has settled last of this drag stays until the next one has. False before the first.
bool Editor::follow_settled() {
  live_moves_.assign(state().moves.begin(), state().moves.end());
  live_moves_[handle_] = *gizmo_.live();
  session_->settle_live(live_moves_);
  if (const auto result = session_->take_live_result()) {
    Positions positions = state().rest->positions;
    for (std::size_t k = 0; k < result->vertices.size(); ++k) {
      positions[result->vertices[k]] = result->positions[k];
    }
    device_->surface.place(positions);
    following_ = true;
    followed_.clear();
  }
  return following_ && device_->surface.source() == SurfaceSource::still;
}

void Editor::show_classes() {
  if (!std::exchange(classes_are_old_, false)) return;
  device_->surface.paint().set_classes(
      shown_classes(state(), part_, live(), paint_.is_dragging() && paint_.erases()));
}

// What a tool is choosing.
VertexSet Editor::live() const {
  if (tool_ == EditTool::disk && disk_.is_dragging()) return disk_.live();
  return paint_.is_dragging() ? paint_.live() : VertexSet{};
}

std::size_t Editor::count(const Part& part) const {
  const VertexSet& chosen = vertices_of(state().selection, part);
  if (part != part_) return chosen.size();
  if (disk_.is_dragging()) return live().size();
  if (!paint_.is_dragging()) return chosen.size();
  return (paint_.erases() ? subtract(chosen, live()) : unite(chosen, live())).size();
}

bool Editor::is_measured() const {
  return measure_ && measured_ == measure_ && measured_version_ == device_->surface.version();
}

// Numbers are of the still surface: what a drag shows has none yet.
void Editor::show_measure() {
  const bool still = !gizmo_.is_dragging() && device_->surface.source() == SurfaceSource::still;
  if (!measure_ || !still || is_measured()) return;
  const auto numbers = measure_pose(*measure_, *state().topology, opened_->positions,
                                    before_ ? opened_->positions : positions_);
  device_->surface.paint().set_scalars(numbers);
  measure_range_ = range_without_outliers(numbers);
  measured_ = measure_;
  measured_version_ = device_->surface.version();
}

Bounds Editor::bounds() const {
  Bounds all = united(opened_bounds_, bounds_);
  for (std::size_t h = 0; h < followed_.size(); ++h) {
    for (const Index v : state().selection.handles[h].vertices) {
      const Eigen::Vector3d place = followed_[h] * state().rest->positions[v];
      all = united(all, {place, place});
    }
  }
  return all;
}

}  // namespace lapwing::viewer
