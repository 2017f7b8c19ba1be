#include "lapwing/doctor/orientation.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// Faces connected through edges with two sides, as the flood found them.
struct Sheet {
  std::vector<Index> faces;
  std::vector<Index> inconsistent_edges;
  bool closed = true;
  bool one_sided = false;
};

class Flood {
 public:
  Flood(const Mesh& mesh, const Edges& edges)
      : mesh_(mesh), edges_(edges), state_(mesh.face_count(), kUnseen) {}

  bool seen(Index face) const { return state_[face] != kUnseen; }
  bool flipped(Index face) const { return state_[face] == kFlipped; }

  // Visits every face of the sheet of `seed`, and decides for each whether to flip it so that it
  // agrees with the face it was reached from.
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
      sheet.closed = false;
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

// Returns six times the volume that the sheet encloses after its marked faces are flipped.
double signed_volume(const Mesh& mesh, const Sheet& sheet, const Flood& flood) {
  // Measured from a point of the sheet: far from the origin the terms would cancel.
  const Eigen::Vector3d origin = mesh.positions[mesh.face(sheet.faces[0])[0]];
  double volume = 0.0;
  for (const Index f : sheet.faces) {
    const auto polygon = mesh.face(f);
    const Eigen::Vector3d a = mesh.positions[polygon[0]] - origin;
    double part = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Eigen::Vector3d b = mesh.positions[polygon[k]] - origin;
      const Eigen::Vector3d c = mesh.positions[polygon[k + 1]] - origin;
      part += a.dot(b.cross(c));
    }
    volume += flood.flipped(f) ? -part : part;
  }
  return volume;
}

void append_flips(const Mesh& mesh, const Sheet& sheet, const Flood& flood,
                  std::vector<Index>& faces_to_flip) {
  const auto marked = static_cast<std::size_t>(
      std::ranges::count_if(sheet.faces, [&](Index f) { return flood.flipped(f); }));
  const bool flip_marked =
      sheet.closed ? signed_volume(mesh, sheet, flood) >= 0.0 : 2 * marked <= sheet.faces.size();
  for (const Index f : sheet.faces) {
    if (flood.flipped(f) == flip_marked) faces_to_flip.push_back(f);
  }
}

void append(std::vector<Index>& list, const std::vector<Index>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

Orientation analyze_orientation(const Mesh& mesh, const Edges& edges) {
  Orientation orientation;
  Flood flood(mesh, edges);
  CancelCheck cancel_check;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    if (flood.seen(f)) continue;
    const Sheet sheet = flood.visit(f);
    if (sheet.one_sided) {
      append(orientation.one_sided_edges, sheet.inconsistent_edges);
    } else if (!sheet.inconsistent_edges.empty()) {
      append(orientation.inconsistent_edges, sheet.inconsistent_edges);
      append_flips(mesh, sheet, flood, orientation.faces_to_flip);
    }
  }
  std::ranges::sort(orientation.inconsistent_edges);
  std::ranges::sort(orientation.one_sided_edges);
  std::ranges::sort(orientation.faces_to_flip);
  return orientation;
}

}  // namespace lapwing
