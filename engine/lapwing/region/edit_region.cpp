#include "lapwing/region/edit_region.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

void require_members(const VertexSet& vertices, const std::string& where, const std::string& what) {
  if (!vertices.empty()) return;
  throw InputError(where + ": the " + what + " has no vertices. Add at least one");
}

void require_inside(const VertexSet& vertices, const VertexSet& roi, const std::string& where,
                    const std::string& what) {
  const VertexSet outside = subtract(vertices, roi);
  if (outside.empty()) return;
  throw InputError(where + ": the " + what + " extends beyond the ROI at " +
                       name_vertices(outside) + ". Enlarge the ROI, or remove them from the " +
                       what,
                   outside);
}

void require_disjoint(const VertexSet& vertices, const VertexSet& others, const std::string& where,
                      const std::string& what) {
  const VertexSet shared = intersect(vertices, others);
  if (shared.empty()) return;
  throw InputError(where + ": the handle shares " + name_vertices(shared) + " with " + what +
                       ". Remove them from one of the two, for example with \"minus\"",
                   shared);
}

void require_finite(const VertexSet& roi, const Mesh& mesh, const std::string& where) {
  const auto is_broken = [&](Index v) { return !mesh.positions[v].allFinite(); };
  VertexSet broken;
  for (const Index v : roi) {
    const auto ring = mesh.topology().rings[v];
    if (ring.empty()) continue;
    if (is_broken(v)) broken.push_back(v);
    std::copy_if(ring.begin(), ring.end(), std::back_inserter(broken), is_broken);
  }
  if (broken.empty()) return;
  broken = make_vertex_set(std::move(broken));
  throw InputError(where + ": the mesh has a non-finite position, in or next to the ROI, at " +
                       name_vertices(broken) +
                       ". Repair the mesh with `lapwing check --fix`, or keep the ROI away from "
                       "there",
                   broken);
}

VertexSet resolve_belt(const RegionSpec& spec, const VertexSet& roi, const Mesh& mesh) {
  VertexSet belt = resolve(spec, mesh);
  require_inside(belt, roi, spec.where, "belt");
  return belt;
}

// Sets the belt to the vertices along the border. Excludes vertices of handles and targets.
void resolve_border_belt(const BoundaryAnchors& spec, const Mesh& mesh, EditRegion& region) {
  std::vector<VertexSet> holders = region.handles;
  for (const Target& target : region.targets) holders.push_back(corners_of({&target, 1}));
  auto [vertices, held_holes] = resolve_border_belt(spec, region.roi, holders, mesh);
  region.belt = std::move(vertices);
  region.held_holes = std::move(held_holes);
}

void require_field(std::span<const double> field, const Mesh& mesh, const std::string& where) {
  if (field.size() != mesh.vertex_count()) {
    throw InputError(where + ": expected a weight for each of the mesh's " +
                     std::to_string(mesh.vertex_count()) + " vertices, got " +
                     std::to_string(field.size()));
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (field[v] >= 0.0 && field[v] <= 1.0) continue;
    throw InputError(where + ": the weight of vertex " + std::to_string(v) +
                         " must be from 0 to 1, not " + std::to_string(field[v]),
                     {static_cast<Index>(v)});
  }
}

// Adds the handles to `region`, and vertices with field weights between 0 and 1 to `region.graded`.
void resolve_handles(std::span<const HandleSpec> handles, const Mesh& mesh, EditRegion& region) {
  for (const auto& [spec, falloff] : handles) {
    VertexSet handle = resolve(spec, mesh);
    require_members(handle, spec.where, "handle");
    require_inside(handle, region.roi, spec.where, "handle");
    require_falloff(falloff, spec.where);
    if (!falloff.field.empty()) {
      require_field(falloff.field, mesh, spec.where);
      const VertexSet all = std::move(handle);
      split_by_field(all, falloff.field, region.handles.size(), spec.where, handle, region.graded);
    }
    for (std::size_t k = 0; k < region.handles.size(); ++k) {
      require_disjoint(handle, region.handles[k], spec.where, "handle " + std::to_string(k));
    }
    region.handles.push_back(std::move(handle));
    region.handle_weights.push_back(falloff.weight);
  }
}

// Adds the falloffs around the handles to `region.graded`, for vertices that nothing else holds.
void grade(std::span<const HandleSpec> handles, const Mesh& mesh, EditRegion& region) {
  std::vector<Index> held = region.belt;
  for (const Target& target : region.targets) {
    if (region.hard_targets && target.is_vertex()) held.push_back(target.corners[0]);
  }
  std::vector<FadingHandle> fading;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    fading.push_back({region.handles[h], handles[h].falloff.transition});
  }
  region.graded = falloff_around(fading, std::move(region.graded), region.roi, held, mesh);
}

}  // namespace

std::size_t EditRegion::free_count() const {
  std::size_t held = belt.size();
  for (const VertexSet& handle : handles) held += handle.size();
  return roi.size() - held;
}

EditRegion resolve_edit_region(const RegionSpec& roi, const BeltSpec& belt,
                               std::span<const HandleSpec> handles, const Mesh& mesh,
                               LoosePolicy policy, const TargetSpec& targets) {
  EditRegion region;
  region.roi = resolve(roi, mesh);
  require_members(region.roi, roi.where, "ROI");
  require_finite(region.roi, mesh, roi.where);
  require_extent(region.roi, mesh.positions, roi.where);
  resolve_handles(handles, mesh, region);
  const auto* border = std::get_if<BoundaryAnchors>(&belt);
  if (border == nullptr) region.belt = resolve_belt(std::get<RegionSpec>(belt), region.roi, mesh);
  VertexSet held = region.belt;
  for (const VertexSet& handle : region.handles)
    held.insert(held.end(), handle.begin(), handle.end());
  region.targets = resolve_targets(targets, region.roi, make_vertex_set(std::move(held)), mesh);
  region.hard_targets = targets.hard;
  if (border != nullptr) resolve_border_belt(*border, mesh, region);
  for (std::size_t k = 0; k < handles.size(); ++k) {
    require_disjoint(region.handles[k], region.belt, handles[k].region.where, "the belt");
  }
  grade(handles, mesh, region);
  separate_loose_parts(region, mesh.positions, mesh.topology(), policy, roi.where);
  return region;
}

}  // namespace lapwing
