// What the compiler's default target offers: SSE2 on x86-64, NEON on 64-bit ARM.

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

constexpr int kLanes = 2;
constexpr int kTileStrips = 1;
#ifdef __aarch64__
constexpr int kTileColumns = 4;
constexpr int kRegisters = 32;
#else
constexpr int kTileColumns = 2;
constexpr int kRegisters = 16;
#endif

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable kTable = kernel_table(Rows<4>::kernels());

}  // namespace

extern const KernelTable kBaselineKernels;
const KernelTable kBaselineKernels = kTable;

}  // namespace lapwing::cholesky
