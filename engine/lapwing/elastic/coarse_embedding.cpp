#include "lapwing/elastic/coarse_embedding.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "lapwing/base/parallel.h"

namespace lapwing {

extern const EmbeddingLoops kEmbeddingLoopsBaseline;
#ifdef __x86_64__
extern const EmbeddingLoops kEmbeddingLoopsAvx2;
extern const EmbeddingLoops kEmbeddingLoopsAvx512;
#endif

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMotionsPerTask = 256;
constexpr std::size_t kCarriedPerTask = 1024;
constexpr std::size_t kBoundPerTask = 128;

// Returns `v`, its ring, and the rings of its neighbours.
std::vector<Index> two_rings_around(Index v, const Adjacency& rings) {
  std::vector<Index> around{v};
  const auto ring = rings[v];
  around.insert(around.end(), ring.begin(), ring.end());
  const std::size_t first = around.size();
  for (const Index j : ring) {
    for (const Index k : rings[j]) {
      if (k != v && !std::binary_search(ring.begin(), ring.end(), k)) around.push_back(k);
    }
  }
  const auto second = around.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(second, around.end());
  around.erase(std::unique(second, around.end()), around.end());
  return around;
}

}  // namespace

const EmbeddingLoops& embedding_loops([[maybe_unused]] InstructionSet set) {
#ifdef __x86_64__
  if (set == InstructionSet::avx512) return kEmbeddingLoopsAvx512;
  if (set == InstructionSet::avx2) return kEmbeddingLoopsAvx2;
#endif
  return kEmbeddingLoopsBaseline;
}

CoarseEmbedding::CoarseEmbedding(std::shared_ptr<const Positions> rest, const VertexSet& roi,
                                 const CoarseSurface& coarse)
    : rest_(std::move(rest)),
      coarse_(coarse),
      loops_(embedding_loops(available_instruction_sets().front())) {
  for (const Index v : roi) {
    if (coarse.owners[v] != kNoIndex) vertices_.push_back(v);
  }
  embedded_.resize(vertices_.size());
  origin_ = vertices_.empty() ? Vector3d::Zero() : (*rest_)[vertices_.front()];
  std::vector<Index> owners;
  for (const Index v : vertices_) owners.push_back(coarse.owners[v]);
  const Adjacency owned = inverse_lists(owners, coarse.kept.size());
  parallel_for(coarse.kept.size(), kBoundPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) bind(static_cast<Index>(c), owned[c]);
  });

  // With the list of nodes bound to each coarse vertex, threads gather forces without write
  // conflicts.
  std::vector<Index> nodes;
  nodes.reserve(kEmbeddingNodes * embedded_.size());
  for (const EmbeddedVertex& embedded : embedded_) {
    for (std::size_t node = 0; node < kEmbeddingNodes; ++node) {
      nodes.push_back(embedded.weights[node] > 0.0 ? embedded.nodes[node] : kNoIndex);
    }
  }
  bound_to_ = inverse_lists(nodes, coarse.kept.size());
}

// Binds the vertices `owned` to the nearest coarse vertices in the two rings around `owner`, with
// weights (1 - d / D)^2 of the distance d. D is the distance of the nearest unused coarse vertex,
// so a weight is 0 where the set of nearest vertices changes.
void CoarseEmbedding::bind(Index owner, std::span<const Index> owned) {
  if (owned.empty()) return;
  // Sorted approximately by distance, so that most later vertices are rejected at once.
  const std::vector<Index> near = two_rings_around(owner, coarse_.topology.rings);
  std::vector<Vector3d> places;
  for (const Index c : near) places.push_back(coarse_.rest[c]);
  std::vector<double> squares(near.size());
  // The nearest vertices, and the nearest unused vertex.
  struct Candidate {
    double square;
    Index node;
  };
  std::array<Candidate, kEmbeddingNodes + 1> nearest;
  const std::size_t count = std::min(kEmbeddingNodes, near.size() - 1);
  for (const Index k : owned) {
    const Vector3d& here = (*rest_)[vertices_[k]];
    for (std::size_t j = 0; j < near.size(); ++j) squares[j] = (here - places[j]).squaredNorm();
    std::size_t listed = 0;
    for (std::size_t j = 0; j < near.size(); ++j) {
      if (listed > count && !(squares[j] < nearest[count].square)) continue;
      std::size_t at = listed > count ? count : listed++;
      for (; at > 0 && squares[j] < nearest[at - 1].square; --at) nearest[at] = nearest[at - 1];
      nearest[at] = {squares[j], near[j]};
    }
    EmbeddedVertex& embedded = embedded_[k];
    double sum = 0.0;
    for (std::size_t node = 0; node < count; ++node) {
      const double share = 1.0 - std::sqrt(nearest[node].square / nearest[count].square);
      embedded.nodes[node] = nearest[node].node;
      embedded.weights[node] = share > 0.0 ? share * share : 0.0;
      sum += embedded.weights[node];
    }
    if (!(sum > 0.0)) {
      embedded = {};
      embedded.nodes[0] = nearest[0].node;
      embedded.weights[0] = sum = 1.0;
    }
    for (double& weight : embedded.weights) weight /= sum;
  }
}

std::vector<RowsOfMotion> CoarseEmbedding::motions(const Pose& from, const Pose& to) const {
  std::vector<RowsOfMotion> motions(coarse_.kept.size());
  parallel_for(motions.size(), kMotionsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Vector3d at = coarse_.rest[c] - origin_ + from.displacement[c];
      const Matrix3d turn = to.transforms[c] * from.transforms[c].inverse() - Matrix3d::Identity();
      Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(motions[c].row[0]) << turn,
          to.displacement[c] - from.displacement[c] - turn * at;
    }
  });
  return motions;
}

void CoarseEmbedding::prolongate(std::span<const RowsOfMotion> motions,
                                 std::span<Vector3d> u) const {
  const CarriedVertices carried{vertices_.data(),
                                embedded_.data(),
                                motions.data(),
                                rest_->front().data(),
                                {origin_.x(), origin_.y(), origin_.z()}};
  parallel_for(vertices_.size(), kCarriedPerTask, [&](std::size_t begin, std::size_t end) {
    loops_.carry(carried, begin, end, u.front().data());
  });
}

std::vector<Vector3d> CoarseEmbedding::restrict_forces(std::span<const Vector3d> forces,
                                                       std::span<const Vector3d> u,
                                                       const Pose& pose) const {
  const Adjacency& rings = coarse_.topology.rings;
  const Positions& fine_rest = *rest_;
  const Positions& rest = coarse_.rest;
  const std::size_t count = coarse_.kept.size();
  const auto place = [&](std::size_t c) -> Vector3d { return rest[c] + pose.displacement[c]; };
  // A moment at a coarse vertex is replaced by forces w x e_k on its ring, where w is chosen such
  // that sum_k e_k x (w x e_k) equals the moment.
  std::vector<Vector3d> pulls(count, Vector3d::Zero());
  std::vector<Vector3d> turns(count, Vector3d::Zero());
  constexpr std::size_t kCoarsePerTask = 64;
  parallel_for(count, kCoarsePerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      Vector3d moment = Vector3d::Zero();
      for (const Index entry : bound_to_[c]) {
        const std::size_t k = entry / kEmbeddingNodes;
        const Index v = vertices_[k];
        const Vector3d force = embedded_[k].weights[entry % kEmbeddingNodes] * forces[v];
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
