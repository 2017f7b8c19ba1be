#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/surface.h"
#include "picture_options.h"
#include "pose_colors.h"
#include "turntable_output.h"

namespace lapwing::cli {
namespace {

struct RenderArguments {
  std::string mesh;
  std::string image;
  std::string rest;
  std::string color = "displacement";
  std::string device = "auto";
  PictureOptions picture;
  TurntableOptions turntable;
};

Mesh read_rest_pose(const std::string& path, const Mesh& mesh) {
  Mesh rest = read_mesh(path);
  if (rest.vertex_count() != mesh.vertex_count()) {
    throw InputError(path + " has " + std::to_string(rest.vertex_count()) +
                     " vertices and the mesh to draw " + std::to_string(mesh.vertex_count()) +
                     "; --rest needs another pose of the same mesh");
  }
  return rest;
}

void render(const RenderArguments& arguments) {
  arguments.turntable.check(arguments.image);
  RenderOptions options = arguments.picture.render_options();
  const Mesh mesh = read_mesh(arguments.mesh);
  Surface surface(std::make_shared<gpu::Context>(gpu::ContextOptions{arguments.device}),
                  mesh.positions, mesh.topology());
  SurfacePaint paint(surface);
  paint.set_polygons(mesh);
  if (!arguments.rest.empty()) {
    const Mesh rest = read_rest_pose(arguments.rest, mesh);
    color_by(arguments.color, mesh, rest.positions, paint, options);
  }
  const bool with_legend = !arguments.rest.empty();
  if (arguments.turntable.count > 0) {
    return write_turntable(arguments.image, arguments.turntable,
                           arguments.picture.turntable(mesh.positions, with_legend), surface, paint,
                           options);
  }
  const Camera camera = arguments.picture.camera(mesh.positions, with_legend);
  write_png(arguments.image, render_image(surface, paint, camera, options));
}

}  // namespace

void add_render(CLI::App& app) {
  auto* command = app.add_subcommand("render", "a picture of a mesh, without a display");
  auto arguments = std::make_shared<RenderArguments>();
  command->add_option("MESH", arguments->mesh, "OBJ, OFF, PLY or STL")->required();
  command
      ->add_option("-o,--output", arguments->image, "PNG; of a turntable also .mp4, .webm or .gif")
      ->required();
  auto* rest = command->add_option("--rest", arguments->rest,
                                   "colour by the difference from this pose of the same mesh");
  command->add_option("--color", arguments->color, "which difference")
      ->check(CLI::IsMember(pose_colors()))
      ->needs(rest)
      ->capture_default_str();
  command->add_option("--device", arguments->device, "auto, an index or a part of a name")
      ->capture_default_str();
  arguments->picture.add_to(*command);
  arguments->turntable.add_to(*command);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lapwing::cli
