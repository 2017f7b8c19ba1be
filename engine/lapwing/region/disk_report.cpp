#include "lapwing/region/disk_report.h"

#include <algorithm>
#include <map>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {
namespace {

// Finds the fans of corners around each vertex, the edge-connected components of triangles, and the
// boundary loops.
class Linker {
 public:
  Linker(const RegionTriangles& part, const Adjacency& sides)
      : part_(part),
        sides_(sides),
        fans_(linked_fans(
            sides, 3 * part.triangles.size(),
            [&](Index c) { return side_start(part.triangles, c); }, next)),
        pieces_(part.triangles.size()) {
    CancelCheck cancel_check;
    for (std::size_t e = 0; e < sides.row_count(); ++e) {
      cancel_check();
      for (const Index side : sides[e]) pieces_.unite(sides[e][0] / 3, side / 3);
    }
  }

  std::vector<DiskReport::Piece> pieces() {
    std::map<Index, DiskReport::Piece> found;
    CancelCheck cancel_check;
    for (Index t = 0; t < part_.triangles.size(); ++t) {
      cancel_check();
      const Index least = *std::min_element(part_.triangles[t].begin(), part_.triangles[t].end());
      DiskReport::Piece& piece =
          found.try_emplace(pieces_.find(t), DiskReport::Piece{0, mesh_number(least)})
              .first->second;
      ++piece.triangles;
      piece.vertex = std::min(piece.vertex, mesh_number(least));
    }
    return by_vertex(found);
  }

  // A pinched vertex counts as one vertex per fan.
  std::vector<DiskReport::Loop> loops() {
    UnionFind joined = linked_loops(
        sides_, 3 * part_.triangles.size(), [&](Index c) { return fans_.find(c); }, next);
    std::map<Index, DiskReport::Loop> found;
    CancelCheck cancel_check;
    for (std::size_t e = 0; e < sides_.row_count(); ++e) {
      cancel_check();
      if (sides_.size(e) != 1) continue;
      const Index vertex = mesh_number(side_start(part_.triangles, sides_[e][0]));
      const Index name = joined.find(fans_.find(sides_[e][0]));
      DiskReport::Loop& loop = found.try_emplace(name, DiskReport::Loop{0, vertex}).first->second;
      ++loop.vertices;
      loop.vertex = std::min(loop.vertex, vertex);
    }
    return by_vertex(found);
  }

  std::size_t fan_count() {
    std::size_t count = 0;
    for (Index c = 0; c < 3 * part_.triangles.size(); ++c) count += fans_.find(c) == c ? 1 : 0;
    return count;
  }

  VertexSet pinched() {
    std::vector<Index> fan_of(part_.vertices.size(), kNoIndex);
    VertexSet found;
    CancelCheck cancel_check;
    for (Index c = 0; c < 3 * part_.triangles.size(); ++c) {
      cancel_check();
      const Index v = side_start(part_.triangles, c);
      if (fan_of[v] == kNoIndex) fan_of[v] = fans_.find(c);
      if (fan_of[v] != fans_.find(c)) found.push_back(mesh_number(v));
    }
    return make_vertex_set(std::move(found));
  }

 private:
  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  Index mesh_number(Index own) const { return part_.vertices[own]; }

  template <class Part>
  static std::vector<Part> by_vertex(const std::map<Index, Part>& found) {
    std::vector<Part> list;
    list.reserve(found.size());
    for (const auto& [name, entry] : found) list.push_back(entry);
    std::stable_sort(list.begin(), list.end(),
                     [](const Part& a, const Part& b) { return a.vertex < b.vertex; });
    return list;
  }

  const RegionTriangles& part_;
  const Adjacency& sides_;
  UnionFind fans_;  // disjoint sets of corners; side c starts at corner c
  UnionFind pieces_;
};

std::string count(std::size_t number, const std::string& one) {
  return std::to_string(number) + " " + one + (number == 1 ? "" : "s");
}

std::string name_loop(const DiskReport::Loop& loop) {
  return std::to_string(loop.vertices) + " vertices from vertex " + std::to_string(loop.vertex);
}

constexpr std::size_t kNamed = 4;

// Returns "3 KINDs (TEXT, TEXT, TEXT)" with at most kNamed items.
template <class Item, class Name>
std::string list(const std::vector<Item>& items, const std::string& kind, const Name& name) {
  std::string text = count(items.size(), kind) + " (";
  for (std::size_t k = 0; k < std::min(items.size(), kNamed); ++k) {
    text += (k > 0 ? ", " : "") + name(items[k]);
  }
  if (items.size() > kNamed) text += " and " + std::to_string(items.size() - kNamed) + " more";
  return text + ")";
}

std::string name_ends(const std::array<Index, 2>& edge) {
  return name_edge(edge[0], edge[1]);
}

}  // namespace

bool DiskReport::is_disk() const {
  return pieces.size() == 1 && loops.size() == 1 && euler_characteristic == 1 &&
         non_manifold_edges.empty() && turned_edges.empty() && pinched.empty();
}

DiskReport report_disk(const RegionTriangles& part) {
  return report_disk(part, sides_by_edge(part.triangles, part.vertices.size()));
}

DiskReport report_disk(const RegionTriangles& part, const Adjacency& sides) {
  DiskReport report;
  Linker linker(part, sides);
  report.pieces = linker.pieces();
  report.loops = linker.loops();
  report.pinched = linker.pinched();
  report.loose = part.loose;
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    const auto on_edge = sides[e];
    const Index from = part.vertices[side_start(part.triangles, on_edge[0])];
    const Index to = part.vertices[side_end(part.triangles, on_edge[0])];
    const std::array<Index, 2> edge{std::min(from, to), std::max(from, to)};
    if (on_edge.size() > 2) report.non_manifold_edges.push_back(edge);
    if (on_edge.size() == 2 &&
        side_start(part.triangles, on_edge[0]) == side_start(part.triangles, on_edge[1])) {
      report.turned_edges.push_back(edge);
    }
  }
  const auto edges = static_cast<long>(sides.row_count());
  const auto triangles = static_cast<long>(part.triangles.size());
  report.euler_characteristic = euler_characteristic(part.triangles, sides);
  if (report.non_manifold_edges.empty() && report.turned_edges.empty()) {
    // Euler's formula for each component, with pinched vertices split: V - E + F = 2 - 2 g - loops.
    const long apart = static_cast<long>(linker.fan_count()) - edges + triangles;
    report.handles = (2 * static_cast<long>(report.pieces.size()) -
                      static_cast<long>(report.loops.size()) - apart) /
                     2;
  }
  return report;
}

std::string describe(const DiskReport& report) {
  if (report.is_disk()) return "is a disk";
  if (report.pieces.empty()) return "has no triangles";
  std::vector<std::string> parts;
  if (report.pieces.size() > 1) {
    parts.push_back(list(report.pieces, "piece", [](const DiskReport::Piece& piece) {
      return count(piece.triangles, "triangle") + " from vertex " + std::to_string(piece.vertex);
    }));
  }
  if (report.loops.empty()) parts.emplace_back("no boundary");
  if (report.loops.size() > 1) {
    parts.push_back(list(report.loops, "boundary loop", name_loop));
  }
  if (report.handles > 0)
    parts.push_back(count(static_cast<std::size_t>(report.handles), "handle"));
  if (!report.non_manifold_edges.empty()) {
    parts.push_back(list(report.non_manifold_edges, "edge", name_ends) +
                    " with more than two triangles");
  }
  if (!report.turned_edges.empty()) {
    parts.push_back(list(report.turned_edges, "edge", name_ends) +
                    " with triangles of opposite orientation");
  }
  if (!report.pinched.empty()) {
    parts.push_back("parts that touch only at " + name_vertices(report.pinched));
  }
  std::string text = "has ";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 == parts.size() ? " and " : ", ";
    text += parts[k];
  }
  return text;
}

}  // namespace lapwing
