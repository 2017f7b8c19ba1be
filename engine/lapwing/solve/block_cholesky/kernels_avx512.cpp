// AVX-512: 32 registers of 8 doubles. A register of floats contains a column of one strip (8
// floats) or of two strips (16 floats).

#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {
namespace {

namespace doubles {

using Real = double;
constexpr int kLanes = 8;
constexpr int kTileStrips = 3;
constexpr int kTileColumns = 8;
constexpr int kRegisters = 32;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"
#include "lapwing/solve/block_cholesky/solve_kernels_four.inl"

constexpr KernelTable<Real> kTable = kernel_table(FourColumns::kernels());

}  // namespace doubles

namespace floats {

using Real = float;
constexpr int kLanes = 8;
constexpr int kTileStrips = 3;
constexpr int kTileColumns = 8;
constexpr int kRegisters = 32;

#include "lapwing/solve/block_cholesky/factor_kernels.inl"
#include "lapwing/solve/block_cholesky/factor_kernels_pairs.inl"
#include "lapwing/solve/block_cholesky/solve_kernels.inl"

constexpr KernelTable<Real> kTable = StripPairs::table(kernel_table(Rows<4>::kernels()));

}  // namespace floats

}  // namespace

extern const KernelTables kAvx512Kernels;
const KernelTables kAvx512Kernels = {doubles::kTable, floats::kTable};

}  // namespace lapwing::cholesky
