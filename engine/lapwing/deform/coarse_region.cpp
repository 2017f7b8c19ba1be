#include "lapwing/deform/coarse_region.h"

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

// Returns the kept part of `region` in coarse indices; `own` maps vertices of the mesh to these.
EditRegion kept_of(const EditRegion& region, std::span<const Index> own) {
  const auto kept = [&](const VertexSet& set) {
    VertexSet left;
    for (const Index v : set) {
      if (own[v] != kNoIndex) left.push_back(own[v]);
    }
    return left;
  };
  EditRegion coarse;
  coarse.roi = kept(region.roi);
  coarse.belt = kept(region.belt);
  for (const VertexSet& handle : region.handles) coarse.handles.push_back(kept(handle));
  coarse.handle_weights = region.handle_weights;
  for (FalloffVertex graded : region.graded) {
    graded.vertex = own[graded.vertex];
    if (graded.vertex != kNoIndex) coarse.graded.push_back(graded);
  }
  for (Target target : region.targets) {
    for (Index& corner : target.corners) corner = own[corner];
    coarse.targets.push_back(target);
  }
  coarse.hard_targets = region.hard_targets;
  coarse.turns_freely = region.turns_freely;
  return coarse;
}

}  // namespace

std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count) {
  auto coarse = std::make_unique<CoarseRegion>();
  coarse->level = fine.factors->coarse_surfaces().of(fine.region, fine.topology, fine.rest, count);
  if (coarse->level == nullptr) return nullptr;
  const CoarseSurface& surface = coarse->level->surface;
  try {
    const std::scoped_lock lock(coarse->level->preparing);
    coarse->edit = std::make_unique<const EditSystem>(
        coarse->level->prepared, surface.rest,
        kept_of(fine.region, inverse_index(surface.kept, fine.rest->size())), fine.options,
        Progress(), true);
  } catch (const InputError&) {
    return nullptr;
  } catch (const SolverError&) {
    return nullptr;
  }
  return coarse;
}

}  // namespace lapwing
