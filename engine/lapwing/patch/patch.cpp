#include "lapwing/patch/patch.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/extent.h"
#include "lapwing/mesh/triangle_sides.h"
#include "lapwing/patch/halve_chords.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/disk_report.h"
#include "lapwing/region/largest_disk.h"

namespace lapwing {
namespace {

[[noreturn]] void fail_as_no_disk(const DiskReport& report, const VertexSet& region,
                                  const Topology& topology,
                                  std::span<const Eigen::Vector3d> positions,
                                  const std::string& where) {
  if (report.pieces.empty()) {
    throw InputError(where +
                     ": the region has no triangle with all three corners in it; choose a larger "
                     "region");
  }
  const std::size_t size = region.size() - report.loose.size();
  const std::size_t inside = largest_disk(region, topology, positions).size();
  throw InputError(where + ": the region is not a disk: it " + describe(report) +
                   ". Choose another region, or replace it by {\"disk_in\": REGION} to use the "
                   "largest disk inside, which has " +
                   std::to_string(inside) + " of its " + std::to_string(size) + " vertices");
}

}  // namespace

Index Patch::own_number(Index mesh_vertex) const {
  const auto at = std::lower_bound(vertices.begin(), vertices.end(), mesh_vertex);
  if (at == vertices.end() || *at != mesh_vertex) return kNoIndex;
  return static_cast<Index>(at - vertices.begin());
}

Patch disk_patch(const VertexSet& region, const Topology& topology,
                 std::span<const Eigen::Vector3d> positions, const std::string& where) {
  RegionTriangles part = region_triangles(region, topology);
  const Adjacency sides = sides_by_edge(part.triangles, part.vertices.size());
  const DiskReport report = report_disk(part, sides);
  if (!report.is_disk()) fail_as_no_disk(report, region, topology, positions, where);
  require_finite(part.vertices, positions, where);
  require_extent(part.vertices, positions, where);
  Patch patch;
  patch.vertices = std::move(part.vertices);
  patch.triangles = std::move(part.triangles);
  patch.triangle_sources = std::move(part.sources);
  patch.loop = boundary_loops(patch.triangles, sides, where).front();
  halve_chords(patch, sides);
  return patch;
}

VertexSet border_of(const Patch& patch) {
  std::vector<Index> border;
  border.reserve(patch.loop.size());
  for (const Index own : patch.loop) border.push_back(patch.vertices[own]);
  return make_vertex_set(std::move(border));
}

}  // namespace lapwing
