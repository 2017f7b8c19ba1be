#pragma once

#include <vector>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// The unknowns of an edit, and how firmly each is held to its prescribed displacement.
struct Constraints {
  Unknowns unknowns;
  std::vector<double> W;  ///< per unknown: squared weight on handle and belt, less if a handle is
                          ///< graded, 0 elsewhere
};

/// Returns the share of the full stiffness for a graded weight from 0 to 1: its fourth power.
/// Against the bending of the surface, a stiffness W holds shapes longer than W^(-1/4) edges. So a
/// weight of 1/2 holds shapes longer than 2 edges, 1/10 those longer than 10. On a sheet with a
/// falloff 24 edges wide, the surface follows by 1, 0.84 and 0.25 at half, three quarters and all
/// of its width.
double stiffness_of(double weight);

/// Returns the constraints of a region. If they are soft, the region's vertices are the unknowns.
/// If they are hard, only free vertices are, and the motion of handle and belt is given. The motion
/// of vertices with hard targets is given in either case. Soft targets and points in triangles are
/// springs. Vertices without a ring that nothing holds stay, and are not unknowns.
Constraints constraints_of(const EditRegion& region, const Topology& topology, double weight,
                           bool hard);

}  // namespace lapwing
