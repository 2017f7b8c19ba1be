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
  BoundaryLoop seam;  ///< the hole's loop, as vertices of the joined mesh
  /// Per vertex of the joined mesh: on the host, the distance from the seam; on the part, from its
  /// loop.
  std::vector<double> distances;
  EditRegion region;  ///< ROI and belt
};

/// Returns the zone in time linear in the joined mesh. Does not read `joined.geometry`.
SeamZone seam_zone(const TransplantHost& host, const TransplantJoined& joined,
                   const TransplantOptions& options);

/// Returns the width of the free zone of the part, from its loop.
double free_on_part(const TransplantOptions& options);

/// Returns the size above which features are shape, which continues smoothly over the seam.
double shape_size(const TransplantOptions& options);

/// Returns the size below which features are detail. Features between both sizes are about as large
/// as the removed region and the part.
double detail_size(const TransplantOptions& options);

/// The two collars of the transition of a transplant.
struct SeamCollars {
  Collar below;  ///< on the removed region, as vertices of the host
  Collar above;  ///< on the part, as vertices of the joined mesh
};

/// Returns, per host vertex, the geodesic distance from the hole's rim inside the removed region;
/// infinity elsewhere.
std::vector<double> distances_in_cut(const TransplantHost& host);

/// Returns the hole's loop as vertices of the joined mesh.
BoundaryLoop seam_of(const TransplantHost& host, const TransplantJoined& joined);

/// Returns the collars of a transition of `width`, given the results of `seam_of` and
/// `distances_in_cut`. Does not read `joined.geometry`. Throws the errors of `make_collar`.
/// Near-linear.
SeamCollars seam_collars(const TransplantHost& host, const TransplantJoined& joined,
                         const BoundaryLoop& seam, std::span<const double> cut_distances,
                         double width, const std::string& where);

/// Returns the largest of `width` and some smaller widths for which `seam_collars` succeeds, or
/// `width` if it always fails. Near-linear per tried width.
double width_that_fits(const TransplantHost& host, const TransplantJoined& joined, double width);

}  // namespace lapwing
