#include "lapwing/solve/block_cholesky/block_cholesky.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "lapwing/base/limits.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/solve/block_cholesky/kernels.h"
#include "lapwing/solve/block_cholesky/numeric.h"
#include "lapwing/solve/block_cholesky/triangular_solve.h"

namespace lapwing {

using namespace cholesky;

struct BlockCholesky::Analysis final : SolverAnalysis {
  Symbolic symbolic;
  const BlockPattern* pattern = nullptr;
};

// The numeric factorization and the solves, independent of the number type.
class BlockCholesky::Factorization {
 public:
  virtual ~Factorization() = default;
  virtual void touch() = 0;
  virtual Refusal factorize(const BlockMatrix& matrix, const Progress& progress,
                            const std::vector<char>& kept) = 0;
  virtual void solve(std::span<const double> B, std::span<double> X, std::size_t columns,
                     std::span<const Index> places) = 0;
};

namespace {

void check_order(std::span<const int> order, std::size_t blocks) {
  std::vector<char> seen(blocks, 0);
  bool good = order.size() == blocks;
  for (std::size_t i = 0; good && i < blocks; ++i) {
    const int block = order[i];
    good = block >= 0 && static_cast<std::size_t>(block) < blocks && !std::exchange(seen[block], 1);
  }
  if (!good) {
    throw SolverError("the order is not a permutation of the " + std::to_string(blocks) +
                      " blocks; take it from fill_reducing_order for the same pattern");
  }
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

std::size_t table_bytes(const Symbolic& symbolic) {
  return bytes_of(symbolic.order) + bytes_of(symbolic.front_of_block) + bytes_of(symbolic.fronts) +
         bytes_of(symbolic.children) + bytes_of(symbolic.rows) + bytes_of(symbolic.positions) +
         bytes_of(symbolic.pieces) + bytes_of(symbolic.entries);
}

// Returns the blocks of the connected component that contains `front`: the pivots of all fronts of
// its tree.
std::vector<int> component_of(const Symbolic& symbolic, int front) {
  std::vector<int> root(symbolic.fronts.size());
  for (int f = symbolic.front_count() - 1; f >= 0; --f) {
    const int parent = symbolic.fronts[f].parent;
    root[f] = parent < 0 ? f : root[parent];
  }
  std::vector<int> blocks;
  for (int f = 0; f < symbolic.front_count(); ++f) {
    if (root[f] != root[front]) continue;
    const auto first = symbolic.order.begin() + symbolic.fronts[f].first_block;
    blocks.insert(blocks.end(), first, first + symbolic.fronts[f].pivot_blocks);
  }
  return blocks;
}

template <typename Real>
const KernelTable<Real>& kernels_in(const KernelTables& tables) {
  if constexpr (std::is_same_v<Real, float>) {
    return tables.floats;
  } else {
    return tables.doubles;
  }
}

template <typename Real>
void add_sizes(const Symbolic& symbolic, int threads, SolverStatistics& statistics) {
  statistics.factor_bytes = arena_bytes<Real>(symbolic.factor_size);
  statistics.peak_bytes = table_bytes(symbolic) + Numeric<Real>::bytes_needed(symbolic, threads) +
                          TriangularSolve<Real>::bytes_needed(symbolic, threads);
}

NotPositiveDefinite refused_pivot(const Symbolic& symbolic, const Refusal& refusal) {
  const Front& front = symbolic.fronts[refusal.front];
  const int block =
      symbolic.order[front.first_block + static_cast<int>(refusal.where) / symbolic.block_size];
  const std::vector<int> component = component_of(symbolic, refusal.front);
  return {"the matrix is singular or not positive definite at block " + std::to_string(block) +
              ", in the component of " + std::to_string(component.size()) +
              " blocks whose smallest is block " +
              std::to_string(*std::min_element(component.begin(), component.end())) +
              "; constrain a vertex of that component (a handle or belt)",
          static_cast<Index>(block)};
}

SolverError not_finite(const BlockPattern& pattern, std::size_t entry) {
  const auto after = std::upper_bound(pattern.starts.begin(), pattern.starts.end(), entry);
  const auto column = after - pattern.starts.begin() - 1;
  return SolverError("the matrix has a non-finite entry at block row " +
                     std::to_string(pattern.rows[entry]) + ", block column " +
                     std::to_string(column) +
                     "; check the positions and weights of those vertices");
}

}  // namespace

template <typename Real>
class BlockCholesky::FactorizationIn final : public Factorization {
 public:
  FactorizationIn(const Symbolic& symbolic, const KernelTables& tables, WorkerPool& pool)
      : numeric_(symbolic, kernels_in<Real>(tables), pool),
        solve_(symbolic, numeric_, kernels_in<Real>(tables), pool) {}

  void touch() override { numeric_.touch(); }
  Refusal factorize(const BlockMatrix& matrix, const Progress& progress,
                    const std::vector<char>& kept) override {
    return numeric_.factorize(matrix, progress, kept);
  }
  void solve(std::span<const double> B, std::span<double> X, std::size_t columns,
             std::span<const Index> places) override {
    solve_.solve(B, X, columns, places);
  }

 private:
  Numeric<Real> numeric_;
  TriangularSolve<Real> solve_;
};

BlockCholesky::BlockCholesky(const BlockCholeskyOptions& options)
    : options_(options),
      kernels_(kernels_for(options.instruction_set)),
      own_pool_(options.threads > 0 ? std::make_unique<WorkerPool>(options.threads) : nullptr),
      pool_(own_pool_ ? *own_pool_ : shared_workers()) {}

BlockCholesky::~BlockCholesky() = default;

// Calls `step`. Replaces std::bad_alloc by a SolverError that states the required memory.
template <typename Step>
void BlockCholesky::guard(Step step) {
  try {
    step();
  } catch (const std::bad_alloc&) {
    if (!factored_) factorization_.reset();
    throw SolverError(analysis_ != nullptr
                          ? "out of memory: the factorization needs " +
                                in_megabytes(statistics_.peak_bytes) + "; choose a smaller region"
                          : "out of memory in the symbolic factorization; choose a smaller region");
  }
}

void BlockCholesky::analyze(const BlockPattern& pattern, int block_size,
                            std::span<const int> order) {
  guard([&] {
    forget();
    check_order(order, pattern.size());
    if (block_size != 1 && block_size != 3) {
      throw SolverError("blocks of size " + std::to_string(block_size) +
                        " are not supported; use 1 or 3");
    }
    auto found = std::make_shared<Analysis>();
    found->symbolic = analyze_pattern(pattern, block_size, order);
    found->pattern = &pattern;
    use(std::move(found));
  });
}

std::shared_ptr<const SolverAnalysis> BlockCholesky::analysis() const {
  return analysis_;
}

void BlockCholesky::analyze_as(std::shared_ptr<const SolverAnalysis> analysis) {
  guard([&] {
    forget();
    use(std::dynamic_pointer_cast<const Analysis>(std::move(analysis)));
  });
}

void BlockCholesky::use(std::shared_ptr<const Analysis> analysis) {
  analysis_ = std::move(analysis);
  require_analysis();
  const Symbolic& symbolic = analysis_->symbolic;
  statistics_.flops = symbolic.flops;
  if (options_.precision == FactorPrecision::float32) {
    add_sizes<float>(symbolic, pool_.size(), statistics_);
  } else {
    add_sizes<double>(symbolic, pool_.size(), statistics_);
  }
  if (options_.memory_limit_bytes > 0 && statistics_.peak_bytes > options_.memory_limit_bytes) {
    const int blocks = symbolic.blocks;
    analysis_.reset();
    throw SolverError("the factorization of " + std::to_string(blocks) + " blocks needs " +
                      in_megabytes(statistics_.peak_bytes) + ", more than the limit of " +
                      in_megabytes(options_.memory_limit_bytes) +
                      "; choose a smaller region or raise the limit");
  }
}

void BlockCholesky::prepare_memory() {
  guard([&] {
    require_analysis();
    take_memory();
    factorization_->touch();
  });
}

void BlockCholesky::factorize(const BlockMatrix& matrix) {
  factorize(matrix, {});
}

// Recomputes all nodes except those marked in `kept`. If `kept` is empty, recomputes all nodes.
void BlockCholesky::factorize(const BlockMatrix& matrix, const std::vector<char>& kept) {
  guard([&] {
    check(matrix);
    factored_ = false;
    take_memory();
    const Refusal refusal = factorization_->factorize(matrix, progress_, kept);
    if (refusal.reason == Refusal::Reason::pivot) throw refused_pivot(analysis_->symbolic, refusal);
    if (refusal.reason == Refusal::Reason::not_finite) {
      throw not_finite(*analysis_->pattern, refusal.where);
    }
    factored_ = true;
  });
}

void BlockCholesky::refactorize_diagonal(const BlockMatrix& matrix,
                                         std::span<const Index> changed) {
  std::vector<char> kept;
  if (factored_) {
    const Symbolic& symbolic = analysis_->symbolic;
    const WorkGraph& graph = symbolic.upward;
    guard([&] { kept.assign(graph.size(), 1); });
    for (const Index block : changed) {
      if (block >= symbolic.front_of_block.size()) {
        throw SolverError("block " + std::to_string(block) +
                          " cannot be refactorized: it does not exist");
      }
      kept[symbolic.node_of_front(symbolic.front_of_block[block])] = 0;
    }
    // Children are numbered before their parents.
    for (int node = 0; node < graph.size(); ++node) {
      if (kept[node]) continue;
      for (int s = graph.successor_starts[node]; s < graph.successor_starts[node + 1]; ++s) {
        kept[graph.successors[s]] = 0;
      }
    }
  }
  factorize(matrix, kept);
}

void BlockCholesky::solve(std::span<const double> B, std::span<double> X, std::size_t columns) {
  solve(B, X, columns, {});
}

void BlockCholesky::solve_in_places(std::span<double> X, std::size_t columns,
                                    std::span<const Index> places) {
  solve(X, X, columns, places);
}

void BlockCholesky::solve(std::span<const double> B, std::span<double> X, std::size_t columns,
                          std::span<const Index> places) {
  guard([&] {
    if (!factored_) throw SolverError("the matrix is not factorized; call factorize first");
    const std::scoped_lock lock(solving_);  // all solves use the same scratch memory
    factorization_->solve(B, X, columns, places);
  });
}

void BlockCholesky::forget() {
  factored_ = false;
  factorization_.reset();
  analysis_.reset();
  statistics_ = {};
}

void BlockCholesky::take_memory() {
  if (factorization_) return;
  require_memory_for_factor();
  const Symbolic& symbolic = analysis_->symbolic;
  if (options_.precision == FactorPrecision::float32) {
    factorization_ = std::make_unique<FactorizationIn<float>>(symbolic, kernels_, pool_);
  } else {
    factorization_ = std::make_unique<FactorizationIn<double>>(symbolic, kernels_, pool_);
  }
}

// Throws if the factor does not fit into memory. Does not check systems in 3 x 3 blocks: their
// callers check the memory themselves and can use the n x n system instead.
void BlockCholesky::require_memory_for_factor() const {
  constexpr std::size_t kWorthAsking = 64'000'000;  // smaller amounts are not checked
  const Symbolic& symbolic = analysis_->symbolic;
  const std::size_t bytes = statistics_.peak_bytes - table_bytes(symbolic);
  if (symbolic.block_size == 3 || bytes < kWorthAsking) return;
  require_memory(bytes, "the factorization of " + std::to_string(symbolic.blocks) + " blocks",
                 "choose a smaller region");
}

void BlockCholesky::require_analysis() const {
  if (!analysis_) throw SolverError("the pattern is not analyzed; call analyze first");
}

void BlockCholesky::check(const BlockMatrix& matrix) const {
  require_analysis();
  const Symbolic& symbolic = analysis_->symbolic;
  const auto b = static_cast<std::size_t>(symbolic.block_size);
  if (matrix.block_size != symbolic.block_size ||
      matrix.values.size() != symbolic.entries.size() * b * b) {
    throw SolverError("the matrix does not have the analyzed pattern; call analyze again");
  }
}

std::unique_ptr<BlockSolver> make_solver(FactorPrecision precision) {
  BlockCholeskyOptions options;
  options.precision = precision;
  return std::make_unique<BlockCholesky>(options);
}

}  // namespace lapwing
