#pragma once

#include <string>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::test {

/// A mesh with the input of the kernels.
struct Sample {
  Sample(std::string sample_name, Mesh sample_mesh);

  RingProblem problem() const { return {mesh.positions, topology.rings, weights, vertices}; }

  std::string name;
  Mesh mesh;
  Topology topology;
  std::vector<double> weights;  ///< uniform
  std::vector<Index> vertices;  ///< all
};

/// Returns meshes at which loops and formulas break: no vertex, a loose vertex, rings on a line or
/// in a point, boundaries, a fan of 40, far from the origin, very small, very large.
std::vector<Sample> awkward_meshes();

/// Returns an icosphere whose vertices are moved at random by up to `amount` along each axis.
Mesh rough_sphere(int subdivisions, double amount, unsigned seed);

}  // namespace lapwing::test
