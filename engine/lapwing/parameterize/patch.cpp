#include "lapwing/parameterize/patch.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/disk_report.h"
#include "lapwing/region/largest_disk.h"

namespace lapwing {
namespace {

// Appends the parts of a triangle. `middles[k]` is the midpoint of edge k, or kNoIndex.
void split(const Triangle& triangle, const Triangle& middles, std::vector<Triangle>& parts) {
  const auto halved = static_cast<int>(middles[0] != kNoIndex) +
                      static_cast<int>(middles[1] != kNoIndex) +
                      static_cast<int>(middles[2] != kNoIndex);
  // Rotate the corners so that the halved edges come first.
  std::size_t first = 0;
  if (halved == 1) {
    while (middles[first] == kNoIndex) ++first;
  } else if (halved == 2) {
    while (middles[(first + 2) % 3] != kNoIndex) ++first;
  }
  const auto at = [&](const Triangle& list, std::size_t k) { return list[(first + k) % 3]; };
  const Index a = at(triangle, 0);
  const Index b = at(triangle, 1);
  const Index c = at(triangle, 2);
  const Index ab = at(middles, 0);
  const Index bc = at(middles, 1);
  const Index ca = at(middles, 2);
  if (halved == 0) {
    parts.push_back(triangle);
  } else if (halved == 1) {
    parts.push_back({a, ab, c});
    parts.push_back({ab, b, c});
  } else if (halved == 2) {
    parts.push_back({ab, b, bc});
    // Choose the diagonal by vertex indices, which do not change when the mesh is rotated.
    if (a < c) {
      parts.push_back({a, ab, bc});
      parts.push_back({a, bc, c});
    } else {
      parts.push_back({a, ab, c});
      parts.push_back({ab, bc, c});
    }
  } else {
    parts.push_back({a, ab, ca});
    parts.push_back({ab, b, bc});
    parts.push_back({ca, bc, c});
    parts.push_back({ab, bc, ca});
  }
}

// Splits every inner edge of the patch that joins two vertices of its loop at its midpoint, and
// splits the triangles on both sides. The patch must not have been split before. `sides` is the
// result of sides_by_edge for its triangles.
void halve_chords(Patch& patch, const Adjacency& sides) {
  std::vector<char> on_loop(patch.vertices.size(), 0);
  for (const Index v : patch.loop) on_loop[v] = 1;
  std::vector<Index> middles(3 * patch.triangles.size(), kNoIndex);
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    if (sides.size(e) == 1) continue;
    const Index from = side_start(patch.triangles, sides[e][0]);
    const Index to = side_end(patch.triangles, sides[e][0]);
    if (on_loop[from] == 0 || on_loop[to] == 0) continue;
    for (const Index side : sides[e]) middles[side] = static_cast<Index>(patch.size());
    patch.midpoint_of.push_back({std::min(from, to), std::max(from, to)});
  }
  if (patch.midpoint_of.empty()) return;
  const std::vector<Triangle> whole = std::exchange(patch.triangles, {});
  const std::vector<Index> sources = std::exchange(patch.triangle_sources, {});
  for (std::size_t t = 0; t < whole.size(); ++t) {
    split(whole[t], {middles[3 * t], middles[3 * t + 1], middles[3 * t + 2]}, patch.triangles);
    patch.triangle_sources.resize(patch.triangles.size(), sources[t]);
  }
}

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
