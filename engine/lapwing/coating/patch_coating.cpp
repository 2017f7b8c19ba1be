#include "lapwing/coating/patch_coating.h"

#include <utility>

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

// Returns the coating of `patch`, with the displacement that `displacement_on` returns for its
// vertices in the part.
template <class DisplacementOn>
Coating coating_of(Patch patch, const SmoothedPart& smoothed, LaplacianWeights weights,
                   Kernels& kernels, const DisplacementOn& displacement_on) {
  const auto& [part, rest, smooth] = smoothed;
  const VertexSet in_mesh = std::exchange(patch.vertices, own_numbers(part, patch.vertices));
  const std::vector<Vector3d> displacement = displacement_on(patch.vertices);
  Coating coating;
  coating.positions = on_patch<Vector3d>(patch, rest);
  coating.smooth = on_patch<Vector3d>(patch, smooth);
  coating.normals = patch_normals(patch, part.topology, smooth);
  coating.displacement = on_patch<Vector3d>(patch, displacement);
  coating.curvature = patch_curvature(patch, part.topology, smooth, displacement, weights, kernels);
  patch.vertices = in_mesh;
  coating.patch = std::move(patch);
  return coating;
}

}  // namespace

Coating peel_patch(Patch patch, std::span<const Vector3d> positions, const Topology& topology,
                   double detail_size, LaplacianWeights weights, Kernels& kernels) {
  const SmoothedPart smoothed =
      smooth_part(patch.vertices, detail_size, positions, topology, weights, "detail_size");
  return coating_of(std::move(patch), smoothed, weights, kernels, [&](const VertexSet&) {
    std::vector<Vector3d> displacement = smoothed.rest;
    for (std::size_t v = 0; v < displacement.size(); ++v) {
      displacement[v] -= smoothed.smooth[v];
    }
    return displacement;
  });
}

Coating whole_shape(Patch patch, std::span<const Vector3d> positions, const Topology& topology,
                    double frame_size, LaplacianWeights weights, Kernels& kernels) {
  const SmoothedPart smoothed =
      smooth_part(patch.vertices, frame_size, positions, topology, weights, "frame_size");
  return coating_of(std::move(patch), smoothed, weights, kernels, [&](const VertexSet& region) {
    Vector3d mean = Vector3d::Zero();
    for (const Index own : region) mean += smoothed.rest[own];
    mean /= static_cast<double>(region.size());
    std::vector<Vector3d> from_mean = smoothed.rest;
    for (Vector3d& p : from_mean) p -= mean;
    return from_mean;
  });
}

}  // namespace lapwing
