#include "lapwing/coating/peel.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

void set_property(Mesh& mesh, const std::string& name, std::vector<double> values) {
  auto& extras = mesh.edit_attributes().vertex_extras;
  std::erase_if(extras, [&](const ExtraAttribute& e) { return e.name == name; });
  extras.push_back({name, "double", 1, std::move(values)});
}

void set_vectors(Mesh& mesh, std::span<const Vector3d> vectors) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vector3d& vector : vectors) values.push_back(vector[axis]);
    set_property(mesh, std::string("coating_") + "xyz"[axis], std::move(values));
  }
}

// Returns the components of the displacements along the normals of the smooth surface.
std::vector<double> coating_heights(const Mesh& mesh, const Peeled& peeled) {
  const Topology& topology = mesh.topology();
  std::vector<Vector3d> normals(mesh.vertex_count(), Vector3d::Zero());
  vertex_normals(peeled.mesh.positions, topology.triangles, topology.vertex_triangles,
                 resolve({}, mesh), normals);
  std::vector<double> heights;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    heights.push_back(peeled.displacement[v].dot(normals[v]));
  }
  return heights;
}

std::vector<Vector3d> coating_laplacians(const Mesh& mesh, const Peeled& peeled,
                                         LaplacianWeights scheme) {
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, scheme);
  const VertexSet all = resolve({}, mesh);
  std::vector<Vector3d> xi(mesh.vertex_count());
  CpuKernels().sample_laplacians({peeled.displacement, topology.rings, weights, all}, xi);
  return xi;
}

}  // namespace

Peeled peel(const Mesh& mesh, const PeelRequest& request, const Progress& progress) {
  const ProgressScope scope(progress);
  const Topology& topology = mesh.topology();
  const VertexSet region = resolve(request.region, mesh);
  require_finite(region, mesh.positions, request.region.where);
  require_extent(region, mesh.positions, request.region.where);
  const Fairing fairing(mesh.positions, topology, region, request.weights);
  Peeled peeled;
  peeled.mesh = mesh;
  peeled.mesh.positions = fairing.smooth(request.detail_size, request.where.c_str());
  peeled.moved = fairing.free();
  peeled.displacement.assign(mesh.vertex_count(), Vector3d::Zero());
  double squares = 0.0;
  for (const Index v : peeled.moved) {
    peeled.displacement[v] = mesh.positions[v] - peeled.mesh.positions[v];
    squares += peeled.displacement[v].squaredNorm();
    peeled.largest_coating = std::max(peeled.largest_coating, peeled.displacement[v].norm());
  }
  if (peeled.moved.empty()) {
    peeled.warnings.push_back(request.region.where +
                              ": every vertex of the region is on its boundary, which stays "
                              "fixed, so no detail was removed; choose a larger region");
    return peeled;
  }
  peeled.mean_coating = std::sqrt(squares / static_cast<double>(peeled.moved.size()));
  return peeled;
}

Mesh with_coating(const Mesh& mesh, const PeelRequest& request, const Peeled& peeled,
                  CarriedCoating carried) {
  Mesh result = peeled.mesh;
  result.source.reset();
  switch (carried) {
    case CarriedCoating::displacement:
      set_vectors(result, peeled.displacement);
      break;
    case CarriedCoating::height:
      set_property(result, "coating_height", coating_heights(mesh, peeled));
      break;
    case CarriedCoating::laplacians:
      set_vectors(result, coating_laplacians(mesh, peeled, request.weights));
      break;
  }
  return result;
}

}  // namespace lapwing
