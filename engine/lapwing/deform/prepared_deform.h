#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/deform.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// The response of a surface to some of its handles, to first order. Let L be the linear part of a
/// handle's motion minus the identity, and let s be the displacement of the handle's centre. The
/// position of vertex v is
///     rest[v] + sum over handles h and axes a of
///               sum_b L_h(a, b) columns[h](a, b)[v] + s_h(a) columns[h](a, 3)[v].
struct SurfaceResponse {
  /// The centre of each handle, which is the centroid of its vertices.
  std::vector<Eigen::Vector3d> centers;
  std::size_t vertex_count = 0;  ///< of the whole mesh
  /// For each handle, 12 columns (0, 0), (0, 1), ... (2, 3) of vertex_count displacements each.
  /// Columns (a, 3) are dimensionless; all others are lengths.
  std::vector<Eigen::Vector3d> columns;
  /// The reason why details do not rotate (DragResponse::why_not_exact); empty if they rotate.
  std::string why_not_exact;

  std::span<const Eigen::Vector3d> column(std::size_t handle, std::size_t a, std::size_t b) const {
    return std::span(columns).subspan((12 * handle + 4 * a + b) * vertex_count, vertex_count);
  }
};

/// Prepares a request once and carries it out on the CPU for many motions of its handles, for
/// example to create data sets or fit parameters. An object must not be used by two threads at
/// once.
///
///     PreparedDeform arm(mesh, request);
///     const Deformed raised = arm.solve(moves);
class PreparedDeform {
 public:
  /// Ignores the moves and paths in `request`. Throws the errors of `deform`. After construction,
  /// only the moves can be invalid.
  PreparedDeform(Mesh mesh, DeformRequest request, const Progress& progress = {});

  const Mesh& mesh() const { return mesh_; }  ///< the mesh at rest
  const DeformRequest& request() const { return request_; }
  const EditRegion& region() const { return region_; }

  /// Deforms the mesh by `moves`, one per handle. The result is bitwise identical to that of
  /// `deform`.
  Deformed solve(std::span<const Move> moves, const Progress& progress = {});
  /// Like `solve` above, with one entry of `orientations` per handle instead of the orientations in
  /// the request.
  Deformed solve(std::span<const Move> moves, std::span<const HandleOrientation> orientations,
                 const Progress& progress = {});

  /// Returns the linear response to each handle whose index is in `handles`. All other handles stay
  /// at rest. The sum in SurfaceResponse matches `solve` without settling to within 1e-6 of the
  /// mesh's diagonal, except at loose parts. Mirror images of the handles also move, and targets
  /// have no effect. The response takes 288 bytes per vertex and handle; its computation takes up
  /// to three times as much memory. Throws InputError for a handle that does not exist, SolverError
  /// if the memory does not suffice, and Cancelled.
  SurfaceResponse response(std::span<const std::size_t> handles, const Progress& progress = {});

  /// `solve_many` calls both functions once for each k, on any of its threads and in any order.
  using MovesOf = std::function<std::vector<Move>(std::size_t k)>;
  using Take = std::function<void(std::size_t k, Deformed&& result)>;

  /// Calls `solve` for `count` motions on `threads` threads (0: one per CPU core). Each thread has
  /// its own solver. The first error stops all threads. This function then throws that error, with
  /// "motion K: " before its message. Reports the stage "solve_many" on the calling thread;
  /// `progress` can cancel all threads.
  void solve_many(std::size_t count, const MovesOf& moves_of, const Take& take,
                  unsigned threads = 0, const Progress& progress = {});

 private:
  Deformed solved(const DeformRequest& request, const Progress& progress);

  Mesh mesh_;
  DeformRequest request_;
  CpuKernels kernels_;
  DeformWorkspace workspace_;
  EditRegion region_;
  bool is_at_rest_ = false;  ///< true if the workspace's solver is at the rest pose
};

}  // namespace lapwing
