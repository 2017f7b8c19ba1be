#include "editing/edit_surface.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace lapwing::viewer {
namespace {

VertexClass class_of(Part::Role role) {
  if (role == Part::Role::roi) return VertexClass::roi;
  return role == Part::Role::handle ? VertexClass::handle : VertexClass::belt;
}

// The classes of the selection on this side.
std::vector<VertexClass> classes_of(const AppState& state) {
  const EditSelection& selection = state.selection;
  std::vector<VertexClass> classes(state.rest->vertex_count(), VertexClass::outside);
  const auto mark = [&](const VertexSet& vertices, VertexClass as) {
    for (const Index v : vertices) classes[v] = as;
  };
  mark(selection.roi.vertices, VertexClass::roi);
  mark(selection.belt.vertices, VertexClass::belt);
  std::vector<VertexSet> handles;
  for (const ChosenHandle& handle : selection.handles) {
    handles.push_back(fully_held(handle));
    mark(handles.back(), VertexClass::handle);
  }
  draw_graded(falloff_vertices(selection, *surface_of(state)), handles, classes);
  return classes;
}

}  // namespace

EditSurface::EditSurface(std::shared_ptr<gpu::Context> context, const Mesh& mesh,
                         double feature_angle_degrees)
    : surface_(std::make_unique<Surface>(std::move(context), mesh.positions, mesh.topology(),
                                         feature_angle_degrees)),
      paint_(*surface_) {
  paint_.set_polygons(mesh);
}

void EditSurface::changed(SurfaceSource source) {
  source_ = source;
  ++version_;
}

void EditSurface::place(std::span<const Eigen::Vector3d> positions) {
  surface_->place(positions);
  pose_.reset();
  drag_.reset();
  on_device_.reset();
  changed(SurfaceSource::still);
}

bool EditSurface::drag(const Preparation& preparation, std::span<const Eigen::Affine3d> motions) {
  const Preparation::ToDragBy ready = preparation.drag_response();
  if (!ready.response) return false;
  if (!drag_ || drag_->response() != ready.response || drag_->pose() != pose_) {
    on_device_ = ready.on_device;
    drag_.emplace(ready.response, pose_);
    surface_->begin(*on_device_, ready.response->rest(),
                    pose_ ? std::span(pose_->displacement) : std::span<const Eigen::Vector3d>());
  }
  surface_->blend(on_device_, drag_->parameters(motions));
  changed(ready.is_exact ? SurfaceSource::exact : SurfaceSource::preview);
  return true;
}

bool EditSurface::drags_by(const Preparation& preparation) const {
  return drag_ && drag_->pose() == pose_ &&
         drag_->response() == preparation.drag_response().response;
}

std::vector<VertexClass> stiffness_classes(const AppState& state,
                                           std::span<const StiffnessSpec> stiffness) {
  const std::size_t count = state.rest->vertex_count();
  std::vector<VertexClass> classes(count, VertexClass::outside);
  for (const Index v : state.selection.roi.vertices) classes[v] = VertexClass::roi;
  VertexSet all(count);
  std::iota(all.begin(), all.end(), Index{0});
  for (const auto& [v, factor] : resolve_stiffness(stiffness, all, *state.rest)) {
    // Stiff factors have lighter colours than rigid ones.
    const double share = 0.25 + 0.5 * std::log(factor) / std::log(kStiffest);
    classes[v] = factor < 1.0 ? VertexClass::belt
                              : drawn_by_handle(classes[v], factor > kStiffest ? 1.0 : share);
  }
  return classes;
}

std::vector<VertexClass> shown_classes(const AppState& state, const Part& part,
                                       const VertexSet& live, bool erase) {
  std::vector<VertexClass> classes =
      state.mirrored ? vertex_classes(state.mirrored->region, state.rest->vertex_count())
                     : classes_of(state);
  const bool of_roi = part.role == Part::Role::roi;
  const VertexClass erased = of_roi ? VertexClass::outside : VertexClass::roi;
  for (const Index v : live) classes[v] = erase ? erased : class_of(part.role);
  return classes;
}

}  // namespace lapwing::viewer
