#pragma once

#include <memory>

#include "lapwing/deform/edit_system.h"
#include "lapwing/elastic/coarse_surfaces.h"

namespace lapwing {

/// An edit on a surface with fewer vertices: that of another edit with some of its vertices, held
/// and moved alike. The energy approaches an integral over the surface, so that what makes it least
/// there is near what makes it least here (EnergyWeights).
struct CoarseRegion {
  std::shared_ptr<CoarseLevel> level;
  std::unique_ptr<const EditSystem> edit;
};

/// With about `count` vertices in the region. Null where there is no such surface (CoarseSurfaces),
/// or where so few vertices hold it no more.
std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count);

}  // namespace lapwing
