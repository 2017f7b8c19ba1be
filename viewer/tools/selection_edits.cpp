#include "tools/selection_edits.h"

#include <algorithm>
#include <numeric>

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

VertexSet all_vertices(const AppState& state) {
  VertexSet all(state.rest->vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  if (const JoinedSurface* joined = joined_seams(state)) {
    std::erase_if(all, [&](Index v) { return joined->is_follower(v); });
  }
  return all;
}

// Returns those of `vertices` that the part may hold.
VertexSet allowed(const AppState& state, const Part& part, VertexSet vertices) {
  if (part.role == Role::roi) return vertices;
  const EditSelection& selection = state.selection;
  if (!selection.roi.vertices.empty()) vertices = intersect(vertices, selection.roi.vertices);
  for (std::size_t h = 0; h < selection.handles.size(); ++h) {
    if (part.role == Role::handle && part.handle == h) continue;
    vertices = subtract(vertices, selection.handles[h].vertices);
  }
  // A belt defined by its width makes room for handles itself.
  const bool belt_by_hand = part.role == Role::handle && !selection.belt_fraction;
  return belt_by_hand ? subtract(vertices, selection.belt.vertices) : vertices;
}

std::optional<Command> change(const Part& part, VertexSet added, VertexSet removed) {
  if (added.empty() && removed.empty()) return std::nullopt;
  return Paint{part, std::move(added), std::move(removed)};
}

}  // namespace

const ChosenRegion& region_of(const EditSelection& selection, const Part& part) {
  static const ChosenRegion kNone;
  if (part.role == Role::roi) return selection.roi;
  if (part.role == Role::belt) return selection.belt;
  return part.handle < selection.handles.size() ? selection.handles[part.handle] : kNone;
}

const VertexSet& vertices_of(const EditSelection& selection, const Part& part) {
  return region_of(selection, part).vertices;
}

std::optional<Command> paint(const AppState& state, const Part& part, const VertexSet& vertices,
                             bool erase) {
  const VertexSet& before = vertices_of(state.selection, part);
  if (erase) return change(part, {}, intersect(before, vertices));
  return change(part, allowed(state, part, subtract(vertices, before)), {});
}

std::optional<Command> grow(const AppState& state, const Part& part) {
  const VertexSet& before = vertices_of(state.selection, part);
  return paint(state, part, with_ring_neighbours(before, surface_of(state)->topology().rings),
               false);
}

std::optional<Command> shrink(const AppState& state, const Part& part) {
  const VertexSet& before = vertices_of(state.selection, part);
  const std::shared_ptr<const Mesh> surface = surface_of(state);
  const std::vector<char> inside = vertex_mask(state.rest->vertex_count(), before);
  VertexSet outermost;
  std::ranges::copy_if(before, std::back_inserter(outermost), [&](Index v) {
    return !std::ranges::all_of(surface->topology().rings[v], [&](Index w) { return inside[w]; });
  });
  return paint(state, part, outermost, true);
}

std::optional<Command> choose_all(const AppState& state, const Part& part) {
  const VertexSet all = all_vertices(state);
  if (part.role != Role::roi) return paint(state, part, all, false);
  if (state.selection.roi.vertices.size() == all.size()) return std::nullopt;
  return Choose{part, {AllVertices{}, "ROI"}};
}

std::optional<Command> clear(const AppState& state, const Part& part) {
  const EditSelection& selection = state.selection;
  switch (part.role) {
    case Role::roi:
      if (selection.roi.vertices.empty()) return std::nullopt;
      return Choose{part, {ListedVertices{}, "ROI"}};
    case Role::handle:
      if (part.handle >= selection.handles.size()) return std::nullopt;
      return RemoveHandle{part.handle};
    case Role::belt:
      if (selection.belt_fraction) return std::nullopt;
      return SetBeltWidth{};
  }
  return std::nullopt;
}

std::optional<Command> invert(const AppState& state, const Part& part) {
  const VertexSet& before = vertices_of(state.selection, part);
  return change(part, allowed(state, part, subtract(all_vertices(state), before)), before);
}

}  // namespace lapwing::viewer
