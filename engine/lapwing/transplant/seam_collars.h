#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/transplant/collar.h"
#include "lapwing/transplant/reconstruct_seam.h"

namespace lapwing {

/// What the transition of a transplant lies on, on both sides of the seam.
struct SeamCollars {
  Collar below;  ///< of what was cut from the host; numbers of the host
  Collar above;  ///< of the part; numbers of the joined mesh
};

/// Per vertex of the host: from the hole's rim inwards, through what was cut; infinity elsewhere.
std::vector<double> distances_in_cut(const TransplantHost& host);

/// The hole's loop in numbers of the joined mesh.
BoundaryLoop seam_of(const TransplantHost& host, const TransplantJoined& joined);

/// The collars of a transition of `width`. `seam` is `seam_of` both, `cut_distances` are
/// `distances_in_cut`. `joined.geometry` is not read. Throws what `make_collar` does. Near-linear.
SeamCollars seam_collars(const TransplantHost& host, const TransplantJoined& joined,
                         const BoundaryLoop& seam, std::span<const double> cut_distances,
                         double width, const std::string& where);

/// The largest of `width` and a few shares of it for which `seam_collars` finds both; `width` where
/// that is none of them. As often near-linear as it looks.
double width_that_fits(const TransplantHost& host, const TransplantJoined& joined, double width);

}  // namespace lapwing
