#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/topology.h"
#include "run/measure.h"
#include "run/subject.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

// Handle and belt each hold the region's vertices divided by this.
constexpr std::size_t kHeldShare = 20;
// Handles move by this share of the region's diagonal. Every other one turns, too.
constexpr double kMove = 0.1;
constexpr double kTurn = std::numbers::pi / 6.0;

constexpr std::array kStages{"pattern",       "order",  "laplacian", "assemble", "analyze",
                             "normal_matrix", "factor", "shares",    "solve"};

// Returns the first `count` vertices of a breadth-first search from `seed`.
std::vector<Index> around(Index seed, std::size_t count, const Topology& topology) {
  std::vector<char> seen(topology.rings.row_count(), 0);
  std::vector<Index> found{seed};
  seen[seed] = 1;
  for (std::size_t at = 0; at < found.size() && found.size() < count; ++at) {
    for (const Index j : topology.rings[found[at]]) {
      if (seen[j] != 0 || found.size() == count) continue;
      seen[j] = 1;
      found.push_back(j);
    }
  }
  return found;
}

struct Edit {
  EditRegion region;
  Affine3d motion = Affine3d::Identity();
};

// Returns edit number k. Its handle is nearest to the seed, its belt farthest from it.
Edit edit_of(std::size_t k, bool turned, const EditsBench& settings, const Mesh& mesh) {
  const auto seed = static_cast<Index>(k * mesh.vertex_count() / settings.count);
  const std::vector<Index> vertices = around(seed, settings.vertices, mesh.topology());
  const auto held = static_cast<std::ptrdiff_t>(vertices.size() / kHeldShare);
  Edit edit;
  edit.region.roi = make_vertex_set(vertices);
  edit.region.handles = {make_vertex_set({vertices.begin(), vertices.begin() + held})};
  edit.region.belt = make_vertex_set({vertices.end() - held, vertices.end()});
  Positions places;
  for (const Index v : vertices) places.push_back(mesh.positions[v]);
  const auto axis = static_cast<Eigen::Index>(k % 3);
  const Vector3d& pivot = mesh.positions[seed];
  edit.motion.translate(pivot + kMove * bounds_of(places).diagonal() * Vector3d::Unit(axis));
  if (turned) edit.motion.rotate(Eigen::AngleAxisd(kTurn, Vector3d::Unit((axis + 1) % 3)));
  edit.motion.translate(-pivot);
  return edit;
}

// Times of the edits of one kind.
struct EditTimes {
  Samples whole;
  std::map<std::string, Samples> stages;
  std::size_t refused = 0;
};

void carry_out(const Edit& edit, const Mesh& mesh, const DeformParameters& parameters,
               EditTimes& times) {
  CpuKernels kernels;
  const Stopwatch watch;
  const DeformSolver deformer(mesh.positions, mesh.topology(), edit.region, parameters, kernels);
  const double prepared_ms = watch.elapsed_ms();
  deformer.solve(std::array{edit.motion});
  times.whole.milliseconds.push_back(watch.elapsed_ms());
  times.stages["solve"].milliseconds.push_back(watch.elapsed_ms() - prepared_ms);
  for (const auto& [stage, ms] : deformer.timings().stages()) {
    times.stages[stage].milliseconds.push_back(ms);
  }
}

void print(const std::string& name, const char* kind, std::size_t vertices,
           const EditTimes& times) {
  if (times.whole.milliseconds.empty()) return;
  std::printf("| %-20s | %-6s | %9zu | %5zu | %7zu | %7.1f | %7.1f | %7.1f |", name.c_str(), kind,
              vertices, times.whole.milliseconds.size(), times.refused, times.whole.min(),
              times.whole.median(), times.whole.max());
  for (const char* const stage : kStages) {
    const auto found = times.stages.find(stage);
    std::printf(" %6.1f |", found == times.stages.end() ? 0.0 : found->second.median());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void bench(const std::string& name, const Mesh& mesh, const EditsBench& settings) {
  DeformParameters parameters;
  if (!settings.settled) parameters.settle.reset();
  mesh.topology();
  std::array<EditTimes, 2> kinds;
  for (std::size_t k = 0; k < settings.count; ++k) {
    const bool turned = k % 2 == 1;
    EditTimes& times = kinds[turned ? 1 : 0];
    try {
      carry_out(edit_of(k, turned, settings, mesh), mesh, parameters, times);
    } catch (const Error& error) {
      if (++times.refused == 1) std::printf("%s, edit %zu: %s\n", name.c_str(), k, error.what());
    }
  }
  print(name, "moved", mesh.vertex_count(), kinds[0]);
  print(name, "turned", mesh.vertex_count(), kinds[1]);
}

}  // namespace

void bench_edits(const EditsBench& settings) {
  std::printf(
      "Edits of regions of %zu vertices around vertices all over each mesh, each prepared anew,\n"
      "%s: milliseconds, the least, the median and the most, and medians of the stages.\n\n"
      "| mesh                 | handle |  vertices | edits | refused |   least |  median |    most "
      "| pattern | order | n x n | assemble | analyze | matrix | factor | shares | solve |\n"
      "|----------------------|--------|----------:|------:|--------:|--------:|--------:|--------:"
      "|------:|------:|------:|------:|------:|------:|------:|------:|------:|\n",
      settings.vertices, settings.settled ? "and settled" : "by the linear response");
  for (const std::string& file : settings.meshes) {
    const std::string name = std::filesystem::path(file).stem().string();
    try {
      bench(name, read_mesh(file), settings);
    } catch (const Error& error) {
      std::printf("| %-20s | %s\n", name.c_str(), error.what());
    }
  }
  for (const Index across : settings.hills) bench("hills", hills(across), settings);
}

}  // namespace lapwing::bench
