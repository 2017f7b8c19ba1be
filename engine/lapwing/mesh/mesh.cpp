#include "lapwing/mesh/mesh.h"

#include <optional>
#include <sstream>
#include <stdexcept>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

const Faces Mesh::kNoFaces;
const MeshAttributes Mesh::kNoAttributes;

Faces& Mesh::edit_faces() {
  if (!connectivity_ || connectivity_.use_count() > 1 || connectivity_->topology) {
    auto own = std::make_shared<Connectivity>();
    own->faces = faces();
    connectivity_ = std::move(own);
  }
  return connectivity_->faces;
}

MeshAttributes& Mesh::edit_attributes() {
  if (!attributes_ || attributes_.use_count() > 1) {
    attributes_ = std::make_shared<MeshAttributes>(attributes());
  }
  return *attributes_;
}

const Topology& Mesh::topology() const& {
  return *shared_topology();
}

std::shared_ptr<const Topology> Mesh::shared_topology() const {
  if (!connectivity_) throw std::logic_error("a mesh that was moved from has no topology");
  connectivity_->building(
      [&] { connectivity_->topology = std::make_shared<const Topology>(build_topology(*this)); });
  if (connectivity_->topology->vertex_count() != vertex_count()) {
    throw std::logic_error(
        "vertices were added or removed after the topology of the mesh was built; "
        "call edit_faces() after such a change");
  }
  return connectivity_->topology;
}

Bounds bounds_of(std::span<const Eigen::Vector3d> positions) {
  Bounds bounds;
  bool first = true;
  for (const Eigen::Vector3d& p : positions) {
    if (!p.allFinite()) continue;
    bounds.min = first ? p : Eigen::Vector3d(bounds.min.cwiseMin(p));
    bounds.max = first ? p : Eigen::Vector3d(bounds.max.cwiseMax(p));
    first = false;
  }
  return bounds;
}

Bounds united(const Bounds& a, const Bounds& b) {
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

void validate_indices(const Mesh& mesh) {
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    for (const Index v : mesh.face(f)) {
      if (v >= mesh.vertex_count()) {
        throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                             ", but the mesh has " + std::to_string(mesh.vertex_count()) +
                             " vertices (numbered from 0); remove the face or add the vertex",
                         {v});
      }
    }
  }
}

void require_finite(const Mesh& mesh) {
  for (const Index v : mesh.face_vertices()) {
    if (mesh.positions[v].allFinite()) continue;
    throw InputError("vertex " + std::to_string(v) +
                         " has a coordinate that is not finite; repair the mesh with `lapwing "
                         "check MESH --fix OUT`",
                     {v});
  }
}

double require_extent(std::span<const Index> vertices, std::span<const Eigen::Vector3d> positions,
                      const std::string& where) {
  std::optional<Bounds> bounds;
  for (const Index v : vertices) {
    const Eigen::Vector3d& p = positions[v];
    if (!p.allFinite()) continue;
    if (!bounds) bounds = {p, p};
    bounds->min = bounds->min.cwiseMin(p);
    bounds->max = bounds->max.cwiseMax(p);
  }
  if (!bounds) return 0.0;
  // The squared diagonal overflows long before a coordinate does.
  const double extent = (bounds->max - bounds->min).maxCoeff();
  if (extent == 0.0 || (extent >= kSmallestExtent && extent <= kLargestExtent)) return extent;
  std::ostringstream text;
  text << where << ": the vertices span " << extent << ", outside the supported range from "
       << kSmallestExtent << " to " << kLargestExtent << "; scale the mesh";
  throw InputError(text.str());
}

}  // namespace lapwing
