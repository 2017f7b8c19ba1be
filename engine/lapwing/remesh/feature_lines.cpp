#include "lapwing/remesh/feature_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

const double kCornerCosine = std::cos(std::numbers::pi / 4);

// A triangle is degenerate if its doubled area is below this fraction of its squared longest edge.
constexpr double kNoAreaShare = 1e-12;

// Stored normals that differ by less are considered equal, because files contain few digits.
constexpr double kSameNormal = 1e-3;

struct Facing {
  Vector3d normal = Vector3d::Zero();  // zero for a degenerate triangle
  Index longest = kNoIndex;            // half-edge of the longest edge
};

class LineFinder {
 public:
  LineFinder(const Mesh& mesh, const std::vector<double>& lengths, OriginalPatch& patch)
      : mesh_(mesh), lengths_(lengths), patch_(patch), net_(patch.net) {}

  void run(double angle_degrees) {
    mark_edges(angle_degrees);
    mark_normal_seams();
    collect_degrees();
    fix_corners();
    number_lines();
    number_border();
    collect_sheets();
  }

 private:
  std::vector<Facing> triangle_normals() const {
    std::vector<Facing> facings(patch_.triangles.size());
    for (Index t = 0; t < facings.size(); ++t) {
      const auto [a, b, c] = patch_.corner_positions(t);
      const std::array sides{(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
      const auto longest = std::max_element(sides.begin(), sides.end()) - sides.begin();
      facings[t].longest = 3 * t + static_cast<Index>(longest);
      const Vector3d normal = (b - a).cross(c - a);
      const double area = normal.norm();
      if (area > kNoAreaShare * sides[static_cast<std::size_t>(longest)]) {
        facings[t].normal = normal / area;
      }
    }
    // A degenerate triangle takes the normal of its neighbour across its longest edge. Several
    // iterations handle adjacent degenerate triangles.
    for (int round = 0; round < 4; ++round) {
      for (Facing& facing : facings) {
        const Index across = net_.twin(facing.longest);
        if (facing.normal.isZero(0.0) && across != kNoIndex) {
          facing.normal = facings[across / 3].normal;
        }
      }
    }
    return facings;
  }

  // Returns whether the corners of the two triangles differ at an end of their common edge.
  template <class Differs>
  bool differs_across(Index h, Index k, const Differs& differs) const {
    const auto corner = [&](Index x) { return patch_.corners[x / 3][x % 3]; };
    return differs(corner(h), corner(Halfedges::next(k))) ||
           differs(corner(Halfedges::next(h)), corner(k));
  }

  bool differs_in_texture(Index h, Index k) const {
    const MeshAttributes& a = mesh_.attributes();
    if (a.corner_uvs.empty()) return false;
    return differs_across(h, k, [&](Index x, Index y) {
      const Index i = a.corner_uvs[x];
      const Index j = a.corner_uvs[y];
      return i != j && (i == kNoIndex || j == kNoIndex || a.uvs[i] != a.uvs[j]);
    });
  }

  bool differs_in_normals(Index h, Index k) const {
    const MeshAttributes& a = mesh_.attributes();
    return differs_across(h, k, [&](Index x, Index y) {
      const Index i = a.corner_normals[x];
      const Index j = a.corner_normals[y];
      if (i == j || i == kNoIndex || j == kNoIndex) return false;
      return (a.normals[i] - a.normals[j]).norm() > kSameNormal;
    });
  }

  // Marks edges at which stored normals differ, unless they differ at more than half of all edges.
  void mark_normal_seams() {
    if (mesh_.attributes().corner_normals.empty()) return;
    std::vector<Index> seams;
    std::size_t inner_edges = 0;
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      const Index k = net_.twin(h);
      if (k == kNoIndex || k < h) continue;
      ++inner_edges;
      if (differs_in_normals(h, k)) seams.push_back(h);
    }
    if (2 * seams.size() > inner_edges) return;
    for (const Index h : seams) is_line_[h] = is_line_[net_.twin(h)] = 1;
  }

  bool differs_in_label(Index f, Index g) const {
    const MeshAttributes& a = mesh_.attributes();
    return (!a.face_materials.empty() && a.face_materials[f] != a.face_materials[g]) ||
           (!a.face_groups.empty() && a.face_groups[f] != a.face_groups[g]);
  }

  void mark_edges(double angle_degrees) {
    const double cosine = std::cos(angle_degrees * std::numbers::pi / 180.0);
    const std::vector<Facing> facings = triangle_normals();
    is_line_.assign(net_.halfedge_count(), 0);
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      const Index k = net_.twin(h);
      if (k == kNoIndex || k < h) continue;
      const Index f = patch_.faces[h / 3];
      const Index g = patch_.faces[k / 3];
      if (f == g) continue;
      const Vector3d& n = facings[h / 3].normal;
      const Vector3d& m = facings[k / 3].normal;
      const bool sharp = !n.isZero(0.0) && !m.isZero(0.0) && n.dot(m) < cosine;
      is_line_[h] = is_line_[k] = sharp || differs_in_label(f, g) || differs_in_texture(h, k);
    }
  }

  void collect_degrees() {
    degrees_.assign(net_.vertex_count(), 0);
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      if (is_line_[h]) ++degrees_[net_.origin(h)];
    }
  }

  // Returns an outgoing line half-edge of `v` other than `h`. It is unique if the line passes
  // through `v`.
  Index other_way(Index v, Index h) const {
    Index other = kNoIndex;
    net_.for_outgoing(v, [&](Index out) {
      if (is_line_[out] && out != h) other = out;
    });
    return other;
  }

  bool passes(Index v) const { return degrees_[v] == 2 && patch_.kinds[v] != VertexKind::fixed; }

  // Returns the point of the line at distance `reach` from `v` in the direction of `h`, or the end
  // of the line.
  Vector3d point_along(Index v, Index h, double reach) const {
    double gone = 0.0;
    Index end = net_.target(h);
    for (;;) {  // on a closed line, terminates at `v`
      gone += (patch_.positions[end] - patch_.positions[net_.origin(h)]).norm();
      if (gone >= reach || end == v || !passes(end)) return patch_.positions[end];
      h = other_way(end, net_.twin(h));
      end = net_.target(h);
    }
  }

  bool turns_at(Index v) const {
    const Index h = other_way(v, kNoIndex);
    const Index k = other_way(v, h);
    const Vector3d& p = patch_.positions[v];
    const auto turns = [&](const Vector3d& to, const Vector3d& from) {
      const Vector3d in = p - from;
      const Vector3d out = to - p;
      return in.dot(out) < kCornerCosine * in.norm() * out.norm();
    };
    if (!turns(patch_.positions[net_.target(h)], patch_.positions[net_.target(k)])) return false;
    return turns(point_along(v, h, lengths_[v]), point_along(v, k, lengths_[v]));
  }

  void fix_corners() {
    std::vector<Index> corners;
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (degrees_[v] == 0 || patch_.kinds[v] == VertexKind::fixed) continue;
      if (degrees_[v] != 2 || turns_at(v)) corners.push_back(v);
    }
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      if (passes(v)) patch_.kinds[v] = VertexKind::line;
    }
    for (const Index v : corners) patch_.kinds[v] = VertexKind::fixed;
  }

  void follow_line(Index h) {
    const auto line = static_cast<Index>(patch_.lines.row_count());
    for (;;) {
      patch_.lines.values.push_back(h);
      net_.set_side(h, 2 * line);
      net_.set_side(net_.twin(h), 2 * line + 1);
      const Index end = net_.target(h);
      if (patch_.kinds[end] == VertexKind::fixed) break;
      h = other_way(end, net_.twin(h));
      if (net_.on_line(h)) break;
    }
    patch_.lines.starts.push_back(static_cast<Index>(patch_.lines.values.size()));
  }

  // Numbers first the lines between fixed vertices, then the closed lines without fixed vertices.
  void number_lines() {
    for (const bool closed : {false, true}) {
      for (Index h = 0; h < net_.halfedge_count(); ++h) {
        if (!is_line_[h] || net_.on_line(h)) continue;
        if (closed || patch_.kinds[net_.origin(h)] == VertexKind::fixed) follow_line(h);
      }
    }
  }

  void number_border() {
    auto side = static_cast<Index>(2 * patch_.lines.row_count());
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      if (net_.twin(h) != kNoIndex) continue;
      net_.set_side(h, side);
      side += 2;
    }
  }

  void collect_sheets() {
    patch_.sheet_of.assign(patch_.triangles.size(), kNoIndex);
    std::vector<Index> stack;
    CancelCheck cancel_check;
    for (Index seed = 0; seed < patch_.triangles.size(); ++seed) {
      cancel_check();
      if (patch_.sheet_of[seed] != kNoIndex) continue;
      const auto sheet = static_cast<Index>(patch_.sheets.row_count());
      patch_.sheet_of[seed] = sheet;
      stack.assign(1, seed);
      while (!stack.empty()) {
        const Index t = stack.back();
        stack.pop_back();
        patch_.sheets.values.push_back(t);
        for (Index h = 3 * t; h < 3 * t + 3; ++h) {
          if (net_.on_line(h)) continue;
          const Index other = net_.twin(h) / 3;
          if (patch_.sheet_of[other] != kNoIndex) continue;
          patch_.sheet_of[other] = sheet;
          stack.push_back(other);
        }
      }
      patch_.sheets.starts.push_back(static_cast<Index>(patch_.sheets.values.size()));
    }
  }

  const Mesh& mesh_;
  const std::vector<double>& lengths_;
  OriginalPatch& patch_;
  Halfedges& net_;
  std::vector<char> is_line_;  // per half-edge
  std::vector<int> degrees_;   // per vertex: number of its line edges
};

}  // namespace

void find_feature_lines(const Mesh& mesh, double angle_degrees, const std::vector<double>& lengths,
                        OriginalPatch& patch) {
  LineFinder(mesh, lengths, patch).run(angle_degrees);
}

}  // namespace lapwing::remeshing
