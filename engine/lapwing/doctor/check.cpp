#include "lapwing/doctor/check.h"

#include <algorithm>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/mend_faces.h"
#include "lapwing/doctor/orientation.h"
#include "lapwing/doctor/repeated_faces.h"
#include "lapwing/doctor/self_intersections.h"
#include "lapwing/mesh/coincident.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/fans.h"
#include "lapwing/mesh/seams.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Squared lengths below this fraction of the largest count as zero. The fit of the one-rings cuts
// off its eigenvalues at the same fraction.
constexpr double kZeroShare = 1e-12;

// The report under construction and its limit on listed places.
struct Findings {
  CheckReport& report;
  std::size_t most_listed;
};

// Appends the defect unless nothing was found.
void add(const Findings& findings, DefectKind kind, std::span<const Index> found) {
  if (found.empty()) return;
  const std::size_t width = describe(kind).element == Element::edge ? 2 : 1;
  const std::size_t count = found.size() / width;
  const auto listed = found.first(std::min(count, findings.most_listed) * width);
  findings.report.defects.push_back({kind, count, {listed.begin(), listed.end()}});
}

// Returns the ends of the listed edges, one after another.
std::vector<Index> ends_of(const Edges& edges, std::span<const Index> list) {
  std::vector<Index> ends;
  ends.reserve(2 * list.size());
  for (const Index e : list) ends.insert(ends.end(), edges.ends[e].begin(), edges.ends[e].end());
  return ends;
}

template <typename Predicate>
std::vector<Index> indices_where(std::size_t count, Predicate&& holds) {
  std::vector<Index> found;
  CancelCheck cancel_check;
  for (std::size_t i = 0; i < count; ++i) {
    cancel_check();
    if (holds(static_cast<Index>(i))) found.push_back(static_cast<Index>(i));
  }
  return found;
}

std::vector<unsigned char> mask_of(std::size_t count, std::span<const Index> members) {
  std::vector<unsigned char> mask(count, 0);
  for (const Index i : members) mask[i] = 1;
  return mask;
}

bool has_usable_face(const Mesh& mesh) {
  return std::ranges::any_of(mesh.topology().triangles, [&](const Triangle& triangle) {
    return std::ranges::all_of(triangle, [&](Index v) { return mesh.positions[v].allFinite(); });
  });
}

std::vector<Index> find_zero_area_faces(const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  std::vector<Index> found;
  CancelCheck cancel_check;
  for (std::size_t t = 0; t < topology.triangles.size();) {
    cancel_check();
    const Index face = topology.triangle_faces[t];
    double area = 0.0;
    double longest = 0.0;
    for (; t < topology.triangles.size() && topology.triangle_faces[t] == face; ++t) {
      const auto& [a, b, c] = topology.triangles[t];
      const Vector3d ab = mesh.positions[b] - mesh.positions[a];
      const Vector3d ac = mesh.positions[c] - mesh.positions[a];
      area += ab.cross(ac).norm();
      longest = std::max({longest, ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    }
    if (area <= kZeroShare * longest) found.push_back(face);
  }
  return found;
}

enum class RingShape { proper, line, point };

RingShape shape_of_ring(Index i, std::span<const Index> ring, const Positions& positions) {
  Vector3d center = Vector3d::Zero();
  for (const Index j : ring) center += positions[j] - positions[i];
  center /= static_cast<double>(ring.size() + 1);
  // The only line that could hold all members runs from the mean to the member farthest from it.
  double size = center.squaredNorm();
  Vector3d farthest = -center;
  for (const Index j : ring) {
    const Vector3d x = positions[j] - positions[i] - center;
    size += x.squaredNorm();
    if (x.squaredNorm() > farthest.squaredNorm()) farthest = x;
  }
  if (size == 0.0) return RingShape::point;
  const Vector3d line = farthest.normalized();
  double off_line = center.cross(line).squaredNorm();
  for (const Index j : ring) {
    off_line += (positions[j] - positions[i] - center).cross(line).squaredNorm();
  }
  return off_line <= kZeroShare * size ? RingShape::line : RingShape::proper;
}

void check_faces(const Mesh& mesh, const Findings& findings) {
  add(findings, DefectKind::degenerate_face,
      indices_where(mesh.face_count(), [&](Index f) { return is_degenerate(mesh.face(f)); }));
  add(findings, DefectKind::repeated_face, find_repeated_faces(mesh));
  add(findings, DefectKind::zero_area_face, find_zero_area_faces(mesh));
}

void check_vertices_and_seams(const Mesh& mesh, const Edges& edges, const Findings& findings) {
  const std::vector<unsigned char> on_face = mask_of(mesh.vertex_count(), mesh.face_vertices());
  add(findings, DefectKind::loose_vertex,
      indices_where(mesh.vertex_count(), [&](Index v) { return !on_face[v]; }));
  const std::vector<Index> first_at_position = first_at_same_position(mesh.positions);
  add(findings, DefectKind::duplicate_vertex,
      indices_where(mesh.vertex_count(), [&](Index v) { return first_at_position[v] != v; }));
  std::vector<Index> seam_edges = find_seams(mesh, edges, first_at_position).values;
  std::ranges::sort(seam_edges);
  add(findings, DefectKind::unwelded_seam, ends_of(edges, seam_edges));
}

void check_rings(const Mesh& mesh, const Findings& findings) {
  const Topology& topology = mesh.topology();
  std::vector<Index> points;
  std::vector<Index> lines;
  CancelCheck cancel_check;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    cancel_check();
    if (topology.rings.size(v) == 0) continue;
    const RingShape shape = shape_of_ring(v, topology.rings[v], mesh.positions);
    if (shape == RingShape::point) points.push_back(v);
    if (shape == RingShape::line) lines.push_back(v);
  }
  add(findings, DefectKind::point_ring, points);
  add(findings, DefectKind::collinear_ring, lines);
}

void check_components(const Topology& topology, const Findings& findings) {
  const Components components = connected_components(topology.rings);
  std::vector<unsigned char> seen(components.count, 0);
  const std::vector<Index> first = indices_where(topology.vertex_count(), [&](Index v) {
    if (topology.rings.size(v) == 0 || seen[components.of_vertex[v]]) return false;
    seen[components.of_vertex[v]] = 1;
    return true;
  });
  if (first.size() > 1) add(findings, DefectKind::several_components, first);
}

}  // namespace

const Defect* CheckReport::find(DefectKind kind) const {
  const auto it = std::ranges::find(defects, kind, &Defect::kind);
  return it == defects.end() ? nullptr : &*it;
}

bool CheckReport::has_problems() const {
  return std::ranges::any_of(
      defects, [](const Defect& d) { return describe(d.kind).severity != Severity::info; });
}

bool CheckReport::is_fixable() const {
  return std::ranges::any_of(defects, [](const Defect& d) { return describe(d.kind).fixable; });
}

CheckReport check(const Mesh& mesh, std::size_t most_listed) {
  const Topology& topology = mesh.topology();
  const Edges edges = build_edges(mesh, mask_of(mesh.face_count(), topology.triangle_faces));
  const Fans fans = find_fans(mesh, edges);
  const Orientation orientation = analyze_orientation(mesh, edges);

  CheckReport report;
  const Findings findings{report, most_listed};
  report.statistics = measure(mesh, edges, fans, orientation);
  if (!has_usable_face(mesh)) {
    report.defects.push_back({DefectKind::no_faces, 1, {}});
  }
  add(findings, DefectKind::non_finite_vertex,
      indices_where(mesh.vertex_count(), [&](Index v) { return !mesh.positions[v].allFinite(); }));
  check_faces(mesh, findings);
  check_vertices_and_seams(mesh, edges, findings);
  const auto crowded = [&](Index e) { return edges.sides.size(e) > 2; };
  add(findings, DefectKind::non_manifold_edge,
      ends_of(edges, indices_where(edges.count(), crowded)));
  add(findings, DefectKind::bow_tie_vertex, fans.bow_tie_vertices);
  add(findings, DefectKind::inconsistent_orientation,
      ends_of(edges, orientation.inconsistent_edges));
  add(findings, DefectKind::one_sided_surface, ends_of(edges, orientation.one_sided_edges));
  check_rings(mesh, findings);
  check_components(topology, findings);
  return report;
}

void add_self_intersections(const Mesh& mesh, CheckReport& report) {
  const Topology& topology = mesh.topology();
  std::vector<unsigned char> concerned(mesh.face_count(), 0);
  for (const auto& pair : self_intersections(topology.triangles, mesh.positions)) {
    for (const Index t : pair) concerned[topology.triangle_faces[t]] = 1;
  }
  add({report, kMaxListed}, DefectKind::self_intersection,
      indices_where(mesh.face_count(), [&](Index f) { return concerned[f] != 0; }));
}

}  // namespace lapwing
