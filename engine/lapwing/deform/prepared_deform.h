#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/progress.h"
#include "lapwing/deform/deform.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// How the surface of an edit follows some of its handles to first order. With L the linear part of
/// a handle's motion less the identity, and s the way of its centre (L c + t for a motion x ->
/// (I + L) x + t), a vertex is at
///     rest[v] + sum over handles h and axes a of
///               sum_b L_h(a, b) columns[h](a, b)[v] + s_h(a) columns[h](a, 3)[v].
struct SurfaceResponse {
  /// About which the linear part of each handle's motion counts: the centroid of its vertices.
  std::vector<Eigen::Vector3d> centers;
  std::size_t vertex_count = 0;  ///< of the whole mesh
  /// For each handle its 12 columns, (0, 0), (0, 1), ... (2, 3), each of vertex_count
  /// displacements; those of (a, 3) are per length, the others lengths.
  std::vector<Eigen::Vector3d> columns;
  /// Why details do not turn (DragResponse::why_not_exact); empty if they do.
  std::string why_not_exact;

  std::span<const Eigen::Vector3d> column(std::size_t handle, std::size_t a, std::size_t b) const {
    return std::span(columns).subspan((12 * handle + 4 * a + b) * vertex_count, vertex_count);
  }
};

/// A request that is prepared once and carried out for many motions of its handles: data sets,
/// fits, anything that asks for thousands of results of one edit. The processor computes it.
///
///     PreparedDeform arm(mesh, request);
///     const Deformed raised = arm.solve(moves);
///
/// One object serves one thread at a time; `solve_many` goes on all.
class PreparedDeform {
 public:
  /// Prepares, which takes what `deform` takes but for settling; the moves and paths in `request`
  /// do not count. Throws what `deform` throws, so that nothing but moves can be wrong afterwards.
  PreparedDeform(Mesh mesh, DeformRequest request, const Progress& progress = {});

  const Mesh& mesh() const { return mesh_; }  ///< at rest
  const DeformRequest& request() const { return request_; }
  const EditRegion& region() const { return region_; }

  /// What `deform` makes of the request with these moves, one per handle, bit for bit. Throws what
  /// that throws, and InputError for another number of moves.
  Deformed solve(std::span<const Move> moves, const Progress& progress = {});
  /// The same with other orientations than the request's, one per handle.
  Deformed solve(std::span<const Move> moves, std::span<const HandleOrientation> orientations,
                 const Progress& progress = {});

  /// How the surface follows each of `handles`, numbers in the request, with the others at rest: 12
  /// right-hand sides a handle and no solve of the whole, so that frames can be added up from it.
  /// What `solve` makes without settling is that to 1e-6 of the mesh's diagonal, but for loose
  /// parts, which solve turns and this moves to first order. The images of mirrored handles go
  /// along; what targets ask for is not in it. If the exact system does not fit (why_not_exact) it
  /// is a DragPreview's, in which details do not turn. Memory is 288 bytes a vertex and handle, and
  /// as much again is kept. Stages "response", and those of preparing where a solve has left
  /// another pose behind. Throws InputError for a handle that the request does not have,
  /// SolverError where memory is short, Cancelled.
  SurfaceResponse response(std::span<const std::size_t> handles, const Progress& progress = {});

  /// The moves of result `k`, and what is done with it. Both are called by any of the threads; each
  /// k comes once, in no order.
  using MovesOf = std::function<std::vector<Move>(std::size_t k)>;
  using Take = std::function<void(std::size_t k, Deformed&& result)>;

  /// `count` results, each as `solve` makes it, on `threads` threads (0: all that the process may
  /// run on), each of which prepares for itself: memory is that of so many. The first error ends it
  /// and is thrown here, its message begun with "motion K: ". `progress` hears stage "solve_many",
  /// on the calling thread alone, and cancels all.
  void solve_many(std::size_t count, const MovesOf& moves_of, const Take& take,
                  unsigned threads = 0, const Progress& progress = {});

 private:
  Deformed solved(const DeformRequest& request, const Progress& progress);

  Mesh mesh_;
  DeformRequest request_;
  CpuKernels kernels_;
  DeformWorkspace workspace_;
  EditRegion region_;
  bool is_at_rest_ = false;  ///< the workspace's solver is that of the rest pose
};

}  // namespace lapwing
