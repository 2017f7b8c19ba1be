#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "file_color_option.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/draw_on_any_device.h"
#include "lapwing/render/frame_writer.h"
#include "lapwing/render/surface.h"
#include "messages.h"
#include "output_files.h"
#include "picture_options.h"
#include "pose_colors.h"
#include "turntable_output.h"

namespace lapwing::cli {
namespace {

struct RenderArguments {
  std::string mesh;
  std::string image;
  std::string rest;
  std::string color;  ///< empty: chosen by the input
  std::string device = "auto";
  PictureOptions picture;
  TurntableOptions turntable;
};

Mesh read_rest_pose(const std::string& path, const Mesh& mesh) {
  Mesh rest = read_mesh(path);
  if (rest.vertex_count() != mesh.vertex_count()) {
    throw InputError(path + " has " + std::to_string(rest.vertex_count()) +
                     " vertices, but the mesh to draw has " + std::to_string(mesh.vertex_count()) +
                     "; --rest needs another pose of the same mesh");
  }
  return rest;
}

// Throws CLI::ValidationError if the colour does not fit `--rest`.
std::string color_of(const RenderArguments& arguments) {
  const bool has_rest = !arguments.rest.empty();
  if (arguments.color.empty()) return has_rest ? pose_colors().front() : kFileColor;
  const bool compares = arguments.color != kFileColor && arguments.color != kPlainColor;
  if (compares && !has_rest) {
    throw CLI::ValidationError("--color", arguments.color + " is a difference; it needs --rest");
  }
  if (!compares && has_rest) {
    throw CLI::ValidationError(
        "--rest", "--color " + arguments.color + " shows no difference; remove one of the two");
  }
  return arguments.color;
}

void require_places(const RenderArguments& arguments) {
  arguments.turntable.check(arguments.image);
  OutputFiles files;
  files.reads("MESH", arguments.mesh);
  files.reads("--rest", arguments.rest);
  if (arguments.turntable.count == 0) {
    files.writes_picture("--output", arguments.image);
  } else {
    files.writes("--output", is_video(arguments.image)
                                 ? std::filesystem::path(arguments.image)
                                 : frame_file(arguments.image, 1, arguments.turntable.count));
  }
}

// Returns notes on the file's colours.
std::vector<std::string> draw(const RenderArguments& arguments, const std::string& color,
                              const Mesh& mesh, const std::optional<Mesh>& rest,
                              const std::shared_ptr<gpu::Context>& context) {
  const PictureRequest picture = arguments.picture.request();
  RenderOptions options = picture.options();
  Surface surface(context, mesh.positions, mesh.topology());
  SurfacePaint paint(surface);
  paint.set_polygons(mesh);
  std::vector<std::string> notes;
  if (rest) {
    color_by(color, mesh, rest->positions, paint, options);
  } else if (color == kFileColor) {
    notes = color_by_file(mesh, arguments.mesh, paint, options);
  }
  if (arguments.turntable.count > 0) {
    write_turntable(arguments.image, arguments.turntable,
                    picture.turntable(mesh.positions, rest.has_value()), surface, paint, options);
  } else {
    const Camera camera = picture.camera(mesh.positions, rest.has_value());
    write_png(arguments.image, render_image(surface, paint, camera, options));
  }
  return notes;
}

void render(const RenderArguments& arguments) {
  require_places(arguments);
  const std::string color = color_of(arguments);
  arguments.picture.request();  // reports invalid options before the work
  const Mesh mesh = read_mesh(arguments.mesh);
  std::optional<Mesh> rest;
  if (!arguments.rest.empty()) rest = read_rest_pose(arguments.rest, mesh);
  std::vector<std::string> notes;
  const std::string changed = draw_on_any_device(
      std::make_shared<gpu::Context>(gpu::ContextOptions{arguments.device}),
      [&](const auto& context) { notes = draw(arguments, color, mesh, rest, context); });
  for (const std::string& note : notes) cli::note(note);
  if (!changed.empty()) cli::note(changed);
}

}  // namespace

void add_render(CLI::App& app) {
  auto* command = app.add_subcommand("render", "a picture of a mesh, without a display");
  auto arguments = std::make_shared<RenderArguments>();
  command->add_option("MESH", arguments->mesh, "OBJ, OFF, PLY, STL or glTF")->required();
  command
      ->add_option("-o,--output", arguments->image, "PNG; for a turntable also .mp4, .webm or .gif")
      ->required();
  command->add_option("--rest", arguments->rest,
                      "colour by the difference from this pose of the same mesh");
  std::vector<std::string> colors{kFileColor, kPlainColor};
  colors.insert(colors.end(), pose_colors().begin(), pose_colors().end());
  command
      ->add_option("--color", arguments->color,
                   "the colours of the file (textures, materials, vertex and face colours), plain "
                   "clay, or a difference; by default displacement with --rest, else file")
      ->check(CLI::IsMember(colors));
  command->add_option("--device", arguments->device, "auto, an index or a part of a name")
      ->capture_default_str();
  arguments->picture.add_to(*command);
  arguments->turntable.add_to(*command);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lapwing::cli
