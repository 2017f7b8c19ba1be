#include "lapwing/transplant/placed_part.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/transplant/loop_curve.h"
#include "lapwing/transplant/surface_placement.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

Vector3d mean(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

std::string loops_in_words(const std::vector<BoundaryLoop>& loops) {
  std::string text;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (i > 0) text += ", ";
    text += std::to_string(i) + " (" + std::to_string(loops[i].size()) + " vertices from vertex " +
            std::to_string(loops[i].front()) + ")";
  }
  return text;
}

// Returns the requested boundary loop, or the longest one.
BoundaryLoop choose_loop(const TransplantRequest& request, const Mesh& part,
                         const std::string& name) {
  const Topology& topology = part.topology();
  const auto loops = boundary_loops(topology.triangles, name);
  if (loops.empty()) {
    throw InputError(name +
                     ": the part is closed, so it has no boundary loop to join; cut it open with "
                     "`lapwing cut`, or give a \"region\" of it");
  }
  if (request.loop) {
    if (*request.loop < loops.size()) return loops[*request.loop];
    throw InputError(request.where + "/loop: the part has no boundary loop " +
                     std::to_string(*request.loop) + "; its loops are " + loops_in_words(loops));
  }
  const auto length = [&](const BoundaryLoop& loop) {
    return LoopCurve(loop_points(loop, part.positions), name).length();
  };
  return *std::max_element(loops.begin(), loops.end(),
                           [&](const auto& a, const auto& b) { return length(a) < length(b); });
}

// Returns the signed volume enclosed by the surface and a fan over its loop. It is negative if the
// surface is inside out.
double volume(const Mesh& part, const Vector3d& center) {
  double sum = 0.0;
  for (const Triangle& t : part.topology().triangles) {
    sum += (part.positions[t[0]] - center)
               .dot((part.positions[t[1]] - center).cross(part.positions[t[2]] - center));
  }
  return sum / 6.0;
}

void turn(PlacedPart& part) {
  turn_inside_out(part.mesh);
  std::reverse(part.loop.begin() + 1, part.loop.end());
  part.turned = true;
}

// Returns whether the enclosed volume is clearly negative. A flat part encloses almost no volume
// and is never inside out.
bool is_inside_out(const PlacedPart& part, const std::string& where) {
  constexpr double kLeastRise = 0.1;
  const LoopFrame loop = loop_frame(LoopCurve(loop_points(part.loop, part.mesh.positions), where));
  return volume(part.mesh, loop.center) < -kLeastRise * std::pow(loop.radius, 3);
}

PlacedPart cut_part(const TransplantRequest& request, const Mesh& source) {
  PlacedPart part;
  const std::string where = request.where + "/part";
  if (request.part_region) {
    const VertexSet region = resolve(*request.part_region, source);
    part.mesh = cut_out(source, region, request.part_region->where).mesh;
  } else {
    require_surface(source, where);
    part.mesh = source;
  }
  for (std::size_t v = 0; v < part.mesh.vertex_count(); ++v) {
    if (part.mesh.positions[v].allFinite()) continue;
    throw InputError(where + ": vertex " + std::to_string(v) +
                         " of the part has a non-finite position; repair the part with `lapwing "
                         "check --fix`",
                     {static_cast<Index>(v)});
  }
  std::vector<Index> all(part.mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  require_extent(all, part.mesh.positions, where);
  part.loop = choose_loop(request, part.mesh, where);
  return part;
}

// Returns the vertices of loop edges that have no face of the rest on the other side.
VertexSet without_other_side(const BoundaryLoop& loop, const CutPiece& rest,
                             std::span<const Index> numbers) {
  std::vector<Index> next(rest.vertices.size(), kNoIndex);  // next vertex along the loop, in the
                                                            // rest
  std::vector<Index> open;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Index from = numbers[loop[k]];
    const Index to = numbers[loop[(k + 1) % loop.size()]];
    if (from == kNoIndex || to == kNoIndex) {
      open.push_back(loop[k]);
    } else {
      next[from] = to;
    }
  }
  std::vector<char> has_other_side(rest.vertices.size(), 0);
  for (std::size_t f = 0; f < rest.mesh.face_count(); ++f) {
    const auto face = rest.mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      if (next[b] == a) has_other_side[b] = 1;
    }
  }
  for (const Index v : loop) {
    const Index own = numbers[v];
    if (own != kNoIndex && next[own] != kNoIndex && has_other_side[own] == 0) open.push_back(v);
  }
  return make_vertex_set(std::move(open));
}

}  // namespace

CutHole cut_hole(const RegionSpec& region, const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  CutHole hole;
  const std::string& where = region.where;
  const VertexSet vertices = resolve(region, mesh);
  require_extent(vertices, mesh.positions, where);
  hole.rest = cut_away(mesh, vertices, where);
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), vertices);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto face = mesh.face(topology.triangle_faces[t]);
    if (std::all_of(face.begin(), face.end(), [&](Index v) { return inside[v] != 0; })) {
      hole.triangles.push_back(topology.triangles[t]);
    }
  }
  const auto loops = boundary_loops(hole.triangles, where);
  if (loops.size() != 1) {
    throw InputError(
        where + ": the region must have one boundary loop, at which the part is joined; it has " +
        (loops.empty() ? std::string("none")
                       : std::to_string(loops.size()) + ": " + loops_in_words(loops)) +
        ". Choose another region, or use {\"disk_in\": REGION}");
  }
  hole.loop = loops.front();
  const std::vector<Index> numbers = inverse_index(hole.rest.vertices, mesh.vertex_count());
  const VertexSet open = without_other_side(hole.loop, hole.rest, numbers);
  if (!open.empty()) {
    throw InputError(where + ": the region reaches the boundary of the mesh at " +
                         name_vertices(open) +
                         "; remove the faces there from the region, so that faces remain around "
                         "the hole",
                     open);
  }
  for (const Index v : hole.loop) hole.rest_loop.push_back(numbers[v]);
  std::reverse(hole.rest_loop.begin() + 1, hole.rest_loop.end());
  return hole;
}

PlacedPart place_part(const TransplantRequest& request, const Mesh& source, const Mesh& mesh,
                      const CutHole& hole) {
  PlacedPart part = cut_part(request, source);
  const std::string where = request.where + "/part";
  if (is_inside_out(part, where)) turn(part);
  const auto hole_points = loop_points(hole.rest_loop, hole.rest.mesh.positions);
  const auto part_points = loop_points(part.loop, part.mesh.positions);
  if (const auto* fit = std::get_if<LoopFit>(&request.place)) {
    part.motion = fit_loop(part_points, hole_points, *fit, request.where + "/place");
  } else {
    part.motion = to_affine(std::get<Move>(request.place), mean(part_points));
    if (request.snap) {
      const SurfaceSnap surface(mesh.topology().triangles, mesh.positions, request.where);
      part.motion = surface.snap(part.motion, part_points, request.where + "/place");
    }
  }
  const double determinant = part.motion.linear().determinant();
  if (!(std::abs(determinant) > 0.0) || !std::isfinite(determinant)) {
    throw InputError(request.where +
                     "/place: the matrix flattens the part; give an invertible matrix");
  }
  transform(part.mesh, part.motion);
  if (determinant < 0.0) std::reverse(part.loop.begin() + 1, part.loop.end());
  // Two loops that are joined must have opposite directions.
  const auto normal = [&](std::span<const Vector3d> points, const std::string& name) {
    return loop_frame(LoopCurve(points, name)).normal;
  };
  if (normal(loop_points(part.loop, part.mesh.positions), where)
          .dot(normal(hole_points, request.target_region.where)) > 0.0) {
    turn(part);
  }
  if (part.turned) {
    part.notes.push_back(request.where +
                         ": the part's faces pointed inward at its place, so they were flipped. If "
                         "that is not intended, check \"place\", or check the part with `lapwing "
                         "check`");
  }
  return part;
}

}  // namespace lapwing
