#include <atomic>
#include <cstdio>
#include <numeric>
#include <thread>

#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/subdivide.h"
#include "solvers/peer_solvers.h"
#include "studies/solver_rows.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

BenchSystem make_system(const std::string& name, const Mesh& mesh, std::size_t anchor_step) {
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  CpuKernels kernels;
  const BlockRows M = assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, all});
  const NormalPattern normal(M, Unknowns(all, all.size()));
  std::vector<double> W(all.size(), 0.0);
  for (std::size_t i = 0; i < W.size(); i += anchor_step) W[i] = 1.0;
  BenchSystem system{name, normal.blocks(), normal.normal_matrix(M, W), {}};
  system.scalar.block_size = 1;
  for (std::size_t e = 0; e < system.pattern.rows.size(); ++e) {
    system.scalar.values.push_back(system.coupled.values[9 * e]);
  }
  return system;
}

void print(const SolverRow& row) {
  std::printf("%-38s %8.1f %8.1f %8.1f %8.1f %8.1f %8.2f %8.2f %8.2f %8.1f  %.0e\n",
              row.name.c_str(), row.order, row.analyze, row.first_factor, row.factor,
              row.one_diagonal, row.one_column, row.twelve_columns, row.scalar_factor, row.cold(),
              row.error);
  std::fflush(stdout);
}

// Prints, per column, how many times faster our best solver is than the best other one.
void print_ratios(const std::vector<SolverRow>& ours, const std::vector<SolverRow>& others) {
  if (others.empty()) return;
  const auto ratio = [&](auto value) {
    const auto best = [&](const std::vector<SolverRow>& rows) {
      double least = value(rows.front());
      for (const SolverRow& row : rows) least = std::min(least, value(row));
      return least;
    };
    return best(others) / best(ours);
  };
  std::printf(
      "best of the others / best of ours: factor %.1f, one right-hand side %.1f, twelve "
      "%.1f, n x n factor %.1f, cold start %.1f\n",
      ratio([](const SolverRow& row) { return row.factor; }),
      ratio([](const SolverRow& row) { return row.one_column; }),
      ratio([](const SolverRow& row) { return row.twelve_columns; }),
      ratio([](const SolverRow& row) { return row.scalar_factor; }),
      ratio([](const SolverRow& row) { return row.cold(); }));
}

// Keeps one processor busy, as another program would.
class BusyNeighbour {
 public:
  BusyNeighbour()
      : thread_([this] {
          while (!stop_.load(std::memory_order_relaxed)) {
          }
        }) {}
  BusyNeighbour(const BusyNeighbour&) = delete;
  BusyNeighbour& operator=(const BusyNeighbour&) = delete;
  ~BusyNeighbour() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

SolverRow time_ours(const BenchSystem& system, InstructionSet set, unsigned threads,
                    Ordering ordering, int repeats) {
  BlockCholeskyOptions options;
  options.threads = threads;
  options.instruction_set = set;
  const std::string name = "ours " +
                           std::string(ordering == Ordering::minimum_degree ? "AMD" : "METIS") +
                           ", " + std::string(instruction_set_name(set)) + ", " +
                           std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  return time_solver(
      system, name, [&] { return std::make_unique<BlockCholesky>(options); }, ordering, repeats);
}

std::vector<SolverRow> time_ours(const BenchSystem& system, const SolveBench& settings) {
  std::vector<SolverRow> rows;
  for (const InstructionSet set : available_instruction_sets()) {
    for (const unsigned threads : settings.threads) {
      for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
        rows.push_back(time_ours(system, set, threads, ordering, settings.repeats));
        print(rows.back());
      }
    }
  }
  return rows;
}

#ifdef LAPWING_HAVE_CHOLMOD
std::vector<SolverRow> time_cholmods(const BenchSystem& system, int repeats) {
  std::vector<SolverRow> rows;
  for (const auto ordering :
       {CholmodOrdering::amd, CholmodOrdering::metis, CholmodOrdering::blocks}) {
    rows.push_back(time_cholmod(system, ordering, repeats));
    print(rows.back());
  }
  return rows;
}
#endif

void print_with_busy_neighbour(const BenchSystem& system, const SolveBench& settings) {
  const BusyNeighbour neighbour;
  std::printf("with one processor kept busy by something else\n");
  print(time_ours(system, available_instruction_sets().front(), settings.threads.front(),
                  Ordering::nested_dissection, settings.repeats));
#ifdef LAPWING_HAVE_CHOLMOD
  print(time_cholmod(system, CholmodOrdering::metis, settings.repeats));
#endif
}

void bench(const BenchSystem& system, const SolveBench& settings) {
  std::printf("\n%s: %zu blocks, %zu in the lower triangle; medians in milliseconds\n",
              system.name.c_str(), system.pattern.size(), system.pattern.rows.size());
  std::printf("%-38s %8s %8s %8s %8s %8s %8s %8s %8s %8s  %s\n", "", "order", "analyze", "1st fac",
              "factor", "1 diag", "1 rhs", "12 rhs", "n x n", "cold", "error");
  const std::vector<SolverRow> ours = time_ours(system, settings);
  std::vector<SolverRow> others;
#ifdef LAPWING_HAVE_CHOLMOD
  others = time_cholmods(system, settings.repeats);
#endif
  if (settings.eigen) {
    others.push_back(time_solver(system, "Eigen, METIS on blocks", make_eigen_solver,
                                 Ordering::nested_dissection, 1));
    print(others.back());
  }
  print_ratios(ours, others);
  if (settings.busy) print_with_busy_neighbour(system, settings);
}

}  // namespace

void bench_solve(const SolveBench& settings) {
  for (const std::string& path : settings.meshes) {
    Mesh mesh = read_mesh(path);
    for (int i = 0; i < settings.subdivisions; ++i) mesh = subdivide(mesh);
    BenchSystem system =
        make_system(std::filesystem::path(path).filename().string(), mesh, settings.anchor_step);
    system.coupled.pattern = system.scalar.pattern = &system.pattern;
    bench(system, settings);
  }
}

}  // namespace lapwing::bench
