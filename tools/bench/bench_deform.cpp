#include <cstdio>
#include <map>

#include <Eigen/SparseCore>

#include "benches.h"
#include "lapwing/base/memory_use.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/settle/settle.h"
#include "lapwing/vulkan/open_device.h"
#include "measure.h"
#include "time_cgal_arap.h"
#include "whole_mesh_region.h"

namespace lapwing::bench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse as_sparse(const BlockRows& M, std::size_t vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * M.columns.size());
  for (std::size_t r = 0; r < M.size(); ++r) {
    for (std::size_t b = M.starts[r]; b < M.starts[r + 1]; ++b) {
      for (std::size_t k = 0; k < 9; ++k) {
        entries.emplace_back(static_cast<int>(3 * r + k % 3),
                             static_cast<int>(3 * M.columns[b] + k / 3), M.values[9 * b + k]);
      }
    }
  }
  Sparse S(static_cast<int>(3 * M.size()), static_cast<int>(3 * vertex_count));
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

Samples eigen_product(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                      Kernels& kernels, int repeats) {
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);
  const Sparse M =
      as_sparse(assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, region.roi}),
                mesh.vertex_count());
  const Sparse Mt = M.transpose();
  return measure(repeats, [&] { const Sparse N = Mt * M; });
}

// The mean of many, from rest, on what a Deformer would run them on.
Samples settle_iteration(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                         const Eigen::Affine3d& motion, Kernels& kernels, int repeats) {
  constexpr int kIterations = 50;
  const Constraints constraints = constraints_of(region, topology, 1.0, false);
  StageTimings timings;
  const SystemPattern pattern(topology, region.roi, constraints.unknowns);
  const LaplacianSystem system(mesh.positions, topology, region.roi, constraints, pattern,
                               LaplacianWeights::uniform, 0.0, timings);
  SettleOptions options;
  options.max_iterations = kIterations;
  options.tolerance = 1e-300;
  CpuKernels cpu;
  Settler settler(kernels.device().type == "software" ? cpu : kernels, system, options);
  Positions wanted(mesh.vertex_count(), Eigen::Vector3d::Zero());
  for (const Index v : region.handles[0])
    wanted[v] = motion * mesh.positions[v] - mesh.positions[v];
  Samples samples = measure(repeats, [&] {
    Positions u(mesh.vertex_count(), Eigen::Vector3d::Zero());
    settler.settle(wanted, u);
  });
  for (double& ms : samples.milliseconds) ms /= kIterations;
  return samples;
}

// Preparations that alternate between an edit and one that differs in one thing, on the same ROI.
struct Again {
  const char* name;
  Samples samples;
};
std::vector<Again> prepare_again(const Mesh& mesh, const Topology& topology,
                                 const EditRegion& region, const DeformOptions& options,
                                 Kernels& kernels, int repeats) {
  struct Edit {
    EditRegion region;
    DeformOptions options;
  };
  const Edit first{region, options};
  std::vector<std::pair<const char*, Edit>> others{
      {"handle", first}, {"belt", first}, {"weight", first}, {"Laplacian", first}, {"mu", first}};
  const auto by_half = [](VertexSet& vertices) { vertices.resize(vertices.size() / 2); };
  by_half(others[0].second.region.handles[0]);
  by_half(others[1].second.region.belt);
  others[2].second.options.constraint_weight = 2.0;
  others[3].second.options.weights = LaplacianWeights::cotangent;
  others[3].second.options.settle->weights = LaplacianWeights::cotangent;
  others[4].second.options.settle->stretch_resistance = 0.1;
  std::vector<Again> results;
  for (const auto& [name, other] : others) {
    PreparedRegion prepared(topology);
    bool turn = false;
    const auto prepare = [&, &other = other] {
      const Edit& edit = std::exchange(turn, !turn) ? other : first;
      const Deformer deformer(prepared, mesh.positions, edit.region, edit.options, kernels);
    };
    prepare();
    results.push_back({name, measure(2 * repeats, prepare)});
  }
  return results;
}

void print_row(const char* name, const Samples& samples) {
  std::printf("  %-28s %10.2f %10.2f %10.2f\n", name, samples.median(), samples.min(),
              samples.max());
}

}  // namespace

void bench_deform(const std::filesystem::path& path, const std::string& device, SolverKind solver,
                  int repeats) {
  const Mesh mesh = read_mesh(path);
  const Topology topology = build_topology(mesh);
  const EditRegion region = whole_mesh_region(mesh);
  const auto kernels = open_device(device);
  const std::array motions{
      Eigen::Affine3d(Eigen::Translation3d(0.0, 0.2 * bounds_of(mesh.positions).diagonal(), 0.0))};

  DeformOptions options;
  options.solver = solver;
  options.settle.emplace();

  // Stages of one preparation are read from the deformer itself; only the total is timed here.
  std::vector<std::string> order;
  std::map<std::string, Samples> stages;
  std::unique_ptr<Deformer> deformer;
  const Samples total = measure(repeats, [&] {
    deformer.reset();
    deformer = std::make_unique<Deformer>(mesh.positions, topology, region, options, *kernels);
    for (const auto& [name, ms] : deformer->timings().stages()) {
      if (!stages.contains(name)) order.push_back(name);
      stages[name].milliseconds.push_back(ms);
    }
  });
  // As an interactive user gets it: the preview, and after it what makes it exact.
  std::unique_ptr<DragPreview> preview;
  Samples first_drag;
  const Samples exact = measure(repeats, [&] {
    preview.reset();
    deformer.reset();
    const Stopwatch watch;
    preview = std::make_unique<DragPreview>(mesh.positions, topology, region, options, *kernels);
    preview->drag(motions);
    first_drag.milliseconds.push_back(watch.elapsed_ms());
    deformer = std::make_unique<Deformer>(*preview, *kernels);
  });
  const auto again = prepare_again(mesh, topology, region, options, *kernels, repeats);
  const Samples drag = measure(20 * repeats, [&] { deformer->drag(motions); });
  std::vector<double> x(3 * deformer->unknown_count(), 1.0);
  const Samples back = measure(repeats, [&] { deformer->back_substitute(x); });
  const Samples commit = measure(repeats, [&] { deformer->solve(motions); });
  const Samples iteration = settle_iteration(mesh, topology, region, motions[0], *kernels, repeats);
  const Samples product = eigen_product(mesh, topology, region, *kernels, repeats);

  std::printf("%s: %zu vertices, device %s, solver %s, %d runs\n", path.filename().c_str(),
              mesh.vertex_count(), kernels->device().name.c_str(),
              std::string(deformer->solver_name()).c_str(), repeats);
  std::printf("  %-28s %10s %10s %10s\n", "milliseconds", "median", "min", "max");
  for (const std::string& name : order) print_row(name.c_str(), stages[name]);
  print_row("whole preparation", total);
  for (const auto& [name, ms] : preview->timings().stages()) {
    std::printf("    of the preview: %-12s %10.2f\n", name.c_str(), ms);
  }
  print_row("time to first drag (preview)", first_drag);
  print_row("  and to the exact one", exact);
  for (const auto& [name, samples] : again) {
    print_row(("again, another " + std::string(name)).c_str(), samples);
  }
  print_row("drag frame with normals", drag);
  print_row("one back-substitution", back);
  print_row("one settle iteration", iteration);
  print_row("settled, with certificate", commit);
  print_row("Eigen's sparse product M'M", product);
#ifdef LAPWING_HAVE_CGAL
  const Samples arap = time_cgal_arap(mesh, topology, region, repeats);
  print_row("CGAL's ARAP preprocess", arap);
  std::printf("  whole preparation / CGAL's ARAP   %.3f\n", total.median() / arap.median());
  std::printf("  first drag / CGAL's ARAP          %.3f\n", first_drag.median() / arap.median());
#endif
  std::printf("  normal matrix / Eigen's product   %.3f\n",
              stages["normal_matrix"].median() / product.median());
  std::printf("  whole preparation / factorization %.3f\n",
              total.median() / stages["factor"].median());
  for (const auto& [name, samples] : again) {
    std::printf("  again, another %-9s / whole   %.3f\n", name, samples.median() / total.median());
  }
  std::printf("  drag frame / back-substitution    %.3f\n", drag.median() / back.median());
  std::printf("  settle iteration / back-subst.    %.3f\n", iteration.median() / back.median());
  std::printf("  first drag / exact one after it    %.3f\n", first_drag.median() / exact.median());
  std::printf("  peak memory                       %.0f MB\n",
              static_cast<double>(peak_memory_bytes()) / 1e6);
}

}  // namespace lapwing::bench
