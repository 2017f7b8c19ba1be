#include "lapwing/region/region_spec.h"

#include <limits>
#include <numeric>
#include <sstream>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/largest_disk.h"
#include "lapwing/region/loop_region.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

std::string in_words(const Vector3d& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

void require_vertex(Index v, const Mesh& mesh, const std::string& where) {
  if (v < mesh.vertex_count()) return;
  throw InputError(where + ": vertex " + std::to_string(v) + " is not in the mesh, which has " +
                       std::to_string(mesh.vertex_count()) + " vertices (numbered from 0)",
                   {v});
}

void require_vertices(const std::vector<Index>& vertices, const Mesh& mesh,
                      const std::string& where) {
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    require_vertex(vertices[k], mesh, where + "/" + std::to_string(k));
  }
}

Index nearest_vertex_with_ring(const Vector3d& point, const Mesh& mesh, const std::string& where) {
  const Adjacency& rings = mesh.topology().rings;
  Index nearest = kNoIndex;
  double least = std::numeric_limits<double>::infinity();
  CancelCheck cancel_check;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    cancel_check();
    if (rings.size(v) == 0) continue;
    const double squared = (mesh.positions[v] - point).squaredNorm();
    if (squared < least) {
      least = squared;
      nearest = v;
    }
  }
  if (nearest == kNoIndex) {
    throw InputError(where +
                     ": the mesh has no triangle with a finite vertex to start a disk from; "
                     "run `lapwing check` on it");
  }
  return nearest;
}

// One overload per form.
struct Resolver {
  const Mesh& mesh;
  const std::string& where;

  VertexSet operator()(const AllVertices&) const {
    VertexSet all(mesh.vertex_count());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }

  VertexSet operator()(const ListedVertices& list) const {
    require_vertices(list.vertices, mesh, where + "/vertices");
    return make_vertex_set(list.vertices);
  }

  VertexSet operator()(const GeodesicDisk& disk) const {
    Index center = kNoIndex;
    if (const auto* number = std::get_if<Index>(&disk.center)) {
      require_vertex(*number, mesh, where + "/disk/center");
      center = *number;
    } else {
      center =
          nearest_vertex_with_ring(std::get<Vector3d>(disk.center), mesh, where + "/disk/near");
    }
    const std::vector<double> distances =
        geodesic_distances(mesh.topology(), mesh.positions, std::span(&center, 1), disk.radius);
    VertexSet vertices;
    for (Index v = 0; v < distances.size(); ++v) {
      if (distances[v] < kNoLimit) vertices.push_back(v);
    }
    return vertices;
  }

  VertexSet operator()(const Box& box) const {
    VertexSet vertices;
    CancelCheck cancel_check;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      cancel_check();
      const Vector3d& p = mesh.positions[v];
      if ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all()) {
        vertices.push_back(v);
      }
    }
    if (vertices.empty()) {
      const Bounds bounds = bounds_of(mesh.positions);
      throw InputError(where + "/box: no vertex lies in the box; the mesh spans " +
                       in_words(bounds.min) + " to " + in_words(bounds.max) +
                       ". Move or enlarge the box");
    }
    return vertices;
  }

  VertexSet operator()(const LoopRegion& region) const {
    if (region.loop.size() < 3) {
      throw InputError(where + "/loop: a loop needs at least 3 vertices, got " +
                       std::to_string(region.loop.size()));
    }
    require_vertices(region.loop, mesh, where + "/loop");
    require_vertex(region.inside, mesh, where + "/inside");
    return resolve_loop(region, where, mesh);
  }

  VertexSet operator()(const UnionRegion& region) const {
    VertexSet vertices;
    for (const RegionSpec& part : region.parts) {
      vertices = unite(vertices, resolve(part, mesh));
    }
    return vertices;
  }

  VertexSet operator()(const DifferenceRegion& region) const {
    if (region.parts.empty()) return {};
    VertexSet vertices = resolve(region.parts.front(), mesh);
    for (std::size_t k = 1; k < region.parts.size(); ++k) {
      vertices = subtract(vertices, resolve(region.parts[k], mesh));
    }
    if (vertices.empty()) {
      throw InputError(where + "/minus: no vertices of the first region remain; subtract less");
    }
    return vertices;
  }

  VertexSet operator()(const DiskInRegion& region) const {
    if (region.parts.empty()) return {};
    VertexSet vertices =
        largest_disk(resolve(region.parts.front(), mesh), mesh.topology(), mesh.positions);
    if (vertices.empty()) {
      throw InputError(where +
                       "/disk_in: no triangle has its three corners in the region; choose a larger "
                       "one");
    }
    return vertices;
  }
};

}  // namespace

bool operator==(const UnionRegion& a, const UnionRegion& b) {
  return a.parts == b.parts;
}
bool operator==(const DifferenceRegion& a, const DifferenceRegion& b) {
  return a.parts == b.parts;
}
bool operator==(const DiskInRegion& a, const DiskInRegion& b) {
  return a.parts == b.parts;
}

VertexSet resolve(const RegionSpec& spec, const Mesh& mesh) {
  return std::visit(Resolver{mesh, spec.where}, spec.form);
}

}  // namespace lapwing
