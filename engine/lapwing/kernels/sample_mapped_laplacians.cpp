#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

Vector3d laplacian_of_mapped_ring(const MappedRings& rings, std::size_t row,
                                  std::span<const Vector3d> f) {
  const SurfacePoint& here = rings.points[row];
  const Vector3d& anchor = f[here.corners[0]];
  const Vector3d own = offset_from(anchor, here, f);
  Vector3d delta = Vector3d::Zero();
  for (std::size_t e = rings.target.starts[row]; e < rings.target.starts[row + 1]; ++e) {
    const SurfacePoint& there = rings.points[rings.target.neighbours[e]];
    const Vector3d difference =
        there.is_nowhere() ? Vector3d(anchor + own) : Vector3d(own - offset_from(anchor, there, f));
    delta += rings.target.weights[e] * difference;
  }
  return delta;
}

}  // namespace

void CpuKernels::sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                          std::span<const Vector3d> source,
                                          std::span<Vector3d> laplacians) {
  constexpr std::size_t kRowsPerTask = 2048;
  parallel_for(rings.target.row_count(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      if (rings.points[r].is_nowhere()) {
        laplacians[r].setZero();
      } else if (sampling == MappedSampling::linear) {
        laplacians[r] = rings.points[r].of(source);
      } else {
        laplacians[r] = laplacian_of_mapped_ring(rings, r, source);
      }
    }
  });
}

}  // namespace lapwing
