#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/mesh/subdivide.h"
#include "messages.h"
#include "output_files.h"

namespace lapwing::cli {
namespace {

struct SubdivideArguments {
  std::string mesh;
  std::string output;
  int times = 1;
  bool smooth = false;
};

void subdivide_mesh(const SubdivideArguments& arguments) {
  OutputFiles files;
  files.reads("MESH", arguments.mesh, true);
  files.writes_mesh("--output", arguments.output);
  Mesh mesh = read_mesh(arguments.mesh);
  require_subdividable(mesh, arguments.times);
  for (int i = 0; i < arguments.times; ++i) {
    mesh = arguments.smooth ? loop_subdivide(mesh) : subdivide(mesh);
  }
  print_notes(write_mesh(mesh, arguments.output));
}

}  // namespace

void add_subdivide(CLI::App& app) {
  auto* command =
      app.add_subcommand("subdivide", "a finer triangle mesh: every triangle becomes four");
  auto arguments = std::make_shared<SubdivideArguments>();
  command->add_option("MESH", arguments->mesh, "OBJ, OFF, PLY, STL or glTF")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "positions and triangles only; its extension names the format")
      ->required();
  command->add_option("--times", arguments->times, "number of subdivisions")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command->add_flag("--smooth", arguments->smooth,
                    "smooth the shape by Loop's scheme; by default the shape stays the same");
  command->callback([arguments] { subdivide_mesh(*arguments); });
}

}  // namespace lapwing::cli
