#pragma once

#include <vector>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// What an edit solves for, and how firmly each unknown is held to where it should be.
struct Constraints {
  Unknowns unknowns;
  std::vector<double> W;  ///< per unknown: the squared weight on handle and belt, less where a
                          ///< handle is graded, 0 elsewhere
};

/// The share of the full stiffness that a graded weight from 0 to 1 stands for: its fourth power. A
/// stiffness W, against the bending of the surface, holds what is longer than W^(-1/4) edges; so a
/// weight of 1/2 holds what is longer than 2 edges, 1/10 what is longer than 10. On a sheet whose
/// falloff is 24 edges wide, the surface goes along by 1, 0.84 and 0.25 at half, three quarters and
/// all of its width.
double stiffness_of(double weight);

/// Soft constraints: the unknowns are the region's vertices. Hard ones: only the free vertices; the
/// motion of handle and belt is given, likewise that of vertices with hard targets. Soft targets
/// and points in triangles are springs. Vertices without a ring that nothing holds are no unknowns:
/// they stay.
Constraints constraints_of(const EditRegion& region, const Topology& topology, double weight,
                           bool hard);

}  // namespace lapwing
