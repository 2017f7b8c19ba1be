#include "lapwing/remesh/attribute_sources.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kGrain = 256;

// Expresses each point in mesh vertices and, per sector, in mesh corners.
class SourceFinder {
 public:
  explicit SourceFinder(const WorkingPatch& patch)
      : patch_(patch), net_(patch.net), original_(patch.original) {}

  AttributeSources run() {
    sources_.vertices.resize(net_.vertex_count());
    sources_.sectors_of_corners.assign(net_.halfedge_count(), kNoIndex);
    find_free_points();
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (!net_.has_vertex(v)) continue;
      if (patch_.kinds[v] == VertexKind::free) add_free(v);
      if (patch_.kinds[v] == VertexKind::line) add_on_line(v);
      if (patch_.kinds[v] == VertexKind::fixed) add_fixed(v);
    }
    find_faces();
    return std::move(sources_);
  }

 private:
  void find_free_points() {
    free_points_.resize(net_.vertex_count());
    parallel_for(free_points_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      CancelCheck cancel_check;
      for (auto v = static_cast<Index>(begin); v < end; ++v) {
        cancel_check();
        if (!net_.has_vertex(v) || patch_.kinds[v] != VertexKind::free) continue;
        free_points_[v] = patch_.reference.on_sheet(patch_.sheet_of[net_.outgoing(v) / 3],
                                                    patch_.at(v), patch_.normal_at(v));
      }
    });
  }

  void find_faces() {
    sources_.faces.assign(net_.triangle_count(), kNoIndex);
    parallel_for(sources_.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      CancelCheck cancel_check;
      for (auto t = static_cast<Index>(begin); t < end; ++t) {
        cancel_check();
        if (!net_.is_alive(3 * t)) continue;
        const auto [a, b, c] = patch_.triangle(3 * t);
        const TrianglePoint found =
            patch_.reference.on_sheet(patch_.sheet_of[t], (a + b + c) / 3.0, (b - a).cross(c - a));
        sources_.faces[t] = original_.faces[found.triangle];
      }
    });
  }

  Index mesh_corner(Index original_halfedge) const {
    return original_.corners[original_halfedge / 3][original_halfedge % 3];
  }
  Index mesh_vertex(Index original_halfedge) const {
    return original_.mesh_vertices[original_.net.origin(original_halfedge)];
  }

  // Adds the sector from `first` counterclockwise to the next line or border, or all around.
  void add_sector(Index first, const SurfacePoint& in_corners) {
    Index h = first;
    do {
      sources_.sectors_of_corners[h] = static_cast<Index>(sources_.sectors.size());
      h = net_.turn(h);
    } while (h != kNoIndex && h != first && !net_.on_line(h));
    sources_.sectors.push_back(in_corners);
  }

  void add_free(Index v) {
    const TrianglePoint& found = free_points_[v];
    const Index h = 3 * found.triangle;
    sources_.vertices[v] = {{mesh_vertex(h), mesh_vertex(h + 1), mesh_vertex(h + 2)},
                            found.weights};
    add_sector(net_.outgoing(v), {original_.corners[found.triangle], found.weights});
  }

  void add_on_line(Index v) {
    const LinePoint found = patch_.reference.on_line(patch_.line_of(v), patch_.at(v));
    const std::array weights{1.0 - found.along, found.along, 0.0};
    const Index from = found.halfedge;
    const Index to = Halfedges::next(from);
    sources_.vertices[v] = {{mesh_vertex(from), mesh_vertex(to), mesh_vertex(to)}, weights};
    const Index other_to = original_.net.twin(from);
    const Index other_from = Halfedges::next(other_to);
    net_.for_outgoing(v, [&](Index h) {
      if (!net_.on_line(h)) return;
      const bool same_way = net_.side(h) % 2 == 0;
      const Index a = mesh_corner(same_way ? from : other_from);
      const Index b = mesh_corner(same_way ? to : other_to);
      add_sector(h, {{a, b, b}, weights});
    });
  }

  // Fixed vertices are original ones, and lines and borders at them still have the original sides.
  void add_fixed(Index v) {
    sources_.vertices[v] = SurfacePoint::at_vertex(original_.mesh_vertices[v]);
    bool has_lines = false;
    net_.for_outgoing(v, [&](Index h) {
      if (!net_.on_line(h)) return;
      has_lines = true;
      add_sector(h, SurfacePoint::at_vertex(original_corner(v, net_.side(h))));
    });
    if (has_lines) return;
    add_sector(net_.outgoing(v), SurfacePoint::at_vertex(mesh_corner(original_.net.outgoing(v))));
  }

  Index original_corner(Index v, Index side) const {
    Index corner = kNoIndex;
    original_.net.for_outgoing(v, [&](Index h) {
      if (original_.net.side(h) == side) corner = mesh_corner(h);
    });
    return corner;
  }

  const WorkingPatch& patch_;
  const Halfedges& net_;
  const OriginalPatch& original_;
  std::vector<TrianglePoint> free_points_;
  AttributeSources sources_;
};

}  // namespace

AttributeSources find_attribute_sources(const WorkingPatch& patch) {
  return SourceFinder(patch).run();
}

Index nearest_corner(const SurfacePoint& point) {
  const auto largest = std::max_element(point.weights.begin(), point.weights.end());
  return point.corners[static_cast<std::size_t>(largest - point.weights.begin())];
}

}  // namespace lapwing::remeshing
