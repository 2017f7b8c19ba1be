#pragma once

#include <memory>
#include <string>

#include "lapwing/kernels/kernels.h"
#include "report/report.h"

namespace lapwing::gpu {
class Context;
}

namespace lapwing::bench {

/// A device to measure on: the CPU twins, or Vulkan with its command lists profiled.
struct BenchDevice {
  std::string name;
  std::shared_ptr<gpu::Context> context;  ///< null for the CPU twins
  std::unique_ptr<Kernels> kernels;
};

/// `name` as for `open_device`; `map_device_memory` as in gpu::ContextOptions. Throws GpuError.
BenchDevice open_bench_device(const std::string& name, bool map_device_memory = true);

/// Measures the peak rates of the device: copies between large buffers, by its copy command or a
/// kernel (shaders/copy.comp), whichever is faster, and products of large matrices
/// (shaders/matmul.comp). On the processor all threads copy, and the products use CHOLMOD's BLAS;
/// without it their rates are 0. Takes about a second.
Limits measure_limits(const BenchDevice& device);

}  // namespace lapwing::bench
