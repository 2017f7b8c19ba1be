#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/remesh/remesh.h"
#include "messages.h"
#include "output_files.h"
#include "progress_display.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct RemeshArguments {
  std::string mesh;
  std::string output;
  std::string region = "all";
  RemeshRequest request;
  bool quiet = false;
};

void print_result(const RegionQuality& before, const RegionQuality& after) {
  std::printf("vertices %zu, were %zu\nfaces %zu, were %zu\n", after.vertices, before.vertices,
              after.faces, before.faces);
  std::printf("mean edge %.4g, was %.4g\nsmallest angle %.1f degrees, was %.1f\n", after.mean_edge,
              before.mean_edge, after.smallest_angle_degrees, before.smallest_angle_degrees);
}

void remesh_mesh(const RemeshArguments& arguments) {
  OutputFiles files;
  files.reads("MESH", arguments.mesh, true);
  files.writes_mesh("--output", arguments.output);
  const Mesh mesh = read_mesh(arguments.mesh);
  RemeshRequest request = arguments.request;
  request.region = region_spec("--region", arguments.region);
  request.where = "--scale";
  Remeshed result;
  {
    ProgressDisplay display(arguments.quiet);
    result = remesh(mesh, request, display.callback());
  }
  WriteReport report = write_mesh(result.mesh, arguments.output);
  for (std::string& warning : result.warnings) report.notes.push_back(std::move(warning));
  print_notes(report);
  if (!arguments.quiet) print_result(result.before, result.after);
}

}  // namespace

void add_remesh(CLI::App& app) {
  auto* command =
      app.add_subcommand("remesh", "nearly equilateral triangles of one size, on the same surface");
  auto a = std::make_shared<RemeshArguments>();
  command->add_option("MESH", a->mesh, "OBJ, OFF, PLY, STL or glTF")->required();
  command->add_option("-o,--output", a->output, "its extension names the format")->required();
  command->add_option("--region", a->region, kRegionHelp)->capture_default_str();
  auto* length = command->add_option("--length", a->request.length, "target edge length")
                     ->check(CLI::PositiveNumber);
  command
      ->add_option("--scale", a->request.scale, "target edge length, in mean edges of the region")
      ->check(CLI::PositiveNumber)
      ->excludes(length)
      ->capture_default_str();
  command->add_option("--iterations", a->request.options.iterations, "number of remeshing rounds")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--feature-angle", a->request.options.feature_angle_degrees,
                   "keep edges whose faces meet at this angle or more, in degrees")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->add_flag("--quiet", a->quiet, "print errors and notes only");
  command->callback([a] { remesh_mesh(*a); });
}

}  // namespace lapwing::cli
