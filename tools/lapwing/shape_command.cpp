#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::cli {
namespace {

std::map<std::string, Mesh (*)()> shapes_by_name() {
  std::map<std::string, Mesh (*)()> shapes;
  for (const NamedShape& shape : named_shapes()) shapes.emplace(shape.name, shape.make);
  return shapes;
}

}  // namespace

void add_shape(CLI::App& app) {
  auto* command = app.add_subcommand("shape", "write a generated mesh, to try things on");
  auto shape = std::make_shared<std::string>();
  auto path = std::make_shared<std::string>();
  command->add_option("SHAPE", *shape, "name of the shape")
      ->required()
      ->check(CLI::IsMember(shapes_by_name()));
  command->add_option("-o,--output", *path, "OBJ, OFF, PLY, STL or glTF")->required();
  command->callback([shape, path] { write_mesh(shapes_by_name().at(*shape)(), *path); });
}

}  // namespace lapwing::cli
