// AVX-512: 32 registers of 8 numbers.

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

constexpr int kLanes = 8;
constexpr int kTileStrips = 3;
constexpr int kTileColumns = 8;
constexpr int kRegisters = 32;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels_four.inl"

constexpr KernelTable kTable = kernel_table(FourColumns::kernels());

}  // namespace

extern const KernelTable kAvx512Kernels;
const KernelTable kAvx512Kernels = kTable;

}  // namespace lapwing::cholesky
