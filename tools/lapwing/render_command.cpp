#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/draw_on_any_device.h"
#include "lapwing/render/frame_writer.h"
#include "lapwing/render/surface.h"
#include "messages.h"
#include "output_files.h"
#include "picture_options.h"
#include "progress_display.h"

namespace lapwing::cli {
namespace {

// The options of a turntable: a series of images for which the camera circles around the mesh.
struct TurntableOptions {
  int count = 0;  ///< number of images of a turntable; 0 for a single image
  double per_second = 30.0;

  void add_to(CLI::App& command);
  // Checks the options. Throws CLI::ValidationError if `output` names a video but only one image is
  // requested. Also throws the errors of `check_frames_name`.
  void check(const std::string& output) const;
};

void TurntableOptions::add_to(CLI::App& command) {
  const std::string group = "Turntable";
  auto* turntable = command.add_option(
      "--turntable", count,
      "number of pictures, once around the upward axis: NAME-0001.png and so on, or a video by "
      "ffmpeg if the output ends in .mp4, .webm or .gif");
  turntable->check(CLI::PositiveNumber)->group(group);
  command.add_option("--fps", per_second, "pictures per second of a video")
      ->check(CLI::Range(0.1, 240.0))
      ->needs(turntable)
      ->group(group)
      ->capture_default_str();
}

void TurntableOptions::check(const std::string& output) const {
  if (count > 0) return check_frames_name(output);
  if (is_video(output)) {
    throw CLI::ValidationError("--output", output +
                                               " is a video; give its number of pictures with "
                                               "--turntable, or end the name in .png");
  }
}

// Draws `surface` from the cameras of `way` and shows the progress. Writes the images to `output`
// (open_frames). After an interrupt, the finished numbered images remain, but no video.
void write_turntable(const std::string& output, const TurntableOptions& turntable,
                     const Turntable& way, Surface& surface, const SurfacePaint& paint,
                     const RenderOptions& options) {
  ProgressDisplay display(false);
  const Progress progress = display.callback();
  ImageRenderer renderer(surface.context(), options);
  const auto writer =
      open_frames(output, {.count = turntable.count,
                           .width = options.width,
                           .height = options.height,
                           .per_second = turntable.per_second,
                           .transparent = options.background == Background::transparent});
  for (int step = 0; step < turntable.count; ++step) {
    try {
      report_progress(progress, "pictures", static_cast<double>(step) / turntable.count);
    } catch (const Cancelled&) {
      if (is_video(output) || step == 0) throw;
      display.clear();
      say("cancelled; the first " + std::to_string(step) + " of " +
          counted(static_cast<std::size_t>(turntable.count), "pictures") + " are written");
      throw ExitWith{kCancelled};
    }
    writer->write(renderer.render(surface, paint, way.camera(step, turntable.count)));
  }
  writer->finish();
}

struct RenderArguments {
  std::string mesh;
  std::string image;
  std::string rest;
  std::string color;  ///< if empty, `color_of` chooses the colour
  std::string device = "auto";
  PictureOptions picture;
  TurntableOptions turntable;
};

Mesh read_rest_pose(const std::string& path, const Mesh& mesh) {
  Mesh rest = read_with_notes(path);
  if (rest.vertex_count() != mesh.vertex_count()) {
    throw InputError(path + " has " + std::to_string(rest.vertex_count()) +
                     " vertices, but the mesh to draw has " + std::to_string(mesh.vertex_count()) +
                     "; --rest needs another pose of the same mesh");
  }
  return rest;
}

// Returns the value of --color or its default. Throws CLI::ValidationError if the colour compares
// two poses but --rest is missing, or the reverse.
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

// Draws the requested images. Returns notes about the colours in the mesh file.
std::vector<std::string> draw(const RenderArguments& arguments, const std::string& color,
                              const Mesh& mesh, const std::optional<Mesh>& rest,
                              const std::shared_ptr<gpu::Context>& context) {
  const PictureRequest picture = arguments.picture.request();
  RenderOptions options = picture.options();
  Surface surface(context, mesh.positions, mesh.topology(), picture.feature_angle_degrees);
  SurfacePaint paint(surface);
  paint.set_polygons(mesh);
  std::vector<std::string> notes;
  if (rest) {
    color_by(color, mesh, rest->positions, paint, options);
  } else if (color == kFileColor) {
    notes = color_by_file(mesh, arguments.mesh, paint, options);
  }
  const Positions shown = surface_positions(mesh.positions, mesh.topology());
  if (arguments.turntable.count > 0) {
    write_turntable(arguments.image, arguments.turntable,
                    picture.turntable(shown, rest.has_value()), surface, paint, options);
  } else {
    const Camera camera = picture.camera(shown, rest.has_value());
    write_png(arguments.image, render_image(surface, paint, camera, options));
  }
  return notes;
}

void render(const RenderArguments& arguments) {
  require_places(arguments);
  const std::string color = color_of(arguments);
  arguments.picture.request();  // throws if an option is invalid
  const Mesh mesh = read_with_notes(arguments.mesh);
  warn_without_surface(mesh, arguments.mesh);
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
  command->add_option("MESH", arguments->mesh, kMeshHelp)->required();
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
