#include "lapwing/doctor/check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/face_defects.h"
#include "lapwing/doctor/orientation.h"
#include "lapwing/doctor/self_intersections.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {

namespace {

constexpr std::string_view kFixIt = "repair it with `lapwing check MESH --fix OUT`";

// In the order of DefectKind.
constexpr std::array<DefectInfo, kDefectKindCount> kDefects{{
    {"no_faces", "no usable face",
     "no face has three different, finite vertices: there is no surface to edit",
     "export the mesh again with its faces", Severity::error, Element::none, false},
    {"non_finite_vertex", "non-finite vertices",
     "a coordinate is infinite or not a number: no edit can include the vertex or its neighbours",
     "correct it in the file, or remove it and its faces with `lapwing check MESH --fix OUT`",
     Severity::error, Element::vertex, true},
    {"degenerate_face", "faces that repeat a vertex",
     "the face has fewer than three corners, or names a vertex twice: the part without area is "
     "ignored",
     kFixIt, Severity::warning, Element::face, true},
    {"repeated_face", "repeated faces",
     "the face has the vertices of an earlier face: normals and cotangent weights count both",
     kFixIt, Severity::warning, Element::face, true},
    {"zero_area_face", "zero-area faces",
     "the corners lie on one line: the face has no normal and no cotangent weights",
     "edit with uniform weights, or remesh around it", Severity::warning, Element::face, false},
    {"loose_vertex", "loose vertices",
     "no face holds the vertex: nothing carries it along with an edit", kFixIt, Severity::warning,
     Element::vertex, true},
    {"duplicate_vertex", "duplicate vertices",
     "the vertex is at the position of an earlier vertex, but not joined to it: an edit can move "
     "them apart unless they lie on a seam",
     "`lapwing check MESH --fix OUT` welds those along unwelded seams and leaves the others",
     Severity::info, Element::vertex, false},
    {"unwelded_seam", "unwelded seam edges",
     "boundary edges coincide but have different vertices: `deform` edits them as one surface, "
     "every other operation as a boundary",
     "weld them with `lapwing check MESH --fix OUT`", Severity::warning, Element::edge, true},
    {"non_manifold_edge", "edges with more than two faces",
     "editing works: all faces move together, and the normal there is their mean", "",
     Severity::warning, Element::edge, false},
    {"bow_tie_vertex", "bow-tie vertices",
     "surfaces touch at one vertex only: editing works, but the local shape is the mean of both",
     "give each surface its own vertex with `lapwing check MESH --fix OUT`; they can then move "
     "apart",
     Severity::warning, Element::vertex, true},
    {"inconsistent_orientation", "edges between faces of opposite orientation",
     "neighbouring faces disagree about which side is out: normals cancel and shading is wrong",
     kFixIt, Severity::warning, Element::edge, true},
    {"one_sided_surface", "edges where a one-sided surface turns over",
     "no orientation is consistent, as on a Moebius strip: editing works, but normals flip along "
     "these edges",
     "cut the surface open there if its normals matter", Severity::warning, Element::edge, false},
    {"inside_out_part", "inside-out parts",
     "the part is closed and no cavity, but its normals point inward: a coat or mix on it goes "
     "inward, and shading is reversed",
     "turn it with `lapwing check MESH --fix OUT`", Severity::warning, Element::component, true},
    {"inward_open_part", "open parts with inward normals",
     "with its holes closed, the part would be inside out: a coat or mix on it goes inward",
     "unless it is meant to be seen from inside, reverse its faces in a modelling tool",
     Severity::info, Element::component, false},
    {"point_ring", "vertices with all neighbours at one point",
     "no local shape to fit: the surface there neither turns nor scales with an edit",
     "merge the vertices in a modelling tool, or leave them out of the region of interest",
     Severity::warning, Element::vertex, false},
    {"collinear_ring", "vertices with all neighbours on one line",
     "the rotation about that line is undetermined: the edit chooses the smallest",
     "leave them out of the region of interest, or remesh around them", Severity::warning,
     Element::vertex, false},
    {"several_components", "components", "pieces without a common edge move independently",
     "add a handle or a belt to each piece that an edit should move or hold", Severity::info,
     Element::component, false},
    {"hole", "holes",
     "the surface is open there: a hole moves with its rim; the border of an open sheet is not a "
     "hole",
     "fill them with `lapwing check MESH --fix OUT --fill-holes smooth`", Severity::info,
     Element::rim, false},
    {"self_intersection", "faces that cut through others",
     "parts of the surface intersect or overlap: editing works, but the surface bounds no solid",
     "pull the parts apart with an edit, or remodel them", Severity::warning, Element::face, false},
}};

}  // namespace

const DefectInfo& describe(DefectKind kind) {
  return kDefects[static_cast<std::size_t>(kind)];
}

namespace {

using Eigen::Vector3d;

// Squared lengths below this fraction of the largest are considered zero. The fit of rotations to
// one-rings uses the same fraction for eigenvalues.
constexpr double kZeroShare = 1e-12;

// The report under construction and its limit on listed places.
struct Findings {
  CheckReport& report;
  std::size_t most_listed;
};

void add(const Findings& findings, DefectKind kind, std::span<const Index> found) {
  if (found.empty()) return;
  const std::size_t width = describe(kind).element == Element::edge ? 2 : 1;
  const std::size_t count = found.size() / width;
  const auto listed = found.first(std::min(count, findings.most_listed) * width);
  findings.report.defects.push_back({kind, count, {listed.begin(), listed.end()}});
}

// Returns the ends of the listed edges, concatenated.
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
  // If all points are on a line, it contains the mean and the point farthest from it.
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

void check_holes(const Mesh& mesh, const Edges& edges, const Fans& fans, const Findings& findings) {
  const bool has_seams = findings.report.find(DefectKind::unwelded_seam) != nullptr;
  findings.report.holes = has_seams ? find_holes(mesh) : find_holes(mesh, edges, fans);
  std::vector<Index> first;
  for (const Hole& hole : chosen(findings.report.holes, {})) first.push_back(hole.rim.front());
  add(findings, DefectKind::hole, first);
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
  if (!why_no_surface(mesh).empty()) {
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
  add(findings, DefectKind::inside_out_part, orientation.inside_out);
  add(findings, DefectKind::inward_open_part, orientation.inward_open);
  check_rings(mesh, findings);
  check_components(topology, findings);
  check_holes(mesh, edges, fans, findings);
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
