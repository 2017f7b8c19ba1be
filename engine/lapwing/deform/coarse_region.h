#pragma once

#include <memory>

#include "lapwing/deform/edit_system.h"
#include "lapwing/elastic/coarse_surfaces.h"

namespace lapwing {

/// The same edit on a decimated surface. Its minimum is close to that of the fine surface, since
/// both energies approximate one integral (EnergyWeights).
struct CoarseRegion {
  std::shared_ptr<CoarseLevel> level;
  std::unique_ptr<const EditSystem> edit;
};

/// Returns a decimated edit with about `count` vertices in the region. Returns null if the region
/// cannot be decimated (CoarseSurfaces), or if the remaining vertices no longer anchor it.
std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count);

}  // namespace lapwing
