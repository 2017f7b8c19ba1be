#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>

#include "lapwing/io/mesh_file.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/mesh/subdivide.h"
#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/ordering.h"
#include "run/measure.h"
#include "run/subject.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

struct OrderRow {
  double milliseconds = 0;
  double flops = 0;
};

OrderRow time_order(const BlockPattern& pattern, int repeats,
                    const std::function<std::vector<int>()>& order) {
  OrderRow row;
  std::vector<int> found;
  row.milliseconds = measure(repeats, [&] { found = order(); }).median();
  BlockCholesky solver;
  solver.analyze(pattern, 3, found);
  row.flops = solver.statistics().flops;
  return row;
}

void bench(const std::string& name, const Mesh& mesh, const OrderBench& settings) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  const Unknowns unknowns(all, all.size());
  const Topology& topology = mesh.topology();
  const NormalPattern normal(ring_blocks(topology.rings, all), unknowns);
  const BlockPattern& pattern = normal.blocks();
  const CouplingGraph graph = coupling_graph(topology.rings, all, unknowns);
  const OrderRow ours =
      time_order(pattern, settings.repeats, [&] { return dissection_order(graph); });
  const OrderRow amd = time_order(pattern, settings.repeats, [&] {
    return fill_reducing_order(pattern, Ordering::minimum_degree);
  });
  const OrderRow metis = time_order(pattern, std::min(settings.repeats, 3), [&] {
    return fill_reducing_order(pattern, Ordering::nested_dissection);
  });
  std::printf("%-28s %9zu %9.1f %9.1f %9.1f %9.2f %8.2f %8.2f\n", name.c_str(), all.size(),
              ours.milliseconds, amd.milliseconds, metis.milliseconds, ours.flops / 1e9,
              ours.flops / amd.flops, ours.flops / metis.flops);
  std::fflush(stdout);
}

}  // namespace

void bench_order(const OrderBench& settings) {
  std::printf("%-28s %9s %9s %9s %9s %9s %8s %8s\n", "", "blocks", "ours ms", "AMD ms", "METIS ms",
              "GFLOP", "of AMD", "of METIS");
  for (const std::string& path : settings.meshes) {
    Mesh mesh = read_mesh(path);
    for (int i = 0; i < settings.subdivisions; ++i) mesh = subdivide(mesh);
    bench(std::filesystem::path(path).filename().string(), mesh, settings);
  }
  for (const Index across : settings.hills) bench("hills", hills(across), settings);
}

}  // namespace lapwing::bench
