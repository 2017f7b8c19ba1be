#include "lapwing/fill/fill_holes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/fill/fair_patches.h"
#include "lapwing/fill/hole_attributes.h"
#include "lapwing/fill/triangulate_rim.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/remesh/isotropic.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The first refinement starts from a flat fill, whose edges become too long when fairing makes the
// fill round. The second refinement corrects this. A third would move the cap of a sphere by at
// most 1 % of its height.
constexpr int kRounds = 2;
// The largest number of rim points that define the edge lengths inside. More points make no visible
// difference.
constexpr std::size_t kMostSizes = 200;

bool has_edge(const Topology& topology, Index a, Index b) {
  return std::ranges::binary_search(topology.rings[a], b);
}

// Returns whether `a` and `b` are neighbours on a rim of n points.
bool are_consecutive(Index a, Index b, std::size_t n) {
  return (a + 1) % n == b || (b + 1) % n == a;
}

// Returns a diagonal of the patch that is also an edge of the surface.
std::optional<std::array<Index, 2>> repeated_edge(const HolePatch& patch, const Hole& hole,
                                                  const Topology& topology) {
  const std::size_t n = hole.rim.size();
  for (const Triangle& t : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if (a >= n || b >= n || are_consecutive(a, b, n)) continue;
      if (has_edge(topology, hole.rim[a], hole.rim[b])) return std::array{a, b};
    }
  }
  return {};
}

// Adds a vertex in the middle of every diagonal that is also an edge of the surface.
void split_repeated_edges(HolePatch& patch, const Hole& hole, const Topology& topology) {
  while (const auto edge = repeated_edge(patch, hole, topology)) {
    const auto [a, b] = *edge;
    const auto middle = static_cast<Index>(patch.points.size());
    patch.points.push_back(0.5 * (patch.points[a] + patch.points[b]));
    for (std::size_t k = 0, count = patch.triangles.size(); k < count; ++k) {
      const Triangle t = patch.triangles[k];
      if (std::ranges::find(t, a) == t.end() || std::ranges::find(t, b) == t.end()) continue;
      std::ranges::replace(patch.triangles[k], a, middle);
      patch.triangles.push_back(t);
      std::ranges::replace(patch.triangles.back(), b, middle);
    }
  }
}

HolePatch flat_patch(const Mesh& surface, const Hole& hole) {
  HolePatch patch;
  for (const Index v : hole.rim) patch.points.push_back(surface.positions[v]);
  const Topology& topology = surface.topology();
  patch.triangles = triangulate_rim(
      patch.points, [&](Index a, Index b) { return has_edge(topology, hole.rim[a], hole.rim[b]); });
  split_repeated_edges(patch, hole, topology);
  return patch;
}

// Returns the edge length for a point inside a hole. It is interpolated from the mean edge lengths
// at the vertices of the rim.
class RimSizes {
 public:
  RimSizes(const Mesh& surface, const Hole& hole) {
    const Adjacency& rings = surface.topology().rings;
    const std::size_t step = (hole.rim.size() + kMostSizes - 1) / kMostSizes;
    for (std::size_t k = 0; k < hole.rim.size(); k += step) {
      const Index v = hole.rim[k];
      double sum = 0.0;
      for (const Index j : rings[v]) sum += (surface.positions[j] - surface.positions[v]).norm();
      points_.push_back(surface.positions[v]);
      lengths_.push_back(sum / static_cast<double>(rings.size(v)));
    }
  }

  double operator()(const Vector3d& point) const {
    const std::vector<double> weights = rim_weights(points_, point);
    return std::inner_product(weights.begin(), weights.end(), lengths_.begin(), 0.0);
  }

 private:
  std::vector<Vector3d> points_;
  std::vector<double> lengths_;
};

void refine(HolePatch& patch, const Hole& hole, const Mesh& surface, const Progress& progress) {
  Mesh alone;
  alone.positions = patch.points;
  for (const Triangle& t : patch.triangles) alone.add_face(t);
  std::vector<Index> all(patch.points.size());
  std::iota(all.begin(), all.end(), Index{0});
  // The bends of a flat fill are not features.
  const RemeshOptions options{.feature_angle_degrees = 180.0};
  const Mesh finer = remesh_isotropic(alone, all, RimSizes(surface, hole), options, progress).mesh;
  // Points of the rim are on the border of `alone`, so remeshing keeps them at the start of the
  // list.
  patch.points = finer.positions;
  patch.triangles = finer.topology().triangles;
  split_repeated_edges(patch, hole, surface.topology());
}

// Returns the surface with all patches, without attributes.
Mesh with_patches(const Mesh& surface, std::span<const Hole> holes,
                  std::span<const HolePatch> patches) {
  Mesh filled;
  filled.positions = surface.positions;
  filled.edit_faces() = surface.faces();
  append_patches(filled, holes, patches);
  return filled;
}

void fair(std::vector<HolePatch>& patches, const Mesh& surface, std::span<const Hole> holes) {
  Mesh filled = with_patches(surface, holes, patches);
  auto next = static_cast<Index>(surface.vertex_count());
  fair_patches(filled, next);
  for (std::size_t k = 0; k < holes.size(); ++k) {
    for (std::size_t i = holes[k].rim.size(); i < patches[k].points.size(); ++i) {
      patches[k].points[i] = filled.positions[next++];
    }
  }
}

void require_fillable(std::span<const Hole> holes, const Mesh& mesh) {
  for (const Hole& hole : holes) {
    if (!hole.trouble.empty()) {
      throw InputError(name_hole(hole) + " cannot be filled: " + hole.trouble, hole.rim);
    }
    require_extent(hole.rim, mesh.positions, name_hole(hole));
  }
  if (!holes.empty()) require_finite(mesh);
}

}  // namespace

FilledHoles fill_holes(const Mesh& mesh, std::span<const Hole> holes, FillShape shape,
                       const Progress& progress) {
  const ProgressScope scope(progress);
  require_fillable(holes, mesh);
  const JoinedSurface joined = joined_surface(mesh);
  const Mesh& surface = joined.empty() ? mesh : joined.surface;
  std::vector<HolePatch> patches;
  for (const Hole& hole : holes) patches.push_back(flat_patch(surface, hole));
  const int rounds = shape == FillShape::smooth ? kRounds : 0;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < holes.size(); ++k) {
      const double done = round + static_cast<double>(k) / static_cast<double>(holes.size());
      refine(patches[k], holes[k], surface, [&](std::string_view, double) {
        report_progress(progress, "fill", done / rounds);
        return true;
      });
    }
    fair(patches, surface, holes);
  }
  FilledHoles result{.mesh = mesh, .holes = holes.size()};
  append_patches(result.mesh, holes, patches);
  result.vertices = result.mesh.vertex_count() - mesh.vertex_count();
  result.faces = result.mesh.face_count() - mesh.face_count();
  if (!holes.empty() && !mesh.attributes().corner_uvs.empty()) {
    result.notes.emplace_back("the triangles that fill holes have no texture coordinates");
  }
  return result;
}

FilledHoles fill_holes(const Mesh& mesh, const FillRequest& request, const Progress& progress) {
  const ProgressScope scope(progress);
  const VertexSet region = resolve(request.region, mesh);
  require_extent(region, mesh.positions, request.region.where);
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), region);
  std::vector<Hole> holes = chosen(
      find_holes(mesh),
      {.most_rim_vertices = static_cast<std::size_t>(request.largest), .borders = request.borders});
  std::erase_if(holes, [&](const Hole& hole) {
    return std::ranges::none_of(hole.rim, [&](Index v) { return inside[v] != 0; });
  });
  std::vector<std::string> warnings;
  for (const Hole& hole : holes) {
    if (!hole.trouble.empty()) {
      warnings.push_back(name_hole(hole) + " is not filled: " + hole.trouble);
    }
  }
  std::erase_if(holes, [](const Hole& hole) { return !hole.trouble.empty(); });
  FilledHoles result = fill_holes(mesh, holes, request.shape, progress);
  result.warnings = std::move(warnings);
  return result;
}

}  // namespace lapwing
