#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/region/edit_region.h"
#include "lapwing/transplant/collar.h"
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

/// The collars on which the transition of a transplant lies.
struct SeamCollars {
  Collar below;  ///< of the region cut from the host; numbers of the host
  Collar above;  ///< of the part; numbers of the joined mesh
};

/// Returns, per host vertex, the distance from the hole's rim within the cut; infinity elsewhere.
std::vector<double> distances_in_cut(const TransplantHost& host);

/// Returns the hole's loop in numbers of the joined mesh.
BoundaryLoop seam_of(const TransplantHost& host, const TransplantJoined& joined);

/// Returns the collars of a transition of `width`, given the results of `seam_of` and
/// `distances_in_cut`. Does not read `joined.geometry`. Throws what `make_collar` throws.
/// Near-linear.
SeamCollars seam_collars(const TransplantHost& host, const TransplantJoined& joined,
                         const BoundaryLoop& seam, std::span<const double> cut_distances,
                         double width, const std::string& where);

/// Returns the largest width that `seam_collars` accepts among `width` and a few shares of it, or
/// `width` if it accepts none. Near-linear per width tried.
double width_that_fits(const TransplantHost& host, const TransplantJoined& joined, double width);

}  // namespace lapwing
