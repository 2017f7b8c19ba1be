#include <cstdio>
#include <numeric>

#include <CLI/CLI.hpp>

#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/shapes.h"
#include "solver_rows.h"

namespace lapwing::bench {
namespace {

struct Settings {
  std::vector<std::string> meshes;
  int icosphere = -1;
  int subdivisions = 0;
  int repeats = 7;
  std::vector<unsigned> threads{2, 1};
  std::size_t anchor_step = 50;
  bool eigen = false;
};

BenchSystem make_system(const std::string& name, const Mesh& mesh, std::size_t anchor_step) {
  const Topology topology = build_topology(mesh);
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  CpuKernels kernels;
  const RsiRows M = assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, all});
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

// How many times faster the best of ours is than the best of the others, column by column.
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

std::vector<SolverRow> time_ours(const BenchSystem& system, const Settings& settings) {
  std::vector<SolverRow> rows;
  for (const InstructionSet set : available_instruction_sets()) {
    for (const unsigned threads : settings.threads) {
      for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
        BlockCholeskyOptions options;
        options.threads = threads;
        options.instruction_set = set;
        BlockCholesky solver(options);
        const std::string name =
            "ours " + std::string(ordering == Ordering::minimum_degree ? "AMD" : "METIS") + ", " +
            std::string(instruction_set_name(set)) + ", " + std::to_string(threads) + " threads";
        rows.push_back(time_solver(system, name, solver, ordering, settings.repeats));
        print(rows.back());
      }
    }
  }
  return rows;
}

void bench(const BenchSystem& system, const Settings& settings) {
  std::printf("\n%s: %zu blocks, %zu in the lower triangle; milliseconds\n", system.name.c_str(),
              system.pattern.size(), system.pattern.rows.size());
  std::printf("%-38s %8s %8s %8s %8s %8s %8s %8s %8s %8s  %s\n", "", "order", "analyze", "1st fac",
              "factor", "1 diag", "1 rhs", "12 rhs", "n x n", "cold", "error");
  const std::vector<SolverRow> ours = time_ours(system, settings);
  std::vector<SolverRow> others;
#ifdef LAPWING_HAVE_CHOLMOD
  for (const auto ordering :
       {CholmodOrdering::amd, CholmodOrdering::metis, CholmodOrdering::blocks}) {
    others.push_back(time_cholmod(system, ordering, settings.repeats));
    print(others.back());
  }
#endif
  if (settings.eigen) {
    const auto solver = make_solver(SolverKind::eigen);
    others.push_back(
        time_solver(system, "Eigen, METIS on blocks", *solver, Ordering::nested_dissection, 1));
    print(others.back());
  }
  print_ratios(ours, others);
}

void run(const Settings& settings) {
  const auto bench_mesh = [&](const std::string& name, Mesh mesh) {
    for (int i = 0; i < settings.subdivisions; ++i) mesh = subdivide(mesh);
    BenchSystem system = make_system(name, mesh, settings.anchor_step);
    system.coupled.pattern = system.scalar.pattern = &system.pattern;
    bench(system, settings);
  };
  for (const std::string& path : settings.meshes) bench_mesh(path, read_mesh(path));
  if (settings.icosphere >= 0) {
    bench_mesh("icosphere " + std::to_string(settings.icosphere), icosphere(settings.icosphere));
  }
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  lapwing::bench::Settings settings;
  CLI::App app("Times the block Cholesky beside CHOLMOD and Eigen on RSI systems of whole meshes.",
               "lapwing-solver-bench");
  app.add_option("MESH", settings.meshes, "mesh files");
  app.add_option("--icosphere", settings.icosphere, "also an icosphere divided so many times");
  app.add_option("--subdivide", settings.subdivisions,
                 "split every mesh's triangles so many times");
  app.add_option("--repeats", settings.repeats)->check(CLI::Range(1, 1000));
  app.add_option("--threads", settings.threads, "thread counts to time");
  app.add_option("--anchor-step", settings.anchor_step, "every so many vertices one is anchored")
      ->check(CLI::Range(1, 1'000'000));
  app.add_flag("--eigen", settings.eigen, "Eigen too (minutes above 30,000 vertices)");
  CLI11_PARSE(app, argc, argv);
  try {
    lapwing::bench::run(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lapwing-solver-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
