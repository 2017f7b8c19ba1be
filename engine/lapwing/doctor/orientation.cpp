#include "lapwing/doctor/orientation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/union_find.h"
#include "lapwing/doctor/nesting.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Faces that are connected through edges with two sides, in the order of the flood fill.
struct Sheet {
  std::vector<Index> faces;
  std::vector<Index> inconsistent_edges;
  std::vector<Index> border;  // sides of edges that do not have exactly two sides
  bool one_sided = false;
};

class Flood {
 public:
  Flood(const Mesh& mesh, const Edges& edges)
      : mesh_(mesh), edges_(edges), state_(mesh.face_count(), kUnseen) {}

  bool seen(Index face) const { return state_[face] != kUnseen; }
  bool flipped(Index face) const { return state_[face] == kFlipped; }

  // Visits every face of the sheet of `seed`. Decides whether to flip a face so that it is
  // consistent with the face from which it was reached.
  Sheet visit(Index seed) {
    Sheet sheet;
    sheet.faces.push_back(seed);
    state_[seed] = kKept;
    CancelCheck cancel_check;
    for (std::size_t next = 0; next < sheet.faces.size(); ++next) {
      cancel_check();
      const Index face = sheet.faces[next];
      for (Index c = mesh_.face_starts()[face]; c < mesh_.face_starts()[face + 1]; ++c) {
        cross(face, c, sheet);
      }
    }
    return sheet;
  }

 private:
  enum State : unsigned char { kUnseen, kKept, kFlipped };

  void cross(Index face, Index side, Sheet& sheet) {
    const Index edge = edges_.edge_of_side[side];
    if (edge == kNoIndex) return;
    if (edges_.sides.size(edge) != 2) {
      sheet.border.push_back(side);
      return;
    }
    const auto sides = edges_.sides[edge];
    const bool same_direction = mesh_.face_vertices()[sides[0]] == mesh_.face_vertices()[sides[1]];
    if (same_direction && side == sides[0]) sheet.inconsistent_edges.push_back(edge);
    const Index other = edges_.face_of_corner[side == sides[0] ? sides[1] : sides[0]];
    const bool flip_other = flipped(face) != same_direction;
    if (!seen(other)) {
      state_[other] = flip_other ? kFlipped : kKept;
      sheet.faces.push_back(other);
    } else if (flipped(other) != flip_other) {
      sheet.one_sided = true;
    }
  }

  const Mesh& mesh_;
  const Edges& edges_;
  std::vector<unsigned char> state_;
};

// Integrals over a sheet. Faces that the flood fill marked are treated as flipped.
struct SheetSize {
  double volume = 0.0;  // enclosed volume; for an open sheet, the volume of its cone to the origin
  double area = 0.0;
  Vector3d across = Vector3d::Zero();  // integral of the unit normal; 0 if closed

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, double sign = 1.0) {
    volume += sign * a.dot(b.cross(c)) / 6.0;
    across += sign * 0.5 * (b - a).cross(c - a);
  }
};

// Returns a point of the sheet, used as the origin of the volume integral. With a distant origin,
// the integral would suffer from cancellation.
Vector3d origin_of(const Mesh& mesh, const Sheet& sheet) {
  return mesh.positions[mesh.face(sheet.faces[0])[0]];
}

SheetSize measure_sheet(const Mesh& mesh, const Sheet& sheet, const Flood& flood) {
  const Vector3d origin = origin_of(mesh, sheet);
  SheetSize size;
  for (const Index f : sheet.faces) {
    const auto polygon = mesh.face(f);
    SheetSize face;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      face.add(mesh.positions[polygon[0]] - origin, mesh.positions[polygon[k]] - origin,
               mesh.positions[polygon[k + 1]] - origin, flood.flipped(f) ? -1.0 : 1.0);
    }
    size.volume += face.volume;
    size.across += face.across;
    size.area += face.across.norm();
  }
  return size;
}

// A volume below this fraction of area^1.5 is a rounding error. For a sphere, the fraction is 0.09.
constexpr double kFlat = 1e-9;

bool is_inward(const SheetSize& size) {
  return size.volume < -kFlat * std::pow(size.area, 1.5);
}

// Closes each hole of a consistent sheet with a fan of triangles around the mean of the hole's
// vertices, and adds these triangles to `size`.
void close_holes(const Mesh& mesh, const Edges& edges, const Sheet& sheet, SheetSize& size) {
  const Vector3d origin = origin_of(mesh, sheet);
  const auto start = [&](Index side) { return mesh.face_vertices()[side]; };
  const auto end = [&](Index side) { return mesh.face_vertices()[edges.next_corner[side]]; };
  std::vector<Index> vertices;
  for (const Index side : sheet.border) vertices.insert(vertices.end(), {start(side), end(side)});
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto place = [&](Index v) {
    return static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin());
  };
  UnionFind holes(vertices.size());
  for (const Index side : sheet.border) holes.unite(place(start(side)), place(end(side)));
  std::vector<Vector3d> sums(vertices.size(), Vector3d::Zero());
  std::vector<double> counts(vertices.size(), 0.0);
  for (Index k = 0; k < vertices.size(); ++k) {
    sums[holes.find(k)] += mesh.positions[vertices[k]] - origin;
    counts[holes.find(k)] += 1.0;
  }
  for (const Index side : sheet.border) {
    const Index hole = holes.find(place(start(side)));
    size.add(mesh.positions[end(side)] - origin, mesh.positions[start(side)] - origin,
             sums[hole] / counts[hole]);
  }
}

// Returns whether a consistently oriented open sheet encloses a negative volume after its holes are
// closed. The ratio |across| / area measures the flatness of the sheet. It is 0.5 for a hemisphere,
// and at least 0.7 for a height field with slopes up to 45 degrees.
bool is_inward_open(const Mesh& mesh, const Edges& edges, const Sheet& sheet, SheetSize size) {
  constexpr double kMostOpen = 0.6;
  if (!(size.across.norm() <= kMostOpen * size.area)) return false;
  close_holes(mesh, edges, sheet, size);
  return is_inward(size);
}

Index smallest_vertex(const Mesh& mesh, std::span<const Index> faces) {
  Index smallest = kNoIndex;
  for (const Index f : faces) smallest = std::min(smallest, std::ranges::min(mesh.face(f)));
  return smallest;
}

void append_flips(const Sheet& sheet, const Flood& flood, const SheetSize& size,
                  std::vector<Index>& faces_to_flip) {
  const auto marked = static_cast<std::size_t>(
      std::ranges::count_if(sheet.faces, [&](Index f) { return flood.flipped(f); }));
  const bool flip_marked =
      sheet.border.empty() ? size.volume >= 0.0 : 2 * marked <= sheet.faces.size();
  for (const Index f : sheet.faces) {
    if (flood.flipped(f) == flip_marked) faces_to_flip.push_back(f);
  }
}

void append(std::vector<Index>& list, const std::vector<Index>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

// Finds the closed sheets to flip, from the outermost to the innermost. A sheet that is oriented
// inward is inside out if no solid contains it. The sheets inside it are flipped with it.
void turn_inside_out_sheets(const Mesh& mesh, std::span<const ClosedSheet> sheets,
                            Orientation& orientation) {
  if (std::ranges::none_of(sheets, [](const ClosedSheet& s) { return s.volume < 0.0; })) return;
  const auto containers = containers_of(mesh, sheets);
  std::vector<Index> outside_in(sheets.size());
  std::iota(outside_in.begin(), outside_in.end(), Index{0});
  std::ranges::stable_sort(outside_in, std::greater<>(),
                           [&](Index s) { return std::abs(sheets[s].volume); });
  std::vector<unsigned char> turns_its_inside(sheets.size(), 0);
  // per sheet: its contribution to the winding number inside it, after the flips
  std::vector<int> winding(sheets.size(), 0);
  for (const Index s : outside_in) {
    int around = 0;
    bool is_turned = false;
    for (const Index c : containers[s]) {
      around += winding[c];
      is_turned = is_turned != (turns_its_inside[c] != 0);
    }
    const bool was_inward = sheets[s].volume < 0.0;
    is_turned = is_turned && sheets[s].may_turn;
    if (around <= 0 && was_inward != is_turned) {
      turns_its_inside[s] = 1;
      is_turned = !is_turned;
    }
    winding[s] = was_inward != is_turned ? -1 : 1;
    if (!is_turned) continue;
    append(orientation.faces_to_turn, sheets[s].faces);
    if (was_inward) orientation.inside_out.push_back(smallest_vertex(mesh, sheets[s].faces));
  }
}

}  // namespace

Orientation analyze_orientation(const Mesh& mesh, const Edges& edges) {
  Orientation orientation;
  Flood flood(mesh, edges);
  std::vector<ClosedSheet> closed;
  CancelCheck cancel_check;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    if (flood.seen(f) || mesh.face(f).empty()) continue;
    Sheet sheet = flood.visit(f);
    if (sheet.one_sided) {
      append(orientation.one_sided_edges, sheet.inconsistent_edges);
      continue;
    }
    SheetSize size = measure_sheet(mesh, sheet, flood);
    const bool is_consistent = sheet.inconsistent_edges.empty();
    if (!is_consistent) {
      append(orientation.inconsistent_edges, sheet.inconsistent_edges);
      append_flips(sheet, flood, size, orientation.faces_to_flip);
      size.volume = std::abs(size.volume);
    }
    if (sheet.border.empty()) {
      if (is_inward(size) || size.volume > 0.0) {
        closed.push_back({std::move(sheet.faces), size.volume, is_consistent});
      }
    } else if (is_consistent && is_inward_open(mesh, edges, sheet, size)) {
      orientation.inward_open.push_back(smallest_vertex(mesh, sheet.faces));
    }
  }
  turn_inside_out_sheets(mesh, closed, orientation);
  std::ranges::sort(orientation.inconsistent_edges);
  std::ranges::sort(orientation.one_sided_edges);
  std::ranges::sort(orientation.faces_to_flip);
  std::ranges::sort(orientation.inside_out);
  std::ranges::sort(orientation.faces_to_turn);
  std::ranges::sort(orientation.inward_open);
  return orientation;
}

Facing facing_of(const Mesh& mesh, Index vertex) {
  const Orientation orientation = analyze_orientation(mesh, build_edges(mesh));
  if (orientation.inside_out.empty() && orientation.inward_open.empty()) return Facing::outward;
  const Components components = connected_components(mesh.topology().rings);
  const auto is_here = [&](Index v) {
    return components.of_vertex[v] == components.of_vertex[vertex];
  };
  if (std::ranges::any_of(orientation.inside_out, is_here)) return Facing::inside_out;
  return std::ranges::any_of(orientation.inward_open, is_here) ? Facing::inward_open
                                                               : Facing::outward;
}

}  // namespace lapwing
