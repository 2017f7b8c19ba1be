#include <dlfcn.h>
#include <optional>
#include <stdexcept>

#include <cholmod.h>

#include "lapwing/solve/scalar_lower.h"
#include "studies/measure.h"
#include "studies/solver_rows.h"

namespace lapwing::bench {
namespace {

// OpenBLAS's own switch, where the BLAS is OpenBLAS.
void set_blas_threads(int threads) {
  using Setter = void (*)(int);
  static const auto set = reinterpret_cast<Setter>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set != nullptr) set(threads);
}

// One matrix in CHOLMOD, with every step callable by itself.
class Cholmod {
 public:
  Cholmod(const BlockMatrix& A, CholmodOrdering ordering, std::span<const int> block_order)
      : lower_(scalar_lower_pattern(*A.pattern, A.block_size)),
        order_(scalar_order(block_order, A.block_size)) {
    fill_scalar_lower(A, lower_);
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.postorder = 1;
    common_.method[0].ordering = ordering == CholmodOrdering::amd     ? CHOLMOD_AMD
                                 : ordering == CholmodOrdering::metis ? CHOLMOD_METIS
                                                                      : CHOLMOD_GIVEN;
    view_.nrow = view_.ncol = static_cast<std::size_t>(lower_.rows());
    view_.nzmax = static_cast<std::size_t>(lower_.nonZeros());
    view_.p = lower_.outerIndexPtr();
    view_.i = lower_.innerIndexPtr();
    view_.x = lower_.valuePtr();
    view_.stype = -1;
    view_.itype = CHOLMOD_INT;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = view_.packed = 1;
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  ~Cholmod() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_finish(&common_);
  }

  void analyze() {
    cholmod_free_factor(&factor_, &common_);
    const bool given = common_.method[0].ordering == CHOLMOD_GIVEN;
    factor_ = cholmod_analyze_p(&view_, given ? order_.data() : nullptr, nullptr, 0, &common_);
    check();
  }
  std::size_t factor_bytes() const { return factor_->xsize * sizeof(double); }
  void factor() {
    cholmod_factorize(&view_, factor_, &common_);
    check();
  }
  std::span<const double> solve(std::span<const double> b) {
    cholmod_dense rhs{};
    rhs.nrow = rhs.d = view_.nrow;
    rhs.ncol = b.size() / view_.nrow;
    rhs.nzmax = b.size();
    rhs.x = const_cast<double*>(b.data());  // only read
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &rhs, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   &common_);
    check();
    return {static_cast<const double*>(solution_->x), b.size()};
  }

 private:
  void check() const {
    if (common_.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD failed");
  }

  ScalarLower lower_;
  std::vector<int> order_;
  cholmod_common common_{};
  cholmod_sparse view_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

const char* name_of(CholmodOrdering ordering) {
  switch (ordering) {
    case CholmodOrdering::amd:
      return "CHOLMOD AMD";
    case CholmodOrdering::metis:
      return "CHOLMOD METIS";
    case CholmodOrdering::blocks:
      break;
  }
  return "CHOLMOD METIS on blocks";
}

}  // namespace

SolverRow time_cholmod(const BenchSystem& system, CholmodOrdering ordering, int repeats) {
  SolverRow row;
  row.name = name_of(ordering);
  std::vector<int> order;
  if (ordering == CholmodOrdering::blocks) {
    row.order = measure(std::min(repeats, 3), [&] {
                  order = fill_reducing_order(system.pattern, Ordering::nested_dissection);
                }).median();
  }
  std::optional<Cholmod> coupled;
  Samples analyze;
  std::array<Samples, 2> first_factor;
  for (int i = 0; i < repeats; ++i) {
    for (const int threads : {1, 2}) {
      set_blas_threads(threads);
      coupled.emplace(system.coupled, ordering, order);
      Stopwatch watch;
      coupled->analyze();
      analyze.milliseconds.push_back(watch.elapsed_ms());
      touch_memory(coupled->factor_bytes());
      watch.restart();
      coupled->factor();
      first_factor[static_cast<std::size_t>(threads - 1)].milliseconds.push_back(
          watch.elapsed_ms());
    }
  }
  row.analyze = analyze.median();
  row.first_factor = std::min(first_factor[0].median(), first_factor[1].median());
  const std::size_t n = system.coupled.scalar_size();
  const std::vector<double> b = right_hand_sides(12 * n);
  const auto b1 = std::span(b).first(n);
  Cholmod scalar(system.scalar, ordering, order);
  scalar.analyze();
  const auto best = [](double& best_so_far, const Samples& samples) {
    const double time = samples.median();
    best_so_far = best_so_far == 0 ? time : std::min(best_so_far, time);
  };
  for (const int threads : {1, 2}) {
    set_blas_threads(threads);
    best(row.factor, measure_cold(repeats, [&] { coupled->factor(); }));
    best(row.scalar_factor, measure(repeats, [&] { scalar.factor(); }));
    best(row.twelve_columns, measure(repeats, [&] { coupled->solve(b); }));
    best(row.one_column, measure(2 * repeats, [&] { coupled->solve(b1); }));
  }
  row.error = normwise_backward_error(system.coupled, coupled->solve(b1), b1);
  return row;
}

}  // namespace lapwing::bench
