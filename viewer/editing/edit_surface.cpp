#include "editing/edit_surface.h"

#include <numeric>
#include <utility>

namespace lapwing::viewer {
namespace {

std::unique_ptr<DeformedSurface> still_surface(const Mesh& mesh, VulkanKernels& kernels) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return kernels.make_surface({mesh.positions, mesh.topology(), all, {}, 0});
}

VertexClass class_of(Part::Role role) {
  switch (role) {
    case Part::Role::roi:
      return VertexClass::roi;
    case Part::Role::handle:
      return VertexClass::handle;
    case Part::Role::belt:
      return VertexClass::belt;
  }
  return VertexClass::outside;
}

}  // namespace

EditSurface::EditSurface(const Mesh& mesh, VulkanKernels& kernels)
    : still_(still_surface(mesh, kernels)),
      shown_(&dynamic_cast<VulkanSurface&>(*still_)),
      paint_(*shown_) {
  paint_.set_polygons(mesh);
}

void EditSurface::show(DeformedSurface& surface, SurfaceSource source) {
  shown_ = &dynamic_cast<VulkanSurface&>(surface);
  source_ = source;
  ++version_;
}

void EditSurface::place(std::span<const Eigen::Vector3d> positions) {
  still_->place(positions);
  show(*still_, SurfaceSource::still);
  pose_.reset();
  preview_ = {};
  exact_ = {};
}

template <typename Response>
void EditSurface::drag(std::shared_ptr<Response> response, std::span<const Eigen::Affine3d> motions,
                       SurfaceSource source, Dragged<Response>& dragged) {
  if (response != dragged.response || pose_ != dragged.pose) {
    response->drag_from(pose_ ? *pose_ : SettledPose());
  }
  response->drag(motions);
  show(response->surface(), source);
  dragged = {std::move(response), pose_};
}

bool EditSurface::drag(const Preparation& preparation, std::span<const Eigen::Affine3d> motions) {
  const bool is_free = preparation.status().phase == PreparationStatus::Phase::ready;
  if (auto exact = preparation.exact(); exact && is_free) {
    const auto source = exact->is_exact() ? SurfaceSource::exact : SurfaceSource::preview;
    drag(std::move(exact), motions, source, exact_);
    return true;
  }
  if (auto preview = preparation.preview()) {
    drag(std::move(preview), motions, SurfaceSource::preview, preview_);
    return true;
  }
  return false;
}

std::vector<VertexClass> shown_classes(const AppState& state, const Part& part,
                                       const VertexSet& live, bool erase) {
  const EditSelection& selection = state.selection;
  std::vector<VertexClass> classes(state.rest->vertex_count(), VertexClass::outside);
  const auto mark = [&](const VertexSet& vertices, VertexClass as) {
    for (const Index v : vertices) classes[v] = as;
  };
  mark(selection.roi.vertices, VertexClass::roi);
  mark(selection.belt.vertices, VertexClass::belt);
  for (const ChosenRegion& handle : selection.handles) mark(handle.vertices, VertexClass::handle);
  const bool of_roi = part.role == Part::Role::roi;
  mark(live, !erase ? class_of(part.role) : of_roi ? VertexClass::outside : VertexClass::roi);
  return classes;
}

}  // namespace lapwing::viewer
