#include "state/edit_selection.h"

#include "lapwing/base/errors.h"
#include "lapwing/region/joined_regions.h"

namespace lapwing::viewer {
namespace {

bool is_list(const RegionSpec& spec) {
  return std::holds_alternative<ListedVertices>(spec.form);
}

RegionSpec listed(VertexSet vertices, const std::string& where) {
  return {ListedVertices{std::move(vertices)}, where};
}

VertexSet resolve_on(const RegionSpec& spec, const Mesh& mesh, const JoinedSurface* joined) {
  return joined == nullptr ? resolve(spec, mesh) : resolve_leaders(spec, *joined);
}

// Returns a region without a form: all its vertices count as added by hand.
ChosenRegion painted(VertexSet vertices) {
  ChosenRegion region;
  region.added = vertices;
  region.vertices = std::move(vertices);
  return region;
}

}  // namespace

ChosenRegion choose(RegionSpec spec, const Mesh& mesh, const JoinedSurface* joined) {
  VertexSet vertices = resolve_on(spec, mesh, joined);
  // A recipe cannot contain a disk without a radius.
  const auto* disk = std::get_if<GeodesicDisk>(&spec.form);
  const bool is_point = disk != nullptr && !(disk->radius > 0.0);
  if (is_list(spec) || is_point) return painted(std::move(vertices));
  ChosenRegion region;
  region.made = std::move(spec);
  region.vertices = std::move(vertices);
  return region;
}

ChosenRegion repainted(const ChosenRegion& region, VertexSet vertices) {
  if (vertices.empty() || is_list(region.made)) return painted(std::move(vertices));
  const VertexSet made = unite(subtract(region.vertices, region.added), region.removed);
  ChosenRegion result;
  result.made = region.made;
  result.added = subtract(vertices, made);
  result.removed = subtract(made, vertices);
  result.vertices = std::move(vertices);
  return result;
}

RegionSpec spec_of(const ChosenRegion& region, const std::string& where) {
  if (is_list(region.made)) return listed(region.vertices, where);
  RegionSpec spec{region.made.form, where};
  if (!region.added.empty()) {
    spec = {UnionRegion{{std::move(spec), listed(region.added, where)}}, where};
  }
  if (!region.removed.empty()) {
    spec = {DifferenceRegion{{std::move(spec), listed(region.removed, where)}}, where};
  }
  return spec;
}

ChosenRegion carried_over(const ChosenRegion& region, const Mesh& mesh,
                          const JoinedSurface* joined) {
  if (is_list(region.made)) return region;
  try {
    const RegionSpec spec = spec_of(region, "selection");
    if (resolve_on(spec, mesh, joined) == region.vertices) return region;
  } catch (const InputError&) {
    // `made` cannot be resolved on this mesh.
  }
  return painted(region.vertices);
}

void renew_belt(EditSelection& selection, const Mesh& mesh, const JoinedSurface* joined) {
  if (!selection.belt_fraction) return;
  BorderBelt belt;
  if (!selection.roi.vertices.empty()) {
    std::vector<VertexSet> handles;
    for (const ChosenHandle& handle : selection.handles) handles.push_back(fully_held(handle));
    belt = resolve_border_belt({*selection.belt_fraction, "belt"}, selection.roi.vertices, handles,
                               joined == nullptr ? mesh : joined->surface);
  }
  selection.belt = painted(std::move(belt.vertices));
  selection.held_holes = std::move(belt.held_holes);
}

std::vector<StiffnessSpec> painted_stiffness(std::vector<StiffnessSpec> stiffness,
                                             const VertexSet& vertices, double factor) {
  const auto list_of = [](StiffnessSpec& spec) {
    return spec.field.empty() ? std::get_if<ListedVertices>(&spec.region.form) : nullptr;
  };
  // The order of lists without common vertices has no effect. A region or field after a list can
  // override it, so only lists after the last region or field can be extended.
  bool only_lists = true;
  ListedVertices* same = nullptr;
  std::erase_if(stiffness, [&](StiffnessSpec& spec) {
    ListedVertices* list = list_of(spec);
    only_lists = only_lists && list != nullptr;
    if (list == nullptr) return false;
    list->vertices = subtract(make_vertex_set(std::move(list->vertices)), vertices);
    return list->vertices.empty();
  });
  for (std::size_t k = stiffness.size(); k-- > 0 && same == nullptr;) {
    ListedVertices* list = list_of(stiffness[k]);
    if (list == nullptr) break;
    if (stiffness[k].factor == factor) same = list;
  }
  if (vertices.empty() || (factor == 1.0 && only_lists)) return stiffness;
  if (same == nullptr) {
    stiffness.push_back({listed(vertices, "stiffness"), factor});
  } else {
    same->vertices = unite(same->vertices, vertices);
  }
  return stiffness;
}

BeltSpec belt_spec(const EditSelection& selection) {
  if (selection.belt_fraction) return BoundaryAnchors{*selection.belt_fraction, "belt"};
  return spec_of(selection.belt, "belt");
}

std::vector<HandleSpec> handle_specs(const EditSelection& selection) {
  std::vector<HandleSpec> specs;
  for (const ChosenHandle& handle : selection.handles) {
    specs.push_back(
        {spec_of(handle, "handle " + std::to_string(specs.size() + 1)), handle.falloff});
  }
  return specs;
}

std::vector<FalloffVertex> falloff_vertices(const EditSelection& selection, const Mesh& mesh) {
  std::vector<FadingHandle> fading;
  std::vector<FalloffVertex> painted;
  for (const ChosenHandle& handle : selection.handles) {
    const std::vector<double>& field = handle.falloff.field;
    for (std::size_t k = 0; !field.empty() && k < handle.vertices.size(); ++k) {
      const Index v = handle.vertices[k];
      if (field[v] > 0.0 && field[v] < 1.0) painted.push_back({v, fading.size(), field[v]});
    }
    fading.push_back({fully_held(handle), handle.falloff.transition});
  }
  return falloff_around(fading, std::move(painted), selection.roi.vertices, selection.belt.vertices,
                        mesh);
}

VertexSet fully_held(const ChosenHandle& handle) {
  if (handle.falloff.field.empty()) return handle.vertices;
  VertexSet held;
  for (const Index v : handle.vertices) {
    if (handle.falloff.field[v] == 1.0) held.push_back(v);
  }
  return held;
}

}  // namespace lapwing::viewer
