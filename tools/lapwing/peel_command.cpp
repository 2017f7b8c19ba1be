#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/region/vertex_set.h"
#include "mesh_output.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

using Eigen::Vector3d;

struct PeelArguments {
  std::string mesh;
  std::string output;
  std::string region = "all";
  double detail_size = 0.0;
  std::string weights = "cotangent";
  std::string coating = "displacement";
};

LaplacianWeights weights_of(const PeelArguments& a) {
  return a.weights == "uniform" ? LaplacianWeights::uniform : LaplacianWeights::cotangent;
}

VertexSet region_of(const PeelArguments& a, const Mesh& mesh, const Topology& topology) {
  return resolve(region_spec("--region", a.region), mesh, topology);
}

void require_finite(const VertexSet& region, const Positions& positions) {
  VertexSet broken;
  for (const Index v : region) {
    if (!positions[v].allFinite()) broken.push_back(v);
  }
  if (broken.empty()) return;
  throw InputError("--region: " + name_vertices(broken) +
                   " of the region has no finite position; leave it out, or mend the mesh with "
                   "`lapwing check --fix`");
}

// In place of one of the same name, as a mesh has that was peeled before.
void set_extra(Mesh& mesh, ExtraAttribute attribute) {
  auto& extras = mesh.attributes.vertex_extras;
  std::erase_if(extras, [&](const ExtraAttribute& e) { return e.name == attribute.name; });
  extras.push_back(std::move(attribute));
}

void add_vector(Mesh& mesh, const std::string& name, std::span<const Vector3d> vectors) {
  for (int axis = 0; axis < 3; ++axis) {
    ExtraAttribute attribute{name + "_" + "xyz"[axis], "double", 1, {}};
    for (const Vector3d& vector : vectors) attribute.values.push_back(vector[axis]);
    set_extra(mesh, std::move(attribute));
  }
}

// Along the normals of the smooth surface, outward.
void add_height(Mesh& mesh, const Topology& topology, std::span<const Vector3d> displacement) {
  const VertexSet all = resolve({}, mesh, topology);
  std::vector<Vector3d> normals(mesh.vertex_count(), Vector3d::Zero());
  vertex_normals(mesh.positions, topology.triangles, topology.vertex_triangles, all, normals);
  ExtraAttribute attribute{"coating_height", "double", 1, {}};
  for (std::size_t v = 0; v < normals.size(); ++v) {
    attribute.values.push_back(displacement[v].dot(normals[v]));
  }
  set_extra(mesh, std::move(attribute));
}

void peel_mesh(const PeelArguments& a) {
  Mesh mesh = read_mesh(a.mesh);
  const Topology topology = build_topology(mesh);
  const VertexSet region = region_of(a, mesh, topology);
  require_finite(region, mesh.positions);
  const Fairing fairing(mesh.positions, topology, region, weights_of(a));
  const Positions smooth = fairing.smooth(a.detail_size, "--detail-size");

  std::vector<Vector3d> displacement(smooth.size());
  double squares = 0.0;
  double largest = 0.0;
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    displacement[v] = Vector3d::Zero();
    if (!smooth[v].allFinite()) continue;
    displacement[v] = mesh.positions[v] - smooth[v];
    squares += displacement[v].squaredNorm();
    largest = std::max(largest, displacement[v].norm());
  }
  std::vector<Vector3d> xi(smooth.size());
  const auto weights = laplacian_weights(topology, mesh.positions, weights_of(a));
  const VertexSet all = resolve({}, mesh, topology);
  CpuKernels().sample_laplacians({displacement, topology.rings, weights, all}, xi);

  mesh.positions = smooth;
  // The file as it was read has no place for the coating.
  if (a.coating != "none") mesh.source.reset();
  if (a.coating == "height") add_height(mesh, topology, displacement);
  if (a.coating == "displacement") add_vector(mesh, "coating", displacement);
  if (a.coating == "laplacians") add_vector(mesh, "coating", xi);
  print_notes(write_mesh(mesh, a.output));
  const std::size_t moved = fairing.free().size();
  std::printf("%s: %zu of %zu vertices smoothed; coating %.3g in the mean, %.3g at most\n",
              a.output.c_str(), moved, smooth.size(),
              moved > 0 ? std::sqrt(squares / static_cast<double>(moved)) : 0.0, largest);
}

}  // namespace

void add_peel(CLI::App& app) {
  auto* command = app.add_subcommand(
      "peel", "take the fine detail off a surface: writes the smooth mesh, with what came off");
  auto a = std::make_shared<PeelArguments>();
  command->add_option("MESH", a->mesh, "OBJ, OFF, PLY or STL")->required();
  command
      ->add_option("-o,--output", a->output,
                   "the smooth mesh; PLY carries the coating along, by vertex")
      ->required();
  command
      ->add_option("--detail-size", a->detail_size,
                   "length: features smaller than this are coating")
      ->required()
      ->check(CLI::PositiveNumber);
  command->add_option("--region", a->region, kRegionHelp)->capture_default_str();
  command->add_option("--weights", a->weights)
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  command
      ->add_option("--coating", a->coating,
                   "what to carry: coating_x, _y, _z from the smooth surface to the mesh, "
                   "coating_height along its normals, or coating_x, _y, _z of the Laplacians")
      ->check(CLI::IsMember({"displacement", "height", "laplacians", "none"}))
      ->capture_default_str();
  command->callback([a] { peel_mesh(*a); });
}

}  // namespace lapwing::cli
