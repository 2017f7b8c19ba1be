#include "lapwing/doctor/holes.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {
namespace {

constexpr std::ptrdiff_t kLeastRim = 3;
constexpr const char* kRepairFirst = "; repair the mesh with `lapwing check MESH --fix OUT`";

// Follows the boundary sides from fan to fan.
class LoopFinder {
 public:
  LoopFinder(const Mesh& mesh, const Edges& edges, const Fans& fans)
      : mesh_(mesh), edges_(edges), fans_(fans), out_(mesh.face_vertices().size(), kNoIndex) {
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (edges.is_boundary(e)) sides_.push_back(edges.sides[e][0]);
    }
    std::vector<Index> in(out_.size(), kNoIndex);
    is_branching_.assign(out_.size(), 0);
    for (const Index side : sides_) {
      enter(out_, start_fan(side), side);
      enter(in, end_fan(side), side);
    }
    for (const Index side : sides_) {
      if (in[start_fan(side)] == kNoIndex) is_branching_[start_fan(side)] = 1;
      if (out_[end_fan(side)] == kNoIndex) is_branching_[end_fan(side)] = 1;
    }
  }

  std::vector<Hole> find() const {
    UnionFind groups = linked_loops(
        edges_.sides, out_.size(), [&](Index c) { return fans_.of_corner[c]; },
        [&](Index c) { return edges_.next_corner[c]; });
    std::vector<Index> loop_of(out_.size(), kNoIndex);
    std::vector<std::vector<Index>> loops;
    CancelCheck cancel_check;
    for (const Index side : sides_) {
      cancel_check();
      Index& loop = loop_of[groups.find(start_fan(side))];
      if (loop == kNoIndex) {
        loop = static_cast<Index>(loops.size());
        loops.emplace_back();
      }
      loops[loop].push_back(side);
    }
    std::vector<Hole> holes;
    for (const auto& sides : loops) append_holes(sides, holes);
    return holes;
  }

 private:
  Index start(Index side) const { return mesh_.face_vertices()[side]; }
  Index start_fan(Index side) const { return fans_.of_corner[side]; }
  Index end_fan(Index side) const { return fans_.of_corner[edges_.next_corner[side]]; }

  void enter(std::vector<Index>& of_fan, Index fan, Index side) {
    if (of_fan[fan] != kNoIndex) is_branching_[fan] = 1;
    of_fan[fan] = side;
  }

  bool is_single_face(const std::vector<Index>& sides) const {
    const Index face = edges_.face_of_corner[sides.front()];
    return sides.size() == mesh_.face(face).size() && std::ranges::all_of(sides, [&](Index side) {
             return edges_.face_of_corner[side] == face;
           });
  }

  std::string trouble_of(const std::vector<Index>& sides) const {
    if (is_single_face(sides)) {
      return "the part is a single face, which the fill would duplicate; remove or extrude the "
             "face in a modelling tool";
    }
    for (const Index side : sides) {
      for (const Index corner : {side, edges_.next_corner[side]}) {
        const Index v = mesh_.face_vertices()[corner];
        const std::string name = "vertex " + std::to_string(v);
        if (!mesh_.positions[v].allFinite()) return name + " is not finite" + kRepairFirst;
        if (is_branching_[fans_.of_corner[corner]] != 0) {
          return "at " + name +
                 " an edge has more than two faces, or faces have opposite orientations" +
                 kRepairFirst + ", or remove the surplus faces in a modelling tool";
        }
      }
    }
    return {};
  }

  Hole refused(const std::vector<Index>& sides, std::string trouble) const {
    Hole hole;
    hole.trouble = std::move(trouble);
    for (const Index side : sides) {
      const Index end = start(edges_.next_corner[side]);
      hole.perimeter += (mesh_.positions[end] - mesh_.positions[start(side)]).norm();
      hole.rim.insert(hole.rim.end(), {start(side), end});
    }
    std::ranges::sort(hole.rim);
    hole.rim.erase(std::unique(hole.rim.begin(), hole.rim.end()), hole.rim.end());
    return hole;
  }

  Hole hole_of(std::vector<Index> rim) const {
    Hole hole;
    hole.rim = std::move(rim);
    for (std::size_t k = 0; k < hole.rim.size(); ++k) {
      const Index next = hole.rim[(k + 1) % hole.rim.size()];
      hole.perimeter += (mesh_.positions[next] - mesh_.positions[hole.rim[k]]).norm();
    }
    // The faces of the surface traverse the rim in the opposite direction.
    std::ranges::reverse(hole.rim);
    std::rotate(hole.rim.begin(), std::ranges::min_element(hole.rim), hole.rim.end());
    return hole;
  }

  static std::vector<Index> vertices_at(std::span<const std::size_t> places,
                                        const std::vector<Index>& loop) {
    std::vector<Index> vertices;
    for (const std::size_t place : places) vertices.push_back(loop[place]);
    return vertices;
  }

  // Appends the loop of `sides`. Splits it into several loops at each point that it visits more
  // than once.
  void append_holes(const std::vector<Index>& sides, std::vector<Hole>& holes) const {
    if (std::string trouble = trouble_of(sides); !trouble.empty()) {
      holes.push_back(refused(sides, std::move(trouble)));
      return;
    }
    std::vector<Index> loop;
    Positions points;
    for (Index side = sides.front(); loop.size() < sides.size(); side = out_[end_fan(side)]) {
      loop.push_back(start(side));
      points.push_back(mesh_.positions[start(side)]);
    }
    const std::vector<Index> first = first_at_same_position(points);
    std::vector<std::size_t> open;  // indices into `loop`
    auto left = std::ssize(loop);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (first[k] != k) {
        const auto before =
            std::ranges::find_if(open, [&](std::size_t place) { return first[place] == first[k]; });
        const std::ptrdiff_t count = open.end() - before;
        if (count >= kLeastRim && left - count >= kLeastRim) {
          holes.push_back(hole_of(vertices_at({before, open.end()}, loop)));
          open.erase(before, open.end());
          left -= count;
        }
      }
      open.push_back(k);
    }
    holes.push_back(hole_of(vertices_at(open, loop)));
  }

  const Mesh& mesh_;
  const Edges& edges_;
  const Fans& fans_;
  std::vector<Index> sides_;        // the boundary sides
  std::vector<Index> out_;          // per fan: the boundary side that starts there
  std::vector<char> is_branching_;  // per fan: not exactly one side starts and one ends there
};

void mark_borders(const Mesh& mesh, std::vector<Hole>& holes) {
  const Topology& topology = mesh.topology();
  const Components parts = connected_components(topology.rings);
  std::vector<double> areas(parts.count, 0.0);
  for (const auto& [a, b, c] : topology.triangles) {
    const Eigen::Vector3d& corner = mesh.positions[a];
    areas[parts.of_vertex[a]] +=
        0.5 * (mesh.positions[b] - corner).cross(mesh.positions[c] - corner).norm();
  }
  std::vector<Hole*> longest(parts.count, nullptr);
  for (Hole& hole : holes) {
    Hole*& known = longest[parts.of_vertex[hole.rim.front()]];
    if (known == nullptr || hole.perimeter > known->perimeter) known = &hole;
  }
  for (std::size_t part = 0; part < parts.count; ++part) {
    if (longest[part] == nullptr) continue;
    const double perimeter = longest[part]->perimeter;
    longest[part]->is_border = perimeter * perimeter > 2.0 * std::numbers::pi * areas[part];
  }
}

}  // namespace

std::vector<Hole> find_holes(const Mesh& mesh) {
  validate_indices(mesh);
  const JoinedSurface joined = joined_surface(mesh);
  const Mesh& surface = joined.empty() ? mesh : joined.surface;
  std::vector<unsigned char> is_proper(surface.face_count(), 0);
  for (const Index face : surface.topology().triangle_faces) is_proper[face] = 1;
  const Edges edges = build_edges(surface, is_proper);
  return find_holes(surface, edges, find_fans(surface, edges));
}

std::vector<Hole> find_holes(const Mesh& mesh, const Edges& edges, const Fans& fans) {
  std::vector<Hole> holes = LoopFinder(mesh, edges, fans).find();
  mark_borders(mesh, holes);
  std::ranges::sort(holes, [](const Hole& a, const Hole& b) {
    return std::pair(b.rim.size(), a.rim.front()) < std::pair(a.rim.size(), b.rim.front());
  });
  return holes;
}

std::string name_hole(const Hole& hole) {
  return "the hole with " + counted(hole.rim.size(), "rim vertices") + " at vertex " +
         std::to_string(hole.rim.front());
}

std::vector<Hole> chosen(const std::vector<Hole>& holes, const HoleChoice& choice) {
  std::vector<Hole> result;
  for (const Hole& hole : holes) {
    const bool is_small =
        choice.most_rim_vertices == 0 || hole.rim.size() <= choice.most_rim_vertices;
    if (is_small && (choice.borders || !hole.is_border)) result.push_back(hole);
  }
  return result;
}

}  // namespace lapwing
