#include "lapwing/doctor/fix.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/doctor/face_defects.h"
#include "lapwing/doctor/orientation.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {
namespace {

// In the order of RepairKind.
constexpr std::array<RepairInfo, kRepairKindCount> kRepairs{{
    {"removed_non_finite_vertices", "non-finite vertices removed"},
    {"removed_non_finite_faces", "faces at non-finite vertices removed"},
    {"mended_faces", "faces that repeated a vertex cut down to their proper parts"},
    {"removed_degenerate_faces", "faces without three different vertices removed"},
    {"removed_repeated_faces", "repeated faces removed"},
    {"welded_vertices", "vertices welded into another along seams"},
    {"welded_unlike_vertices",
     "of these had another colour or extra property; that of the lower-numbered vertex was kept"},
    {"removed_loose_vertices", "loose vertices removed"},
    {"split_bow_ties", "bow-tie vertices split into one vertex per surface"},
    {"flipped_faces", "faces flipped to agree with their neighbours"},
    {"turned_parts", "inside-out parts turned"},
}};

using Counts = std::array<std::size_t, kRepairKindCount>;

// The mesh being repaired, and the record of its repairs.
class Repairs {
 public:
  explicit Repairs(const Mesh& mesh) : mesh_(mesh), vertex_sources_(mesh.vertex_count()) {
    std::iota(vertex_sources_.begin(), vertex_sources_.end(), Index{0});
  }

  void remove_non_finite();
  void mend_degenerate_faces();
  void remove_repeated_faces();
  bool weld_seams();
  void remove_loose_vertices();
  void split_bow_ties();
  void orient();

  Mesh& mesh() { return mesh_; }
  FixReport report() &&;

 private:
  void count(RepairKind kind, std::size_t more) { counts_[static_cast<std::size_t>(kind)] += more; }
  void keep(const KeepMask& mask);

  Mesh mesh_;
  std::vector<Index> vertex_sources_;
  Counts counts_{};
};

void Repairs::keep(const KeepMask& mask) {
  std::vector<Index> kept = keep_vertices(mesh_, mask);
  for (Index& v : kept) v = vertex_sources_[v];
  vertex_sources_ = std::move(kept);
}

void Repairs::remove_non_finite() {
  const std::size_t vertices = mesh_.vertex_count();
  const std::size_t faces = mesh_.face_count();
  KeepMask finite(vertices);
  std::ranges::transform(mesh_.positions, finite.begin(),
                         [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (std::ranges::find(finite, 0) == finite.end()) return;
  keep(finite);
  count(RepairKind::removed_non_finite_vertices, vertices - mesh_.vertex_count());
  count(RepairKind::removed_non_finite_faces, faces - mesh_.face_count());
}

void Repairs::mend_degenerate_faces() {
  const MendedFaces mended = mend_faces(mesh_);
  if (mended.mended + mended.removed == 0) return;
  replace_faces(mesh_, mended.sources);
  count(RepairKind::mended_faces, mended.mended);
  count(RepairKind::removed_degenerate_faces, mended.removed);
}

void Repairs::remove_repeated_faces() {
  const std::vector<Index> repeated = find_repeated_faces(mesh_);
  if (repeated.empty()) return;
  KeepMask mask(mesh_.face_count(), 1);
  for (const Index f : repeated) mask[f] = 0;
  keep_faces(mesh_, mask);
  count(RepairKind::removed_repeated_faces, repeated.size());
}

bool are_unlike(const Mesh& mesh, Index a, Index b) {
  const MeshAttributes& attributes = mesh.attributes();
  if (!attributes.vertex_colors.empty() &&
      attributes.vertex_colors[a] != attributes.vertex_colors[b]) {
    return true;
  }
  return std::ranges::any_of(attributes.vertex_extras, [&](const ExtraAttribute& extra) {
    if (extra.values.empty()) return false;
    const std::ptrdiff_t width = extra.components;
    const auto of_a = extra.values.begin() + width * a;
    return !std::equal(of_a, of_a + width, extra.values.begin() + width * b);
  });
}

bool Repairs::weld_seams() {
  const Edges edges = build_edges(mesh_);
  const std::vector<Index> first_at_position = first_at_same_position(mesh_.positions);
  const Adjacency seams = find_seams(mesh_, edges, first_at_position);
  if (seams.values.empty()) return false;
  const std::vector<Index> welded = joined_at_seams(seams, edges, first_at_position);
  KeepMask mask(mesh_.vertex_count(), 1);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const Index target = welded[v];
    if (target == v) continue;
    mask[v] = 0;
    count(RepairKind::welded_vertices, 1);
    if (are_unlike(mesh_, v, target)) count(RepairKind::welded_unlike_vertices, 1);
  }
  for (Index& v : mesh_.edit_faces().vertices) v = welded[v];
  keep(mask);
  return true;
}

void Repairs::remove_loose_vertices() {
  KeepMask on_face(mesh_.vertex_count(), 0);
  for (const Index v : mesh_.face_vertices()) on_face[v] = 1;
  const auto loose = static_cast<std::size_t>(std::ranges::count(on_face, 0));
  if (loose == 0) return;
  keep(on_face);
  count(RepairKind::removed_loose_vertices, loose);
}

void Repairs::split_bow_ties() {
  const Fans fans = find_fans(mesh_, build_edges(mesh_));
  if (fans.bow_tie_vertices.empty()) return;
  // The first fan of a vertex keeps the vertex; every other fan gets a copy.
  std::vector<Index> sources(mesh_.vertex_count());
  std::iota(sources.begin(), sources.end(), Index{0});
  std::vector<Index> vertex_of_fan(mesh_.face_vertices().size(), kNoIndex);
  KeepMask taken(mesh_.vertex_count(), 0);
  std::vector<Index>& vertex_of = mesh_.edit_faces().vertices;
  for (std::size_t c = 0; c < vertex_of.size(); ++c) {
    Index& vertex = vertex_of_fan[fans.of_corner[c]];
    const Index old = vertex_of[c];
    if (vertex == kNoIndex) {
      vertex = taken[old] ? static_cast<Index>(sources.size()) : old;
      if (taken[old]) sources.push_back(old);
      taken[old] = 1;
    }
    vertex_of[c] = vertex;
  }
  replace_vertices(mesh_, sources);
  for (Index& v : sources) v = vertex_sources_[v];
  vertex_sources_ = std::move(sources);
  count(RepairKind::split_bow_ties, fans.bow_tie_vertices.size());
}

void Repairs::orient() {
  const Orientation orientation = analyze_orientation(mesh_, build_edges(mesh_));
  if (!orientation.faces_to_flip.empty()) flip_faces(mesh_, orientation.faces_to_flip);
  if (!orientation.faces_to_turn.empty()) flip_faces(mesh_, orientation.faces_to_turn);
  count(RepairKind::flipped_faces, orientation.faces_to_flip.size());
  count(RepairKind::turned_parts, orientation.inside_out.size());
}

FixReport Repairs::report() && {
  FixReport report;
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    if (counts_[k] > 0) report.repairs.push_back({static_cast<RepairKind>(k), counts_[k]});
  }
  report.vertex_sources = std::move(vertex_sources_);
  return report;
}

std::string nothing_left_message(const Mesh& mesh) {
  return "repairing the mesh would leave nothing: " + why_no_surface(mesh) +
         "; export it again with its faces";
}

}  // namespace

const RepairInfo& describe(RepairKind kind) {
  return kRepairs[static_cast<std::size_t>(kind)];
}

std::size_t FixReport::count(RepairKind kind) const {
  const auto it = std::ranges::find(repairs, kind, &Repair::kind);
  return it == repairs.end() ? 0 : it->count;
}

FixReport fix(Mesh& mesh) {
  validate_indices(mesh);
  validate_attributes(mesh);
  Repairs repairs(mesh);
  repairs.remove_non_finite();
  // Welding can create faces that repeat a vertex or another face, and their removal creates new
  // boundaries. Every iteration but the last removes a vertex.
  do {
    repairs.mend_degenerate_faces();
    repairs.remove_repeated_faces();
  } while (repairs.weld_seams());
  repairs.remove_loose_vertices();
  if (repairs.mesh().face_count() == 0 && mesh.vertex_count() > 0) {
    throw InputError(nothing_left_message(mesh));
  }
  repairs.split_bow_ties();
  repairs.orient();
  Mesh fixed = std::move(repairs.mesh());
  FixReport report = std::move(repairs).report();
  if (report.changed()) mesh = std::move(fixed);
  return report;
}

}  // namespace lapwing
