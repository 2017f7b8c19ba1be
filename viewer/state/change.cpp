#include "state/change.h"

#include <algorithm>

namespace lapwing::viewer {
namespace {

template <class T>
std::optional<std::array<T, 2>> both(const T& before, const T& after) {
  if (before == after) return std::nullopt;
  return std::array<T, 2>{before, after};
}

std::array<VertexSet, 2> set_difference(const VertexSet& before, const VertexSet& after) {
  return {subtract(before, after), subtract(after, before)};
}

void replace_set(VertexSet& set, const std::array<VertexSet, 2>& change, std::size_t from,
                 std::size_t to) {
  if (!change[from].empty()) set = subtract(set, change[from]);
  if (!change[to].empty()) set = unite(set, change[to]);
}

bool is_nothing(const std::array<VertexSet, 2>& change) {
  return change[0].empty() && change[1].empty();
}

std::vector<Falloff> falloffs_of(const AppState& state) {
  std::vector<Falloff> falloffs;
  for (const ChosenHandle& handle : state.selection.handles) falloffs.push_back(handle.falloff);
  return falloffs;
}

}  // namespace

Change::RegionChange Change::difference(const ChosenRegion& before, const ChosenRegion& after) {
  return {both(before.made, after.made), set_difference(before.added, after.added),
          set_difference(before.removed, after.removed),
          set_difference(before.vertices, after.vertices)};
}

Change::Change(const AppState& before, const AppState& after)
    : roi_(difference(before.selection.roi, after.selection.roi)),
      belt_(difference(before.selection.belt, after.selection.belt)),
      held_holes_(both(before.selection.held_holes, after.selection.held_holes)),
      handle_counts_{before.selection.handles.size(), after.selection.handles.size()},
      falloffs_(both(falloffs_of(before), falloffs_of(after))),
      mirror_(both(before.selection.mirror, after.selection.mirror)),
      mirrored_(both(before.mirrored, after.mirrored)),
      stiffness_(both(before.selection.stiffness, after.selection.stiffness)),
      belt_fraction_(both(before.selection.belt_fraction, after.selection.belt_fraction)),
      parameters_(both(before.parameters, after.parameters)),
      moves_(both(before.moves, after.moves)),
      settled_(both(before.settled, after.settled)),
      carried_(both(before.carried, after.carried)) {
  const auto handle_or_empty = [](const AppState& state, std::size_t h) {
    const auto& handles = state.selection.handles;
    return h < handles.size() ? ChosenRegion(handles[h]) : ChosenRegion{};
  };
  for (std::size_t h = 0; h < std::max(handle_counts_[0], handle_counts_[1]); ++h) {
    handles_.push_back(difference(handle_or_empty(before, h), handle_or_empty(after, h)));
  }
  if (before.rest != after.rest) compare_rest(before, after);
  const auto differ = std::ranges::mismatch(before.steps, after.steps);
  kept_steps_ = static_cast<std::size_t>(differ.in1 - before.steps.begin());
  steps_ = {Steps(differ.in1, before.steps.end()), Steps(differ.in2, after.steps.end())};
}

void Change::compare_rest(const AppState& before, const AppState& after) {
  if (!before.rest->shares_faces_with(*after.rest)) {
    triangles_ = {before.rest, after.rest};
    surface_moved_ = true;
    return;
  }
  rest_ = {moved_vertices(after.rest->positions, before.rest->positions),
           moved_vertices(before.rest->positions, after.rest->positions)};
  surface_moved_ = positions_of(before) != positions_of(after);
}

bool Change::is_nothing() const {
  const auto same = [](const RegionChange& change) {
    return !change.made && viewer::is_nothing(change.added) && viewer::is_nothing(change.removed) &&
           viewer::is_nothing(change.vertices);
  };
  return same(roi_) && same(belt_) && handle_counts_[0] == handle_counts_[1] &&
         std::ranges::all_of(handles_, same) && !falloffs_ && !mirror_ && !mirrored_ &&
         !stiffness_ && !belt_fraction_ && !parameters_ && !moves_ && !settled_ && !carried_ &&
         !rest_ && !triangles_ && steps_[0].empty() && steps_[1].empty();
}

bool Change::concerns_surface() const {
  // A commit changes the rest shape to the settled surface, so the visible surface does not move.
  if (rest_ || triangles_) return surface_moved_;
  // Adding or removing a handle at rest changes the list of moves, but not the surface.
  return settled_ || (moves_ && (any_moved((*moves_)[0]) || any_moved((*moves_)[1])));
}

void Change::replace(ChosenRegion& region, const RegionChange& change, std::size_t from,
                     std::size_t to) {
  if (change.made) region.made = (*change.made)[to];
  replace_set(region.added, change.added, from, to);
  replace_set(region.removed, change.removed, from, to);
  replace_set(region.vertices, change.vertices, from, to);
}

void Change::replace(AppState& state, std::size_t from, std::size_t to) const {
  EditSelection& selection = state.selection;
  replace(selection.roi, roi_, from, to);
  replace(selection.belt, belt_, from, to);
  selection.handles.resize(handles_.size());
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    replace(selection.handles[h], handles_[h], from, to);
  }
  selection.handles.resize(handle_counts_[to]);
  for (std::size_t h = 0; falloffs_ && h < handle_counts_[to]; ++h) {
    selection.handles[h].falloff = (*falloffs_)[to][h];
  }
  if (held_holes_) selection.held_holes = (*held_holes_)[to];
  if (mirror_) selection.mirror = (*mirror_)[to];
  if (mirrored_) state.mirrored = (*mirrored_)[to];
  if (stiffness_) selection.stiffness = (*stiffness_)[to];
  if (belt_fraction_) selection.belt_fraction = (*belt_fraction_)[to];
  if (parameters_) state.parameters = (*parameters_)[to];
  if (moves_) state.moves = (*moves_)[to];
  if (settled_) state.settled = (*settled_)[to];
  if (carried_) state.carried = (*carried_)[to];
  if (rest_) {
    auto mesh = std::make_shared<Mesh>(*state.rest);
    place((*rest_)[to], mesh->positions);
    set_rest(state, std::move(mesh));
  }
  if (triangles_) set_rest(state, (*triangles_)[to]);
  state.steps.resize(kept_steps_);
  state.steps.insert(state.steps.end(), steps_[to].begin(), steps_[to].end());
}

}  // namespace lapwing::viewer
