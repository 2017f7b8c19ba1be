// AVX2 with FMA: 16 registers of 4 doubles or 8 floats.

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

namespace doubles {

using Real = double;
constexpr int kLanes = 4;
constexpr int kTileStrips = 1;
constexpr int kTileColumns = 4;
constexpr int kRegisters = 16;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable<Real> kTable = kernel_table(Rows<4>::kernels());

}  // namespace doubles

namespace floats {

using Real = float;
constexpr int kLanes = 8;
constexpr int kTileStrips = 3;
constexpr int kTileColumns = 4;
constexpr int kRegisters = 16;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable<Real> kTable = kernel_table(Rows<4>::kernels());

}  // namespace floats

}  // namespace

extern const KernelTables kAvx2Kernels;
const KernelTables kAvx2Kernels = {doubles::kTable, floats::kTable};

}  // namespace lapwing::cholesky
