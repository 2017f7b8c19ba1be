#include <algorithm>
#include <queue>

#include "lapwing/base/cancellation.h"
#include "lapwing/remesh/passes.h"

namespace lapwing::remeshing {
namespace {

// An edge is not split while its triangles have an edge longer than this multiple of its length.
// With 1, small target lengths next to large ones would never be reached. Near 2, triangles at a
// long border edge would be split endlessly.
constexpr double kMuchLonger = 4.0 / 3.0;

struct LongEdge {
  double length;
  Index halfedge;
  bool operator<(const LongEdge& other) const {
    return length != other.length ? length < other.length : halfedge > other.halfedge;
  }
};

class Splitter {
 public:
  explicit Splitter(WorkingPatch& patch) : patch_(patch), net_(patch.net) {}

  bool run(std::size_t most_vertices) {
    CancelCheck cancel_check;
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      if (net_.is_alive(h)) consider(h);
    }
    while (!waiting_.empty()) {
      cancel_check();
      const auto [length, h] = waiting_.top();
      waiting_.pop();
      if (length != patch_.edge_length(h) || !may_split(h, length)) continue;
      if (net_.vertex_count() >= most_vertices) return false;
      split(h);
    }
    return true;
  }

 private:
  void consider(Index h) {
    h = std::min(h, net_.twin(h));
    const double length = patch_.edge_length(h);
    const double wanted = patch_.wanted_length(net_.origin(h), net_.target(h));
    if (net_.twin(h) != kNoIndex && length > kTooLong * wanted) waiting_.push({length, h});
  }

  bool may_split(Index h, double length) const {
    for (const Index side : {h, net_.twin(h)}) {
      for (const Index e : {Halfedges::next(side), Halfedges::previous(side)}) {
        if (patch_.edge_length(e) > kMuchLonger * length) return false;
      }
    }
    return !patch_.is_same(net_.apex(h), net_.apex(net_.twin(h)));
  }

  void split(Index h) {
    const Index v = net_.origin(h);
    const Index u = net_.target(h);
    const Eigen::Vector3d middle = 0.5 * (patch_.at(v) + patch_.at(u));
    if (middle == patch_.at(v) || middle == patch_.at(u)) return;  // limit of precision
    const Index m = net_.split(h);
    patch_.positions.push_back(middle);
    patch_.lengths.push_back(patch_.target_length.at(middle));
    patch_.kinds.push_back(net_.on_line(h) ? VertexKind::line : VertexKind::free);
    patch_.hints.push_back(patch_.kinds[u] == patch_.kinds[m] ? patch_.hints[u] : kNoIndex);
    patch_.sheet_of.push_back(patch_.sheet_of[h / 3]);
    patch_.sheet_of.push_back(patch_.sheet_of[net_.twin(h) / 3]);
    net_.for_outgoing(m, [&](Index out) {
      consider(out);
      consider(Halfedges::next(out));
    });
  }

  WorkingPatch& patch_;
  Halfedges& net_;
  std::priority_queue<LongEdge> waiting_;
};

}  // namespace

bool split_long_edges(WorkingPatch& patch, std::size_t most_vertices) {
  return Splitter(patch).run(most_vertices);
}

}  // namespace lapwing::remeshing
