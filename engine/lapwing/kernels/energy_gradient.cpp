#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

void CpuRingRotations::energy_gradient(std::span<double> g) {
  constexpr std::size_t kUnknownsPerTask = 256;
  const GradientRings rings{rings_.starts.data(),
                            rings_.neighbours.data(),
                            rings_.edges.empty() ? nullptr : rings_.edges.front().data(),
                            rings_.reverse_weights.data(),
                            rings_.stiffness.empty() ? nullptr : rings_.stiffness.data(),
                            rings_.row_count(),
                            rings_.unknown_rows.data(),
                            rings_.unknown_rows.size(),
                            displacement_.data(),
                            residuals_.data(),
                            turns_.data()};
  parallel_for(rings.unknown_count, kUnknownsPerTask, [&](std::size_t first, std::size_t last) {
    loops_.gradient(rings, first, last, g.data());
  });
}

}  // namespace lapwing
