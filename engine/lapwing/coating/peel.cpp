#include "lapwing/coating/peel.h"

#include "lapwing/coating/fairing.h"
#include "lapwing/coating/ring_areas.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

std::vector<Vector3d> patch_normals(const Patch& patch, const Topology& topology,
                                    std::span<const Vector3d> positions) {
  std::vector<Vector3d> normals(positions.size(), Vector3d::Zero());
  vertex_normals(positions, topology.triangles, topology.vertex_triangles, patch.vertices, normals);
  return on_patch<Vector3d>(patch, normals);
}

std::vector<Vector3d> patch_curvature(const Patch& patch, const Topology& topology,
                                      std::span<const Vector3d> positions,
                                      std::span<const Vector3d> displacement,
                                      LaplacianWeights scheme, Kernels& kernels) {
  const auto weights = laplacian_weights(topology, positions, scheme);
  std::vector<Vector3d> xi(patch.vertices.size());
  kernels.sample_laplacians({displacement, topology.rings, weights, patch.vertices}, xi);
  const auto squares = squared_rings(topology.rings, weights, positions, patch.vertices);
  std::vector<Vector3d> curvature(positions.size(), Vector3d::Zero());
  for (std::size_t own = 0; own < xi.size(); ++own) {
    curvature[patch.vertices[own]] = 4.0 / squares[own] * xi[own];
  }
  return on_patch<Vector3d>(patch, curvature);
}

// `displacement` per vertex of the mesh.
Coating coating_of(Patch patch, std::span<const Vector3d> positions, const Topology& topology,
                   std::span<const Vector3d> smooth, std::span<const Vector3d> displacement,
                   LaplacianWeights weights, Kernels& kernels) {
  Coating coating;
  coating.positions = on_patch<Vector3d>(patch, positions);
  coating.smooth = on_patch<Vector3d>(patch, smooth);
  coating.normals = patch_normals(patch, topology, smooth);
  coating.displacement = on_patch<Vector3d>(patch, displacement);
  coating.curvature = patch_curvature(patch, topology, smooth, displacement, weights, kernels);
  coating.patch = std::move(patch);
  return coating;
}

}  // namespace

Coating peel(Patch patch, std::span<const Vector3d> positions, const Topology& topology,
             double detail_size, LaplacianWeights weights, Kernels& kernels) {
  const Positions smooth =
      smooth_around(patch.vertices, detail_size, positions, topology, weights, "detail_size");
  std::vector<Vector3d> displacement(positions.size());
  for (std::size_t v = 0; v < displacement.size(); ++v) displacement[v] = positions[v] - smooth[v];
  Coating coating =
      coating_of(std::move(patch), positions, topology, smooth, displacement, weights, kernels);
  coating.detail_size = detail_size;
  return coating;
}

Coating whole_shape(Patch patch, std::span<const Vector3d> positions, const Topology& topology,
                    double frame_size, LaplacianWeights weights, Kernels& kernels) {
  const Positions smooth =
      smooth_around(patch.vertices, frame_size, positions, topology, weights, "frame_size");
  Vector3d mean = Vector3d::Zero();
  for (const Index v : patch.vertices) mean += positions[v];
  mean /= static_cast<double>(patch.vertices.size());
  std::vector<Vector3d> from_mean(positions.begin(), positions.end());
  for (Vector3d& p : from_mean) p -= mean;
  return coating_of(std::move(patch), positions, topology, smooth, from_mean, weights, kernels);
}

}  // namespace lapwing
