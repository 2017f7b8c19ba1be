#include "lapwing/coating/coating.h"

#include <algorithm>
#include <span>
#include <utility>

#include "lapwing/coating/fairing.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

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

// Returns the coating of `patch`. `displacement_on` returns the displacement, given the patch's
// vertices in the submesh.
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

// The target as mapped to the source, per vertex of the target's mesh; 0 if a vertex has no image.
struct LaidTarget {
  LaidTarget(const MappedRings& mapped, const Coating& coating, std::size_t vertex_count)
      : positions(vertex_count, Vector3d::Zero()), displacement(vertex_count, Vector3d::Zero()) {
    for (std::size_t own = 0; own < mapped.target.vertices.size(); ++own) {
      const Index v = mapped.target.vertices[own];
      positions[v] = mapped.points[own].of(std::span(coating.smooth));
      displacement[v] = mapped.points[own].of(std::span(coating.displacement));
    }
  }
  Positions positions;  // on the smooth source
  std::vector<Vector3d> displacement;
};

bool lies_on_source(const MappedRings& mapped, std::size_t row) {
  const auto& [target, points] = mapped;
  if (points[row].is_nowhere()) return false;
  const auto ring = std::span(target.neighbours)
                        .subspan(target.starts[row], target.starts[row + 1] - target.starts[row]);
  return std::none_of(ring.begin(), ring.end(),
                      [&](Index j) { return mapped.points[j].is_nowhere(); });
}

// Adds r^2 / 4 c - L' d, where L' is the Laplacian of the rings as mapped to the source.
void add_interpolated(const MappedRings& mapped, const Coating& coating, const Topology& topology,
                      LaplacianWeights scheme, Kernels& kernels, std::vector<Vector3d>& xi) {
  std::vector<Vector3d> curvature(xi.size());
  kernels.sample_mapped_laplacians(mapped, MappedSampling::linear, coating.curvature, curvature);
  std::vector<std::size_t> rows;
  std::vector<Index> vertices;
  for (std::size_t r = 0; r < xi.size(); ++r) {
    if (!lies_on_source(mapped, r)) continue;
    rows.push_back(r);
    vertices.push_back(mapped.target.vertices[r]);
  }
  const LaidTarget laid(mapped, coating, topology.vertex_count());
  const auto weights = laplacian_weights(topology, laid.positions, scheme);
  const auto squares = squared_rings(topology.rings, weights, laid.positions, vertices);
  std::vector<Vector3d> faceted(rows.size());
  kernels.sample_laplacians({laid.displacement, topology.rings, weights, vertices}, faceted);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    xi[rows[k]] += 0.25 * squares[k] * curvature[rows[k]] - faceted[k];
  }
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

std::vector<Vector3d> sample_coating(const MappedRings& mapped, const Coating& coating,
                                     MappedSampling sampling, const Topology& topology,
                                     LaplacianWeights weights, Kernels& kernels) {
  std::vector<Vector3d> xi(mapped.target.row_count());
  kernels.sample_mapped_laplacians(mapped, MappedSampling::one_ring, coating.displacement, xi);
  if (sampling == MappedSampling::linear) {
    add_interpolated(mapped, coating, topology, weights, kernels, xi);
  }
  return xi;
}

}  // namespace lapwing
