// AVX2 with FMA: 16 registers of 4 numbers.

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

constexpr int kLanes = 4;
constexpr int kTileStrips = 1;
constexpr int kTileColumns = 4;
constexpr int kRegisters = 16;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable kTable = kernel_table(Rows<4>::kernels());

}  // namespace

extern const KernelTable kAvx2Kernels;
const KernelTable kAvx2Kernels = kTable;

}  // namespace lapwing::cholesky
