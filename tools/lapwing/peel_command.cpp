#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/coating/peel.h"
#include "lapwing/io/mesh_file.h"
#include "messages.h"
#include "output_files.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct PeelArguments {
  std::string mesh;
  std::string output;
  std::string region = "all";
  double detail_size = 0.0;
  std::string weights = "cotangent";
  std::string coating = "displacement";
};

PeelRequest request_of(const PeelArguments& a) {
  PeelRequest request;
  request.region = region_spec("--region", a.region);
  request.detail_size = a.detail_size;
  request.weights =
      a.weights == "uniform" ? LaplacianWeights::uniform : LaplacianWeights::cotangent;
  request.where = "--detail-size";
  return request;
}

Mesh carrying(const std::string& coating, const Mesh& mesh, const PeelRequest& request,
              const Peeled& peeled) {
  static const std::map<std::string, CarriedCoating> kForms{
      {"displacement", CarriedCoating::displacement},
      {"height", CarriedCoating::height},
      {"laplacians", CarriedCoating::laplacians}};
  const auto form = kForms.find(coating);
  return form == kForms.end() ? peeled.mesh : with_coating(mesh, request, peeled, form->second);
}

void peel_mesh(const PeelArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--output", a.output);
  const Mesh mesh = read_with_notes(a.mesh);
  const PeelRequest request = request_of(a);
  const Peeled peeled = peel(mesh, request);
  print_notes(write_mesh(carrying(a.coating, mesh, request, peeled), a.output));
  // Do not print the only possible warning, that no vertex moved: this line also shows it.
  std::printf("%s: %zu of %s smoothed; coating %.3g on average, %.3g at most\n",
              shown(a.output).c_str(), peeled.moved.size(),
              counted(mesh.vertex_count(), "vertices").c_str(), peeled.mean_coating,
              peeled.largest_coating);
}

}  // namespace

void add_peel(CLI::App& app) {
  auto* command = app.add_subcommand(
      "peel", "take the fine detail off a surface: writes the smooth mesh and the coating");
  auto a = std::make_shared<PeelArguments>();
  command->add_option("MESH", a->mesh, kMeshHelp)->required();
  command
      ->add_option("-o,--output", a->output,
                   "the smooth mesh; PLY also stores the coating of each vertex")
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
                   "what to store: coating_x, _y, _z from the smooth surface to the mesh, "
                   "coating_height along its normals, or coating_x, _y, _z of the Laplacians")
      ->check(CLI::IsMember({"displacement", "height", "laplacians", "none"}))
      ->capture_default_str();
  command->callback([a] { peel_mesh(*a); });
}

}  // namespace lapwing::cli
