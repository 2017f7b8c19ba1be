#include "run/bench_device.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "lapwing/base/parallel.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/shaders/copy.h"
#include "lapwing/shaders/matmul_float32.h"
#include "lapwing/shaders/matmul_float64.h"
#include "lapwing/vulkan/vulkan_kernels.h"

#ifdef LAPWING_HAVE_CHOLMOD
#include <cblas.h>
#endif

namespace lapwing::bench {
namespace {

// Each rate is the best of these runs, after one to warm up: a limit is what can be reached.
constexpr int kRuns = 9;

// Copies must not fit in the caches, which have tens of megabytes on a real GPU.
constexpr std::size_t kCopyBytes = std::size_t{64} << 20U;
constexpr std::size_t kCopyBytesOfGpu = std::size_t{1} << 30U;
constexpr std::size_t kBytesPerTask = std::size_t{1} << 16U;

// Matrix sizes: multiples of kTile, large enough to keep a processor core or a whole GPU busy.
constexpr std::uint32_t kProduct = 512;
constexpr std::uint32_t kProductOfGpu = 4096;
constexpr std::uint32_t kTile = 64;                 // of shaders/matmul.comp
constexpr std::uint32_t kInvocationsPerTile = 256;  // likewise

// Returns the least of the times that `work` returns.
template <typename Work>
double least_ms(Work work) {
  work();
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r < kRuns; ++r) least = std::min(least, work());
  return least;
}

template <typename Work>
double wall_ms(Work work) {
  const Stopwatch watch;
  work();
  return watch.elapsed_ms();
}

double gb_per_s(std::size_t copied, double ms) {
  return 2.0 * static_cast<double>(copied) / ms * 1e-6;
}

double gflops(double size, double ms) {
  return 2.0 * size * size * size / ms * 1e-6;
}

void copy_on_all_threads(std::span<const char> source, std::span<char> target) {
  parallel_for(source.size(), kBytesPerTask, [&](std::size_t begin, std::size_t end) {
    std::memcpy(target.data() + begin, source.data() + begin, end - begin);
  });
}

#ifdef LAPWING_HAVE_CHOLMOD
void multiply(const std::vector<float>& a, const std::vector<float>& b, std::vector<float>& c) {
  const auto n = static_cast<int>(kProduct);
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1.0F, a.data(), n, b.data(), n,
              0.0F, c.data(), n);
}

void multiply(const std::vector<double>& a, const std::vector<double>& b, std::vector<double>& c) {
  const auto n = static_cast<int>(kProduct);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1.0, a.data(), n, b.data(), n,
              0.0, c.data(), n);
}

template <typename Real>
double blas_gflops() {
  const std::vector<Real> a(std::size_t{kProduct} * kProduct, Real{1});
  const std::vector<Real> b = a;
  std::vector<Real> c = a;
  return gflops(kProduct, least_ms([&] { return wall_ms([&] { multiply(a, b, c); }); }));
}
#endif

void measure_processor(Limits& limits) {
  const std::vector<char> source(kCopyBytes, 1);
  std::vector<char> target(kCopyBytes, 2);
  limits.copy_gb_per_s = gb_per_s(
      kCopyBytes, least_ms([&] { return wall_ms([&] { copy_on_all_threads(source, target); }); }));
#ifdef LAPWING_HAVE_CHOLMOD
  limits.matmul_gflops_float32 = blas_gflops<float>();
  limits.matmul_gflops_float64 = blas_gflops<double>();
#endif
}

// Returns the time of what `record` records, by the device's clock if it has one.
template <typename Record>
double device_ms(gpu::Context& context, Record record) {
  gpu::CommandList list(context, "limit", 2);
  gpu::Recorder recorder(list);
  recorder.timestamp();
  record(recorder);
  recorder.timestamp();
  recorder.finish();
  return least_ms([&] {
    const double wall = wall_ms([&] { list.run(); });
    const double own = list.milliseconds_between(0, 1);
    return own > 0.0 ? own : wall;
  });
}

double copy_rate(gpu::Context& context, bool real_gpu) {
  const std::size_t bytes = std::min<std::size_t>(real_gpu ? kCopyBytesOfGpu : kCopyBytes,
                                                  context.limits().maxStorageBufferRange / 64 * 64);
  const gpu::Buffer source(context, "copied from", bytes);
  const gpu::Buffer target(context, "copied to", bytes);
  gpu::CommandList fill(context, "fill");
  gpu::Recorder filling(fill);
  filling.fill(source, 1);
  filling.finish();
  fill.run();
  constexpr std::size_t kTexel = 4 * sizeof(float);
  const auto texels = static_cast<std::uint32_t>(bytes / kTexel);
  const gpu::Kernel copy(context, "copy", shaders::copy(), sizeof texels);
  const double by_kernel = device_ms(context, [&](gpu::Recorder& recorder) {
    recorder.dispatch(copy, texels, {source, target}, texels);
  });
  const double by_command =
      device_ms(context, [&](gpu::Recorder& recorder) { recorder.copy(source, target); });
  return gb_per_s(bytes, std::min(by_kernel, by_command));
}

double product_rate(gpu::Context& context, bool real_gpu, std::span<const std::uint32_t> spirv,
                    std::size_t real_bytes) {
  const std::uint32_t size = real_gpu ? kProductOfGpu : kProduct;
  const std::size_t bytes = std::size_t{size} * size * real_bytes;
  const gpu::Buffer a(context, "a", bytes);
  const gpu::Buffer b(context, "b", bytes);
  const gpu::Buffer c(context, "c", bytes);
  gpu::CommandList fill(context, "fill");
  gpu::Recorder filling(fill);
  filling.fill(a, 0);
  filling.fill(b, 0);
  filling.finish();
  fill.run();
  const gpu::Kernel matmul(context, "matmul", spirv, sizeof size, kInvocationsPerTile);
  const std::uint64_t tiles = std::uint64_t{size / kTile} * (size / kTile);
  return gflops(size, device_ms(context, [&](gpu::Recorder& recorder) {
                  recorder.dispatch(matmul, tiles * kInvocationsPerTile, {a, b, c}, size);
                }));
}

}  // namespace

BenchDevice open_bench_device(const std::string& name, bool map_device_memory) {
  BenchDevice device;
  if (name == "cpu") {
    device.kernels = std::make_unique<CpuKernels>();
  } else {
    gpu::ContextOptions options;
    options.device = name;
    options.profile = true;
    options.map_device_memory = map_device_memory;
    device.context = std::make_shared<gpu::Context>(options);
    device.kernels = std::make_unique<VulkanKernels>(device.context, Precision::automatic);
  }
  device.name = device.kernels->device().name;
  return device;
}

Limits measure_limits(const BenchDevice& device) {
  const DeviceInfo& info = device.kernels->device();
  Limits limits;
  limits.device = device.name;
  limits.type = info.type;
  limits.driver = info.driver;
  if (device.context == nullptr) {
    measure_processor(limits);
    return limits;
  }
  gpu::Context& context = *device.context;
  const bool real_gpu = info.type.ends_with("GPU");
  limits.copy_gb_per_s = copy_rate(context, real_gpu);
  limits.matmul_gflops_float32 =
      product_rate(context, real_gpu, shaders::matmul_float32(), sizeof(float));
  if (info.float64) {
    limits.matmul_gflops_float64 =
        product_rate(context, real_gpu, shaders::matmul_float64(), sizeof(double));
  }
  return limits;
}

}  // namespace lapwing::bench
