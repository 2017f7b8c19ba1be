#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/deform/deform.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// A request that is prepared once and carried out for many motions of its handles: data sets,
/// fits, anything that asks for thousands of results of one edit. The processor computes it.
///
///     PreparedDeform arm(mesh, request);
///     const Deformed raised = arm.solve(moves);
///
/// One object serves one thread at a time; `solve_many` goes on all.
class PreparedDeform {
 public:
  /// Prepares, which takes what `deform` takes but for settling; the moves in `request` do not
  /// count. Throws what `deform` throws, so that nothing but moves can be wrong afterwards.
  PreparedDeform(Mesh mesh, DeformRequest request, const Progress& progress = {});

  const Mesh& mesh() const { return mesh_; }  ///< at rest
  const DeformRequest& request() const { return request_; }
  const EditRegion& region() const { return region_; }

  /// What `deform` makes of the request with these moves, one per handle, bit for bit. Throws what
  /// that throws, and InputError for another number of moves.
  Deformed solve(std::span<const Move> moves, const Progress& progress = {});

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
  Mesh mesh_;
  DeformRequest request_;
  CpuKernels kernels_;
  DeformWorkspace workspace_;
  EditRegion region_;
};

}  // namespace lapwing
