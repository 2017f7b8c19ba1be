#include "editing/shown_carried.h"

#include <algorithm>
#include <utility>

namespace lapwing::viewer {

void ShownCarried::release_device() {
  drawn_.clear();
  for (Object& object : objects_) {
    object.paint.reset();
    object.surface.reset();
    object.points.reset();
  }
  context_.reset();
}

void ShownCarried::use_device(std::shared_ptr<gpu::Context> context) {
  context_ = std::move(context);
  for (Object& object : objects_) make(object);
  list();
}

void ShownCarried::make(Object& object) const {
  if (!context_) return;
  const Mesh* mesh = object.opened->mesh();
  if (mesh == nullptr || mesh->face_count() == 0) {
    object.points = std::make_unique<PointCloud>(context_, object.positions);
    return;
  }
  object.surface = std::make_unique<Surface>(context_, object.positions, mesh->topology());
  object.paint = std::make_unique<SurfacePaint>(*object.surface);
  object.paint->set_polygons(*mesh);
}

// Returns the positions of a point set, or of those vertices of a mesh that belong to triangles.
Positions ShownCarried::shown_positions(const Object& object) {
  const Mesh* mesh = object.opened->mesh();
  return mesh == nullptr ? object.positions : surface_positions(object.positions, mesh->topology());
}

void ShownCarried::list() {
  drawn_.clear();
  for (const Object& object : objects_) {
    drawn_.push_back({object.surface.get(), object.paint.get(), object.points.get()});
  }
}

void ShownCarried::take(const AppState& state, Where where) {
  std::vector<Object> before = std::exchange(objects_, {});
  const CarriedFiles still = carried_of(state);
  for (std::size_t k = 0; k < state.carried.size(); ++k) {
    const CarriedObject& now = state.carried[k];
    const auto at = std::ranges::find(before, now.opened, &Object::opened);
    const bool is_new = at == before.end();
    if (is_new) {
      objects_.push_back({.opened = now.opened, .positions = now.rest->positions()});
      objects_.back().bounds = bounds_of(shown_positions(objects_.back()));
      make(objects_.back());
    } else {
      objects_.push_back(std::move(*at));
    }
    if (where == Where::dragged) continue;
    place(objects_.back(),
          where == Where::opened ? now.opened->positions() : still[k]->positions());
  }
  list();
}

void ShownCarried::place(std::span<const Positions> positions) {
  for (std::size_t k = 0; k < std::min(positions.size(), objects_.size()); ++k) {
    place(objects_[k], positions[k]);
  }
}

void ShownCarried::place(Object& object, const Positions& positions) {
  if (object.positions == positions) return;
  object.positions = positions;
  object.bounds = bounds_of(shown_positions(object));
  if (object.surface) object.surface->place(positions);
  if (object.points) object.points->place(positions);
}

void ShownCarried::append_positions(Positions& points) const {
  for (const Object& object : objects_) {
    const Positions shown = shown_positions(object);
    points.insert(points.end(), shown.begin(), shown.end());
  }
}

Bounds ShownCarried::united_with(Bounds bounds) const {
  for (const Object& object : objects_) bounds = united(bounds, object.bounds);
  return bounds;
}

}  // namespace lapwing::viewer
