// The compiler's default target: SSE2 on x86-64, NEON on 64-bit ARM.

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

#ifdef __aarch64__
constexpr int kColumns = 4;
constexpr int kRegisters = 32;
#else
constexpr int kColumns = 2;
constexpr int kRegisters = 16;
#endif

namespace doubles {

using Real = double;
constexpr int kLanes = 2;
constexpr int kTileStrips = 1;
constexpr int kTileColumns = kColumns;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable<Real> kTable = kernel_table(Rows<4>::kernels());

}  // namespace doubles

namespace floats {

using Real = float;
constexpr int kLanes = 4;
constexpr int kTileStrips = 1;
constexpr int kTileColumns = kColumns;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable<Real> kTable = kernel_table(Rows<4>::kernels());

}  // namespace floats

}  // namespace

extern const KernelTables kBaselineKernels;
const KernelTables kBaselineKernels = {doubles::kTable, floats::kTable};

}  // namespace lapwing::cholesky
