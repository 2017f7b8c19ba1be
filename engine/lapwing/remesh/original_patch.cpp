#include "lapwing/remesh/original_patch.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::remeshing {
namespace {

// An edge of a polygon outside the patch (`halfedge` is kNoIndex) or of a triangle of the patch.
struct Side {
  std::array<Index, 2> ends;  // mesh vertices, lower first
  Index halfedge;
  auto operator<=>(const Side&) const = default;
};

class PatchCutter {
 public:
  PatchCutter(const Mesh& mesh, const VertexSet& region) : mesh_(mesh) {
    choose_faces(vertex_mask(mesh.vertex_count(), region));
    CancelCheck cancel_check;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      cancel_check();
      if (!patch_.faces_outside[f]) cut_face(f);
    }
    require_finite();
  }

  OriginalPatch run() {
    std::vector<Index> twins = glue();
    number_fans(twins);
    patch_.net = Halfedges(patch_.mesh_vertices.size(), patch_.triangles, std::move(twins));
    fix_border();
    return std::move(patch_);
  }

 private:
  void choose_faces(const std::vector<char>& inside) {
    patch_.faces_outside.assign(mesh_.face_count(), 1);
    CancelCheck cancel_check;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      cancel_check();
      const auto face = mesh_.face(f);
      patch_.faces_outside[f] =
          face.empty() || !std::ranges::all_of(face, [&](Index v) { return inside[v] != 0; });
    }
  }

  // Triangulates face `f` by corner indices, because several corners of a polygon can have the same
  // vertex.
  void cut_face(std::size_t f) {
    const auto face = mesh_.face(f);
    local_numbers_.resize(face.size());
    std::iota(local_numbers_.begin(), local_numbers_.end(), Index{0});
    local_positions_.clear();
    for (const Index v : face) local_positions_.push_back(mesh_.positions[v]);
    cut_.clear();
    triangulate_polygon(local_numbers_, local_positions_, cut_);
    for (const auto& [a, b, c] : cut_) {
      if (face[a] == face[b] || face[b] == face[c] || face[c] == face[a]) continue;
      const Index first = mesh_.face_starts()[f];
      patch_.corners.push_back({first + a, first + b, first + c});
      patch_.triangles.push_back({face[a], face[b], face[c]});
      patch_.faces.push_back(static_cast<Index>(f));
    }
  }

  void require_finite() const {
    std::vector<Index> broken;
    for (const Triangle& t : patch_.triangles) {
      for (const Index v : t) {
        if (!mesh_.positions[v].allFinite()) broken.push_back(v);
      }
    }
    if (broken.empty()) return;
    broken = make_vertex_set(std::move(broken));
    throw InputError("the patch to remesh has a non-finite position at " + name_vertices(broken) +
                         ". Run `lapwing check --fix`, or choose another region",
                     broken);
  }

  std::vector<Side> collect_sides() {
    std::vector<Side> sides;
    used_.assign(mesh_.vertex_count(), 0);
    CancelCheck cancel_check;
    for (Index h = 0; h < 3 * patch_.triangles.size(); ++h) {
      cancel_check();
      const Triangle& t = patch_.triangles[h / 3];
      const auto [low, high] = std::minmax(t[h % 3], t[(h + 1) % 3]);
      sides.push_back({{low, high}, h});
      used_[low] = used_[high] = 1;
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      cancel_check();
      if (!patch_.faces_outside[f]) continue;
      const auto face = mesh_.face(f);
      for (std::size_t i = 0; i < face.size(); ++i) {
        if (used_[face[i]]) used_[face[i]] = kOutsideToo;
        const auto [low, high] = std::minmax(face[i], face[(i + 1) % face.size()]);
        if (low != high && used_[low] && used_[high]) sides.push_back({{low, high}, kNoIndex});
      }
    }
    check_cancelled();
    std::ranges::sort(sides);
    check_cancelled();
    return sides;
  }

  std::vector<Index> glue() {
    const std::vector<Side> sides = collect_sides();
    std::vector<Index> twins(3 * patch_.triangles.size(), kNoIndex);
    CancelCheck cancel_check;
    for (auto first = sides.begin(); first != sides.end();) {
      cancel_check();
      const auto last =
          std::find_if(first, sides.end(), [&](const Side& s) { return s.ends != first->ends; });
      if ((last - 1)->halfedge == kNoIndex) {
        patch_.outside_edges.push_back(first->ends);
      } else if (last - first > 1) {
        require_two_opposite({first, last});
        twins[first->halfedge] = (first + 1)->halfedge;
        twins[(first + 1)->halfedge] = first->halfedge;
      }
      first = last;
    }
    return twins;
  }

  Index start(Index h) const { return patch_.triangles[h / 3][h % 3]; }

  void require_two_opposite(std::span<const Side> sides) const {
    const std::string edge = "the edge between " + name_vertices(sides[0].ends);
    if (sides.size() > 2) {
      throw InputError(edge + " has " + std::to_string(sides.size()) +
                       " triangles; the patch to remesh must be manifold: leave the edge out of "
                       "the region or delete faces");
    }
    if (start(sides[0].halfedge) == start(sides[1].halfedge)) {
      throw InputError("the faces on either side of " + edge +
                       " have opposite orientations; run `lapwing check --fix` first");
    }
  }

  // Assigns a local vertex index to every fan of triangles.
  void number_fans(const std::vector<Index>& twins) {
    std::vector<Index> newest(mesh_.vertex_count(), kNoIndex);
    std::vector<char> closed(mesh_.vertex_count(), 0);
    std::vector<Index> own(twins.size(), kNoIndex);
    CancelCheck cancel_check;
    for (Index h = 0; h < twins.size(); ++h) {
      cancel_check();
      if (own[h] != kNoIndex) continue;
      const Index v = start(h);
      const auto fan = static_cast<Index>(patch_.mesh_vertices.size());
      patch_.mesh_vertices.push_back(v);
      patch_.positions.push_back(mesh_.positions[v]);
      patch_.next_copy.push_back(fan);
      if (newest[v] != kNoIndex) std::swap(patch_.next_copy[fan], patch_.next_copy[newest[v]]);
      const bool is_closed = number_fan(h, fan, twins, own);
      if (newest[v] != kNoIndex && (is_closed || closed[v])) {
        throw InputError("two surfaces touch at " + name_vertices({&v, 1}) +
                         "; the patch to remesh must be manifold: run `lapwing check --fix` or "
                         "leave the vertex out of the region");
      }
      newest[v] = fan;
      closed[v] = is_closed;
    }
    for (Index h = 0; h < own.size(); ++h) patch_.triangles[h / 3][h % 3] = own[h];
  }

  static bool number_fan(Index first, Index fan, const std::vector<Index>& twins,
                         std::vector<Index>& own) {
    Index h = first;
    do {
      own[h] = fan;
      h = twins[Halfedges::previous(h)];
    } while (h != kNoIndex && h != first);
    if (h == first) return true;
    for (h = first; twins[h] != kNoIndex;) {
      h = Halfedges::next(twins[h]);
      own[h] = fan;
    }
    return false;
  }

  void fix_border() {
    for (Index v = 0; v < patch_.mesh_vertices.size(); ++v) {
      const bool bound =
          patch_.net.is_border_vertex(v) || used_[patch_.mesh_vertices[v]] == kOutsideToo;
      patch_.bound.push_back(bound);
      patch_.kinds.push_back(bound ? VertexKind::fixed : VertexKind::free);
    }
  }

  static constexpr char kOutsideToo = 2;

  const Mesh& mesh_;
  OriginalPatch patch_;
  std::vector<char> used_;  // per mesh vertex: 1 if the patch uses it, 2 if faces outside do too
  std::vector<Index> local_numbers_;
  Positions local_positions_;
  std::vector<Triangle> cut_;
};

}  // namespace

OriginalPatch cut_patch(const Mesh& mesh, const VertexSet& region) {
  return PatchCutter(mesh, region).run();
}

}  // namespace lapwing::remeshing
