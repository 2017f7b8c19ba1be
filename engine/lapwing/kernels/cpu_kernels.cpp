#include "lapwing/kernels/cpu_kernels.h"

#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

CpuKernels::CpuKernels() {
  device_.name = "CPU";
  device_.type = "cpu";
}

std::unique_ptr<RingRotations> CpuKernels::make_ring_rotations(
    std::shared_ptr<const RegionRings> rings) {
  return std::make_unique<CpuRingRotations>(std::move(rings));
}

}  // namespace lapwing
