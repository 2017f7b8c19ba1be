#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::cli {
namespace {

const std::map<std::string, Mesh (*)()> kShapes{
    {"tube", [] { return rippled_cylinder(); }},
    {"sphere", [] { return icosphere(5); }},
    {"sheet", [] { return grid(100, 100); }},
    {"torus", [] { return torus(160, 64, 1.0, 0.4); }},
    // What the motions of tools/classics start from.
    {"bumpy-plane", [] { return bumpy_plane(200, 10, 0.03); }},
    {"cylinder", [] { return cylinder(48, 100, 0.5, 6.0); }},
    {"bar", [] { return bar(16, 96, 1.0, 6.0); }}};

}  // namespace

void add_shape(CLI::App& app) {
  auto* command = app.add_subcommand("shape", "write a generated mesh, to try things on");
  auto shape = std::make_shared<std::string>();
  auto path = std::make_shared<std::string>();
  command->add_option("SHAPE", *shape, "which")->required()->check(CLI::IsMember(kShapes));
  command->add_option("-o,--output", *path, "OBJ, OFF, PLY or STL")->required();
  command->callback([shape, path] { write_mesh(kShapes.at(*shape)(), *path); });
}

}  // namespace lapwing::cli
