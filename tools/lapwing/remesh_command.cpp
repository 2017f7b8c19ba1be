#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/quality.h"
#include "mesh_output.h"
#include "progress_display.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct RemeshArguments {
  std::string mesh;
  std::string output;
  std::string region = "all";
  std::optional<double> length;
  double scale = 1.0;
  RemeshOptions options;
  bool quiet = false;
};

VertexSet chosen_region(const RemeshArguments& arguments, const Mesh& mesh) {
  return resolve(region_spec("--region", arguments.region), mesh, build_topology(mesh));
}

double wanted_length(const RemeshArguments& arguments, const RegionQuality& before) {
  if (arguments.length) return *arguments.length;
  if (before.mean_edge > 0.0) return arguments.scale * before.mean_edge;
  throw InputError("the region's faces have no extent, so --scale means nothing; give --length");
}

void print_result(const RegionQuality& before, const RegionQuality& after) {
  std::printf("vertices %zu, were %zu\nfaces %zu, were %zu\n", after.vertices, before.vertices,
              after.faces, before.faces);
  std::printf("mean edge %.4g, was %.4g\nsmallest angle %.1f degrees, was %.1f\n", after.mean_edge,
              before.mean_edge, after.smallest_angle_degrees, before.smallest_angle_degrees);
}

void remesh(const RemeshArguments& arguments) {
  const Mesh mesh = read_mesh(arguments.mesh);
  const VertexSet region = chosen_region(arguments, mesh);
  const RegionQuality before = region_quality(mesh, region);
  const double length = before.faces == 0 ? 1.0 : wanted_length(arguments, before);
  RemeshResult result;
  {
    ProgressDisplay display(arguments.quiet);
    result = remesh_isotropic(
        mesh, region, [&](const Eigen::Vector3d&) { return length; }, arguments.options,
        display.callback());
  }
  WriteReport report = write_mesh(result.mesh, arguments.output);
  if (!result.note.empty()) report.notes.push_back(result.note);
  print_notes(report);
  if (!arguments.quiet) print_result(before, region_quality(result.mesh, result.region));
}

}  // namespace

void add_remesh(CLI::App& app) {
  auto* command =
      app.add_subcommand("remesh", "nearly equilateral triangles of one size, on the same surface");
  auto a = std::make_shared<RemeshArguments>();
  command->add_option("MESH", a->mesh, "OBJ, OFF, PLY or STL")->required();
  command->add_option("-o,--output", a->output, "its extension names the format")->required();
  command->add_option("--region", a->region, kRegionHelp)->capture_default_str();
  auto* length =
      command->add_option("--length", a->length, "wanted edge length")->check(CLI::PositiveNumber);
  command->add_option("--scale", a->scale, "wanted edge length, in mean edges of the region")
      ->check(CLI::PositiveNumber)
      ->excludes(length)
      ->capture_default_str();
  command->add_option("--iterations", a->options.iterations, "rounds of splitting to relaxing")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--feature-angle", a->options.feature_angle_degrees,
                   "degrees between two faces from which their edge is kept")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->add_flag("--quiet", a->quiet, "print errors and notes only");
  command->callback([a] { remesh(*a); });
}

}  // namespace lapwing::cli
