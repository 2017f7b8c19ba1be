#include "edit_output.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "exit_code.h"
#include "file_color_option.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/recipe/recipe_files.h"
#include "lapwing/render/draw_on_any_device.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"
#include "lapwing/session/report.h"
#include "messages.h"
#include "output_files.h"
#include "pose_colors.h"

namespace lapwing::cli {
namespace {

void print_certificate(const Certificate& c, double diagonal) {
  std::printf(
      "  %s %.1e, handle error %.2g of the diagonal, scale %.3f to %.3f,\n"
      "  largest rotation %.1f degrees, %zu flipped triangles,\n"
      "  detail error %.3f, edge stretch %.3f",
      c.settle_iterations > 0 ? "balance" : "residual",
      c.settle_iterations > 0 ? c.relative_gradient : c.relative_residual,
      diagonal > 0.0 ? c.handle_error / diagonal : 0.0, c.smallest_scale, c.largest_scale,
      c.largest_rotation_degrees, c.flipped_triangles, c.detail_error, c.edge_stretch);
  const auto& [a, b] = c.largest_edge_stretch_vertices;
  if (a != kNoIndex) {
    std::printf(", at most %.3f between vertices %u and %u", c.largest_edge_stretch, a, b);
  }
  std::printf("\n");
  if (c.settle_iterations == 0) return;
  std::printf(c.settled ? "  settled in %d iterations, to %.1e of the mean edge\n"
                        : "  not settled after %d iterations: one more would move a vertex by %.1e "
                          "of the mean edge\n",
              c.settle_iterations, c.settle_last_step);
}

void print_source(const CoatSourceReport& source) {
  std::printf("  coating from %zu vertices, scale %.3f", source.vertices, source.mean_scale);
  for (std::size_t p = 0; p < source.pins.size(); ++p) {
    std::printf("%s[%u, %u]", p == 0 ? ",\n  boundaries aligned at " : ", ", source.pins[p][0],
                source.pins[p][1]);
  }
  std::printf("\n  flipped in the domain: %zu triangles of the source, %zu of the target\n",
              source.flipped_source, source.flipped_target);
}

void print_coat(const CoatReport& coat, std::size_t patch, double diagonal) {
  for (const CoatSourceReport& source : coat.sources) print_source(source);
  if (coat.vertices_before_remeshing > 0) {
    std::printf("  patch remeshed from %zu to %zu vertices\n", coat.vertices_before_remeshing,
                patch);
  }
  std::printf("  fading in over %.3g, residual %.1e, largest displacement %.2g of the diagonal\n",
              coat.transition_width, coat.relative_residual,
              diagonal > 0.0 ? coat.largest_displacement / diagonal : 0.0);
}

void print_transplant(const TransplantReport& transplant, double diagonal) {
  std::printf("  part of %zu vertices%s, loops of %zu and %zu vertices", transplant.part_vertices,
              transplant.turned ? " turned inside out" : "", transplant.host_loop,
              transplant.part_loop);
  if (transplant.welded > 0) std::printf(", %zu of them welded", transplant.welded);
  if (transplant.strip_triangles > 0) {
    std::printf(",\n  zipped by %zu triangles", transplant.strip_triangles);
  }
  if (transplant.remeshed_vertices > 0) {
    std::printf(", transition remeshed to %zu vertices", transplant.remeshed_vertices);
  }
  std::printf("\n  transition over %.3g, free for %.3g beyond, held for %.3g\n",
              transplant.transition_width, transplant.padding, transplant.belt);
  std::printf(
      "  residual %.1e, seam turns by at most %.3g degrees an edge,\n"
      "  largest displacement %.2g of the diagonal\n",
      transplant.relative_residual, transplant.seam_degrees,
      diagonal > 0.0 ? transplant.largest_displacement / diagonal : 0.0);
}

void print_summary(const RunReport& report) {
  std::printf("%s: %zu vertices, %zu faces\n%s", shown(report.mesh).c_str(), report.vertices,
              report.faces, format_stages(report).c_str());
  for (const StepReport& step : report.steps) {
    const double diagonal = report.bounds.diagonal();
    if (step.deform) print_certificate(step.deform->certificate, diagonal);
    if (step.coat) print_coat(*step.coat, step.roi, diagonal);
    if (step.transplant) print_transplant(*step.transplant, diagonal);
    if (step.peel) {
      std::printf("  coating %.3g on average, %.3g at most\n", step.peel->mean_coating,
                  step.peel->largest_coating);
    }
  }
  std::printf("  peak memory %.0f MB\n", static_cast<double>(report.peak_memory_bytes) / 1e6);
}

void print_written(const RunResult& result, const std::filesystem::path& target) {
  std::printf("wrote %s\n", shown(target.lexically_normal()).c_str());
  for (const AttachmentFile& file : result.carried) {
    std::printf("wrote %s\n", shown(file.target(target).lexically_normal()).c_str());
  }
}

}  // namespace

void EditOutput::add_to(CLI::App& command) {
  std::vector<std::string> colors{"regions", kFileColor, kPlainColor};
  colors.insert(colors.end(), pose_colors().begin(), pose_colors().end());
  command.add_option("--save", save, "write the edited mesh here");
  command.add_flag("--vertex-motion", vertex_motion,
                   "save the total motion of each vertex as properties of the PLY: dx, dy, dz, the "
                   "rotation qw, qx, qy, qz, and stretch");
  auto* reported = command.add_option("--report", report,
                                      "write device, sizes, timings and certificates as JSON");
  command
      .add_flag("--report-vertices", report_vertices,
                "add displacement, rotation, detail error and stretch of every vertex of the "
                "regions to the report")
      ->needs(reported);
  command.add_option("--render", render, "write a picture of the result (PNG)");
  command.add_option("--render-before", render_before, "the same picture before the edit (PNG)");
  command
      .add_option("--color", color,
                  "what the pictures show; regions are drawn over the colours of the mesh's file")
      ->check(CLI::IsMember(colors))
      ->capture_default_str();
  command.add_option("--device", device, "auto, cpu, an index or a part of a name (lapwing info)")
      ->capture_default_str();
  command
      .add_option(
          "--frames", frames,
          "where drag frames and settling run: auto uses the processor for a software device")
      ->check(CLI::IsMember({"auto", "device"}))
      ->capture_default_str();
  command.add_flag("--strict", strict,
                   "exit with 4 if a step is not settled, flips triangles or stretches an edge "
                   "far; files are still written");
  command.add_flag("--quiet", quiet, "print errors only");
  picture.add_to(command);
}

void EditOutput::require_place_for_motion(const std::filesystem::path& target) const {
  if (!vertex_motion || (!target.empty() && format_of(target) == MeshFormat::ply)) return;
  throw CLI::ValidationError(
      "--vertex-motion",
      (target.empty() ? "nothing is saved" : target.string() + " cannot store it") +
          std::string("; use --save with a .ply file"));
}

void EditOutput::require_places(const Recipe& recipe, const std::filesystem::path& target,
                                const std::filesystem::path& recipe_file,
                                const std::filesystem::path& recipe_path) const {
  OutputFiles files;
  const RecipeFiles named = files_of(recipe, target);
  for (std::size_t k = 0; k < named.read.size(); ++k) {
    files.reads(k == 0 ? "the mesh" : "a source of the edit", named.read[k], k == 0);
  }
  files.reads("the recipe", recipe_file);
  files.writes_mesh("the result", target);
  files.writes("--report", report);
  files.writes_picture("--render", render);
  files.writes_picture("--render-before", render_before);
  files.writes("--recipe", recipe_path);
  for (std::size_t k = target.empty() ? 0 : 1; k < named.written.size(); ++k) {
    files.writes("a carried file", named.written[k]);
  }
}

void EditOutput::run(const Recipe& recipe, const std::filesystem::path& recipe_file,
                     const std::filesystem::path& recipe_path) const {
  if (!sandbox.empty()) require_inside(recipe, sandbox);
  // Report invalid options before the work.
  picture.request();
  const auto target = save.empty() ? recipe.save_path() : std::filesystem::path(save);
  require_place_for_motion(target);
  require_places(recipe, target, recipe_file, recipe_path);
  const std::string recipe_text = recipe_path.empty() ? "" : to_json(recipe);
  const Device opened = open_device(device, frames == "device");
  ProgressDisplay display(quiet);
  display.note("device: " + opened.kernels->device().name);
  const auto result = run_recipe(recipe, *opened.kernels, display.callback(), {report_vertices});
  FileReplacements files;
  if (!target.empty()) save_result(*result, target, files, {vertex_motion});
  std::string no_pictures;
  if (!render.empty() || !render_before.empty()) {
    no_pictures = add_pictures(*result, recipe.mesh_path(), opened, files, display);
  }
  if (!report.empty()) files.add(report, to_json(result->report));
  if (!recipe_path.empty()) files.add(recipe_path, recipe_text);
  files.commit();
  for (const std::string& warning : result->report.warnings) display.note("note: " + warning);
  for (const std::string& note : result->report.notes) display.note("note: " + note);
  if (!quiet) {
    print_summary(result->report);
    if (!target.empty()) print_written(*result, target);
  }
  if (!no_pictures.empty()) {
    say("no picture was drawn, but all other files are written: " + no_pictures);
    throw ExitWith{kDevice};
  }
  const auto& steps = result->report.steps;
  if (strict && std::any_of(steps.begin(), steps.end(), [](const StepReport& step) {
        return step.deform && !warnings_of(step.deform->certificate).empty();
      })) {
    std::fprintf(stderr, "lapwing: --strict: the result has warnings, see above\n");
    throw ExitWith{kSolver};
  }
}

std::string EditOutput::add_pictures(const RunResult& result,
                                     const std::filesystem::path& mesh_file, const Device& used,
                                     FileReplacements& files, ProgressDisplay& display) const {
  Pictures pictures;
  try {
    // An edit on the processor has no device, or has lost it. Then a device is opened for the
    // picture.
    const bool has_failed = !used.kernels->device().took_over.empty();
    const std::string changed = draw_on_any_device(
        has_failed ? nullptr : used.context,
        [&](const auto& context) { pictures = draw(result, mesh_file, context); });
    if (!changed.empty()) display.note("note: " + changed);
  } catch (const GpuError& error) {
    return error.what();
  }
  for (const std::string& note : pictures.notes) display.note("note: " + note);
  if (!render_before.empty()) files.add(render_before, pictures.before);
  if (!render.empty()) files.add(render, pictures.after);
  return {};
}

EditOutput::Pictures EditOutput::draw(const RunResult& result,
                                      const std::filesystem::path& mesh_file,
                                      const std::shared_ptr<gpu::Context>& context) const {
  Surface surface(context, result.original, result.mesh.topology());
  SurfacePaint paint(surface);
  paint.set_polygons(result.mesh);
  const PictureRequest asked = picture.request();
  RenderOptions options = asked.options();
  Pictures pictures;
  if (color == "regions" || color == kFileColor) {
    pictures.notes = color_by_file(result.mesh, mesh_file, paint, options);
  }
  if (color == "regions" && !result.region.roi.empty()) {
    options.style.color = SurfaceColor::regions;
    paint.set_classes(vertex_classes(result.region, result.mesh.vertex_count()));
  } else if (std::ranges::count(pose_colors(), color) > 0) {
    color_by(color, result.mesh, result.original, paint, options);
  }
  Positions both = result.original;
  both.insert(both.end(), result.mesh.positions.begin(), result.mesh.positions.end());
  const Camera camera = asked.camera(both, options.style.color == SurfaceColor::scalar);
  if (!render_before.empty()) {
    pictures.before = encode_png(render_image(surface, paint, camera, options));
  }
  surface.place(result.mesh.positions);
  if (!render.empty()) pictures.after = encode_png(render_image(surface, paint, camera, options));
  return pictures;
}

}  // namespace lapwing::cli
