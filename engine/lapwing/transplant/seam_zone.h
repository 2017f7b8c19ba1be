#pragma once

#include <vector>

#include "lapwing/region/edit_region.h"
#include "lapwing/transplant/reconstruct_seam.h"

namespace lapwing {

/// The vertices around the seam that take part in its reconstruction.
struct SeamZone {
  BoundaryLoop seam;  ///< the hole's loop, numbers of the joined mesh
  /// Per vertex of the joined mesh: distance on the host from the seam, on the part from its loop.
  std::vector<double> distances;
  EditRegion region;  ///< the unknowns, and those of them that are held
};

/// Linear in the joined mesh. Does not read `joined.geometry`.
SeamZone seam_zone(const TransplantHost& host, const TransplantJoined& joined,
                   const TransplantOptions& options);

/// Returns the distance from its loop up to which the part is free.
double free_on_part(const TransplantOptions& options);

/// Features larger than this are shape, which continues smoothly over the seam.
double shape_size(const TransplantOptions& options);

/// Features smaller than this are detail. Those in between are as large as the region cut out and
/// the part put in.
double detail_size(const TransplantOptions& options);

}  // namespace lapwing
