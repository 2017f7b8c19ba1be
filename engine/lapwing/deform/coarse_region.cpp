#include "lapwing/deform/coarse_region.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/prepared_region.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kCarriedPerTask = 1024;
constexpr std::size_t kBoundPerTask = 128;

// Of a handle of fewer vertices each counts.
constexpr std::size_t kSmallHandle = 16;

enum Group : Index { kFree, kBelt, kFirstHandle };

// Per vertex of the mesh: what it may be merged with. Vertices outside the region stay, as do those
// that something asks of by number.
std::vector<Index> groups_of(const EditRegion& region, std::size_t vertices) {
  std::vector<Index> groups(vertices, kKeptGroup);
  for (const Index v : region.roi) groups[v] = kFree;
  for (const Index v : region.belt) groups[v] = kBelt;
  for (std::size_t h = 0; h < region.handles.size(); ++h) {
    const VertexSet& handle = region.handles[h];
    const bool is_small = handle.size() <= kSmallHandle;
    for (const Index v : handle) {
      groups[v] = is_small ? kKeptGroup : kFirstHandle + static_cast<Index>(h);
    }
  }
  for (const Target& target : region.targets) {
    for (const Index v : target.corners) groups[v] = kKeptGroup;
  }
  return groups;
}

std::vector<Triangle> triangles_of(const EditRegion& region, const Topology& topology) {
  std::vector<char> in_roi(topology.vertex_count(), 0);
  for (const Index v : region.roi) in_roi[v] = 1;
  std::vector<Triangle> triangles;
  std::copy_if(topology.triangles.begin(), topology.triangles.end(), std::back_inserter(triangles),
               [&](const Triangle& t) {
                 return std::any_of(t.begin(), t.end(), [&](Index v) { return in_roi[v] != 0; });
               });
  return triangles;
}

// `region` in the numbers of what is left; `own` per vertex of the mesh.
EditRegion kept_of(const EditRegion& region, std::span<const Index> own) {
  const auto kept = [&](const VertexSet& set) {
    VertexSet left;
    for (const Index v : set) {
      if (own[v] != kNoIndex) left.push_back(own[v]);
    }
    return left;
  };
  EditRegion coarse;
  coarse.roi = kept(region.roi);
  coarse.belt = kept(region.belt);
  for (const VertexSet& handle : region.handles) coarse.handles.push_back(kept(handle));
  coarse.handle_weights = region.handle_weights;
  for (GradedVertex graded : region.graded) {
    graded.vertex = own[graded.vertex];
    if (graded.vertex != kNoIndex) coarse.graded.push_back(graded);
  }
  for (Target target : region.targets) {
    for (Index& corner : target.corners) corner = own[corner];
    coarse.targets.push_back(target);
  }
  coarse.hard_targets = region.hard_targets;
  coarse.turns_freely = region.turns_freely;
  return coarse;
}

}  // namespace

std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count) {
  const Positions& rest = *fine.rest;
  const std::vector<Index> groups = groups_of(fine.region, rest.size());
  // In numbers of their own, so that decimating a part of a mesh costs no more than that part.
  NumberedTriangles near = numbered(triangles_of(fine.region, fine.topology));
  Positions near_rest;
  std::vector<Index> near_groups;
  std::size_t outside = 0;
  for (const Index v : near.vertices) {
    near_rest.push_back(rest[v]);
    near_groups.push_back(groups[v]);
    if (!std::binary_search(fine.region.roi.begin(), fine.region.roi.end(), v)) ++outside;
  }
  Decimated left = decimate(near_rest, std::move(near.triangles), near_groups, count + outside);
  if (left.kept.size() > outside + fine.region.roi.size() / 2) return nullptr;

  auto coarse = std::make_unique<CoarseRegion>();
  coarse->owners.assign(rest.size(), kNoIndex);
  for (std::size_t k = 0; k < near.vertices.size(); ++k) {
    coarse->owners[near.vertices[k]] = left.owners[k];
  }
  for (const Index k : left.kept) coarse->kept.push_back(near.vertices[k]);
  Positions own_rest;
  for (const Index v : coarse->kept) own_rest.push_back(rest[v]);
  coarse->topology.triangles = std::move(left.triangles);
  coarse->topology.vertex_triangles =
      triangles_around_vertices(own_rest.size(), coarse->topology.triangles);
  coarse->topology.rings =
      rings_by_triangles(coarse->topology.vertex_triangles, coarse->topology.triangles);
  try {
    coarse->prepared = std::make_unique<PreparedRegion>(coarse->topology);
    coarse->edit = std::make_unique<const EditSystem>(
        *coarse->prepared, own_rest, kept_of(fine.region, places_in(coarse->kept, rest.size())),
        fine.options, Progress(), true);
  } catch (const InputError&) {
    return nullptr;
  } catch (const SolverError&) {
    return nullptr;
  }
  return coarse;
}

CoarseEmbedding::CoarseEmbedding(const EditSystem& fine, const CoarseRegion& coarse)
    : fine_(fine), coarse_(coarse) {
  for (const Index v : fine.region.roi) {
    if (coarse.owners[v] != kNoIndex) vertices_.push_back(v);
  }
  bounds_.resize(vertices_.size());
  origin_ = vertices_.empty() ? Vector3d::Zero() : (*fine.rest)[vertices_.front()];
  std::vector<Index> owners;
  for (const Index v : vertices_) owners.push_back(coarse.owners[v]);
  const Adjacency owned = all_places_in(owners, coarse.kept.size());
  parallel_for(coarse.kept.size(), kBoundPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) bind(static_cast<Index>(c), owned[c]);
  });

  // Which nodes each coarse vertex is, so that forces are gathered without two threads at one.
  std::vector<Index> nodes;
  for (const Bound& bound : bounds_) {
    for (std::size_t node = 0; node < kNodes; ++node) {
      nodes.push_back(bound.weights[node] > 0.0 ? bound.nodes[node] : kNoIndex);
    }
  }
  bound_to_ = all_places_in(nodes, coarse.kept.size());
}

// To the nearest of the two rings around their owner, by (1 - d / D)^2, D how far the next one is:
// as a vertex takes another's place it has no weight.
void CoarseEmbedding::bind(Index owner, std::span<const Index> owned) {
  if (owned.empty()) return;
  const Adjacency& rings = coarse_.topology.rings;
  const Positions& rest = *coarse_.edit->rest;
  std::vector<Index> near{owner};
  for (const Index j : rings[owner]) {
    near.push_back(j);
    near.insert(near.end(), rings[j].begin(), rings[j].end());
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  // The nearest by their squared distances, and the next one.
  std::array<std::pair<double, Index>, kNodes + 1> by_square;
  const std::size_t count = std::min(kNodes, near.size() - 1);
  for (const Index k : owned) {
    const Vector3d& here = (*fine_.rest)[vertices_[k]];
    std::size_t listed = 0;
    for (const Index c : near) {
      const double square = (here - rest[c]).squaredNorm();
      if (listed > count && !(square < by_square[count].first)) continue;
      std::size_t at = listed > count ? count : listed++;
      for (; at > 0 && square < by_square[at - 1].first; --at) by_square[at] = by_square[at - 1];
      by_square[at] = {square, c};
    }
    Bound& bound = bounds_[k];
    double sum = 0.0;
    for (std::size_t node = 0; node < count; ++node) {
      const double share = 1.0 - std::sqrt(by_square[node].first / by_square[count].first);
      bound.nodes[node] = by_square[node].second;
      bound.weights[node] = share > 0.0 ? share * share : 0.0;
      sum += bound.weights[node];
    }
    if (!(sum > 0.0)) {
      bound = {};
      bound.nodes[0] = by_square[0].second;
      bound.weights[0] = sum = 1.0;
    }
    for (double& weight : bound.weights) weight /= sum;
  }
}

void CoarseEmbedding::carry(const Pose& from, const Pose& to, std::span<Vector3d> u) const {
  // x -> A x + t about the origin.
  using Affine = Eigen::Matrix<double, 3, 4>;
  std::vector<Affine> motions(coarse_.kept.size());
  for (std::size_t c = 0; c < motions.size(); ++c) {
    const Vector3d at = (*coarse_.edit->rest)[c] - origin_ + from.displacement[c];
    const Matrix3d turn = to.transforms[c] * from.transforms[c].inverse() - Matrix3d::Identity();
    motions[c] << turn, to.displacement[c] - from.displacement[c] - turn * at;
  }
  parallel_for(vertices_.size(), kCarriedPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Bound& bound = bounds_[k];
      Affine motion = bound.weights[0] * motions[bound.nodes[0]];
      for (std::size_t node = 1; node < kNodes; ++node) {
        motion += bound.weights[node] * motions[bound.nodes[node]];
      }
      const Index v = vertices_[k];
      const Vector3d at = (*fine_.rest)[v] - origin_ + u[v];
      u[v] += motion.leftCols<3>() * at + motion.col(3);
    }
  });
}

std::vector<Vector3d> CoarseEmbedding::gather(std::span<const Vector3d> forces,
                                              std::span<const Vector3d> u, const Pose& pose) const {
  const Adjacency& rings = coarse_.topology.rings;
  const Positions& fine_rest = *fine_.rest;
  const Positions& rest = *coarse_.edit->rest;
  const std::size_t count = coarse_.kept.size();
  const auto place = [&](std::size_t c) -> Vector3d { return rest[c] + pose.displacement[c]; };
  // What turns a vertex pulls its ring around it: w x e_k at neighbour k, with sum_k e_k x (w x
  // e_k) the moment.
  std::vector<Vector3d> pulls(count, Vector3d::Zero());
  std::vector<Vector3d> turns(count, Vector3d::Zero());
  constexpr std::size_t kCoarsePerTask = 64;
  parallel_for(count, kCoarsePerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      Vector3d moment = Vector3d::Zero();
      for (const Index entry : bound_to_[c]) {
        const std::size_t k = entry / kNodes;
        const Index v = vertices_[k];
        const Vector3d force = bounds_[k].weights[entry % kNodes] * forces[v];
        pulls[c] += force;
        moment += (fine_rest[v] - rest[c] + u[v] - pose.displacement[c]).cross(force);
      }
      if (moment.isZero(0.0)) continue;
      Matrix3d inertia = Matrix3d::Zero();
      for (const Index j : rings[c]) {
        const Vector3d e = place(j) - place(c);
        inertia += e.squaredNorm() * Matrix3d::Identity() - e * e.transpose();
      }
      const Vector3d turn = inertia.ldlt().solve(moment);
      if (turn.allFinite()) turns[c] = turn;
    }
  });
  std::vector<Vector3d> gathered = pulls;
  parallel_for(count, kCoarsePerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (const Index j : rings[c]) {
        const Vector3d e = place(j) - place(c);
        gathered[c] -= turns[c].cross(e) + turns[j].cross(e);
      }
    }
  });
  return gathered;
}

}  // namespace lapwing
