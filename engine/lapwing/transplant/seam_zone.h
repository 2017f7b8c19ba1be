#pragma once

#include <vector>

#include "lapwing/region/edit_region.h"
#include "lapwing/transplant/reconstruct_seam.h"

namespace lapwing {

/// Where things are along the way from the host over the seam to the part.
struct SeamZone {
  BoundaryLoop seam;  ///< the hole's loop, numbers of the joined mesh
  /// Per vertex of the joined mesh: from the seam on the host, from its loop on the part.
  std::vector<double> distances;
  EditRegion region;  ///< the unknowns, and those of them that are held
};

/// Linear in the joined mesh. `joined.geometry` is not read.
SeamZone seam_zone(const TransplantHost& host, const TransplantJoined& joined,
                   const TransplantOptions& options);

/// How far from its loop the part is free.
double free_on_part(const TransplantOptions& options);

/// What is larger than this is shape, which goes on smoothly over the seam.
double shape_size(const TransplantOptions& options);

/// What is smaller than this is detail. Whatever lies between the two is as large as what was cut
/// out and what comes.
double detail_size(const TransplantOptions& options);

}  // namespace lapwing
