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

std::size_t bytes_of(const std::array<VertexSet, 2>& change) {
  return (change[0].size() + change[1].size()) * sizeof(Index);
}

std::vector<Falloff> falloffs_of(const AppState& state) {
  std::vector<Falloff> falloffs;
  for (const ChosenHandle& handle : state.selection.handles) falloffs.push_back(handle.falloff);
  return falloffs;
}

// Leaves out attributes, which are small beside the rest.
std::size_t bytes_of(const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  const std::size_t numbers = mesh.face_starts().size() + mesh.face_vertices().size() +
                              4 * topology.triangles.size() + topology.rings.values.size() +
                              topology.vertex_triangles.values.size() + 2 * mesh.vertex_count();
  return mesh.vertex_count() * sizeof(Eigen::Vector3d) + numbers * sizeof(Index);
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
      handle_counts_{before.selection.handles.size(), after.selection.handles.size()},
      falloffs_(both(falloffs_of(before), falloffs_of(after))),
      mirror_(both(before.selection.mirror, after.selection.mirror)),
      mirrored_(both(before.mirrored, after.mirrored)),
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
  const auto differ = std::mismatch(before.steps.begin(), before.steps.end(), after.steps.begin(),
                                    after.steps.end());
  kept_steps_ = static_cast<std::size_t>(differ.first - before.steps.begin());
  steps_ = {Steps(differ.first, before.steps.end()), Steps(differ.second, after.steps.end())};
}

void Change::compare_rest(const AppState& before, const AppState& after) {
  if (!before.rest->shares_faces_with(*after.rest)) {
    triangles_ = {before.rest, after.rest};
    surface_moved_ = true;
    return;
  }
  MovedVertices there = moved_vertices(before.rest->positions, after.rest->positions);
  RestChange rest{std::move(there.vertices), {}};
  for (const Index v : rest.vertices) rest.positions[0].push_back(before.rest->positions[v]);
  rest.positions[1] = std::move(there.positions);
  rest_ = std::move(rest);
  surface_moved_ = positions_of(before) != positions_of(after);
}

bool Change::is_nothing() const {
  const auto same = [](const RegionChange& change) {
    return !change.made && viewer::is_nothing(change.added) && viewer::is_nothing(change.removed) &&
           viewer::is_nothing(change.vertices);
  };
  return same(roi_) && same(belt_) && handle_counts_[0] == handle_counts_[1] &&
         std::all_of(handles_.begin(), handles_.end(), same) && !falloffs_ && !mirror_ &&
         !mirrored_ && !belt_fraction_ && !parameters_ && !moves_ && !settled_ && !carried_ &&
         !rest_ && !triangles_ && steps_[0].empty() && steps_[1].empty();
}

bool Change::concerns_surface() const {
  // A commit moves the rest shape to where the surface was already.
  if (rest_ || triangles_) return surface_moved_;
  // A handle that comes or goes without having moved changes the list of moves only.
  const auto moves_any = [](const std::vector<HandleMove>& moves) {
    return std::any_of(moves.begin(), moves.end(),
                       [](const HandleMove& to) { return !to.is_at_rest(); });
  };
  return settled_ || (moves_ && (moves_any((*moves_)[0]) || moves_any((*moves_)[1])));
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
  if (mirror_) selection.mirror = (*mirror_)[to];
  if (mirrored_) state.mirrored = (*mirrored_)[to];
  if (belt_fraction_) selection.belt_fraction = (*belt_fraction_)[to];
  if (parameters_) state.parameters = (*parameters_)[to];
  if (moves_) state.moves = (*moves_)[to];
  if (settled_) state.settled = (*settled_)[to];
  if (carried_) state.carried = (*carried_)[to];
  if (rest_) {
    auto mesh = std::make_shared<Mesh>(*state.rest);
    for (std::size_t k = 0; k < rest_->vertices.size(); ++k) {
      mesh->positions[rest_->vertices[k]] = rest_->positions[to][k];
    }
    set_rest(state, std::move(mesh));
  }
  if (triangles_) set_rest(state, (*triangles_)[to]);
  state.steps.resize(kept_steps_);
  state.steps.insert(state.steps.end(), steps_[to].begin(), steps_[to].end());
}

std::size_t Change::bytes() const {
  const auto bytes_of_region = [](const RegionChange& change) {
    return sizeof change + bytes_of(change.added) + bytes_of(change.removed) +
           bytes_of(change.vertices);
  };
  std::size_t total = sizeof *this + bytes_of_region(roi_) + bytes_of_region(belt_);
  for (const RegionChange& handle : handles_) total += bytes_of_region(handle);
  constexpr std::size_t kPosition = sizeof(Eigen::Vector3d);
  if (falloffs_) {
    for (const auto& falloffs : *falloffs_) {
      for (const Falloff& falloff : falloffs) total += falloff.field.size() * sizeof(double);
    }
  }
  if (settled_) {
    // Each result is in two changes: the one that set it and the one that replaced it.
    for (const Settled& result : *settled_) {
      if (!result) continue;
      total += result->vertices.size() * (sizeof(Index) + kPosition) / 2;
      for (const auto& file : result->carried) total += file->positions().size() * kPosition / 2;
    }
  }
  if (carried_) {
    // The results hold the positions after each step.
    for (const auto& objects : *carried_) {
      for (const CarriedObject& object : objects) {
        total += object.opened->positions().size() * kPosition / 2;
      }
    }
  }
  if (rest_) total += rest_->vertices.size() * (sizeof(Index) + 2 * kPosition);
  if (triangles_) {
    // Each mesh is in two changes, like a result.
    for (const auto& mesh : *triangles_) total += bytes_of(*mesh) / 2;
  }
  return total;
}

}  // namespace lapwing::viewer
