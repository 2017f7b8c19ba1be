#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::cli {
namespace {

// A tube with ripples that no motion of its ends should wash out.
Mesh rippled_tube() {
  Mesh mesh = cylinder(60, 121, 0.5, 6.0);
  for (Eigen::Vector3d& p : mesh.positions) {
    const double angle = std::atan2(p.y(), p.x());
    const double ripple =
        0.03 * std::sin(8.0 * angle) * std::sin(20.0 * std::numbers::pi * p.z() / 6.0);
    p.head<2>() *= 1.0 + ripple;
  }
  return mesh;
}

const std::map<std::string, Mesh (*)()> kShapes{{"tube", rippled_tube},
                                                {"sphere", [] { return icosphere(5); }},
                                                {"sheet", [] { return grid(100, 100); }},
                                                {"torus", [] { return torus(160, 64, 1.0, 0.4); }}};

}  // namespace

void add_shape(CLI::App& app) {
  auto* command = app.add_subcommand("shape", "write a generated mesh, to try things on");
  auto shape = std::make_shared<std::string>();
  auto path = std::make_shared<std::string>();
  command->add_option("SHAPE", *shape, "tube, sphere, sheet or torus")
      ->required()
      ->check(CLI::IsMember(kShapes));
  command->add_option("-o,--output", *path, "OBJ, OFF, PLY or STL")->required();
  command->callback([shape, path] { write_mesh(kShapes.at(*shape)(), *path); });
}

}  // namespace lapwing::cli
