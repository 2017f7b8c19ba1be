#pragma once

#include <string>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::test {

/// A mesh with the data that the kernels read.
struct Sample {
  Sample(std::string sample_name, Mesh sample_mesh);

  RingProblem problem() const { return {mesh.positions, topology.rings, weights, vertices}; }

  std::string name;
  Mesh mesh;
  Topology topology;
  std::vector<double> weights;  ///< uniform
  std::vector<Index> vertices;  ///< all
};

/// Returns meshes that are difficult for loops and formulas: an empty mesh, an isolated vertex,
/// collinear and coincident one-rings, boundaries, a fan of 40 triangles, and meshes that are far
/// from the origin, very small or very large.
std::vector<Sample> awkward_meshes();

/// Returns an icosphere whose vertices are moved at random by up to `amount` along each axis.
Mesh rough_sphere(int subdivisions, double amount, unsigned seed);

}  // namespace lapwing::test
