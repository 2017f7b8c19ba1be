#include "edit_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/deform/certificate_warnings.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/kernels/timed_kernels.h"
#include "lapwing/recipe/recipe_files.h"
#include "lapwing/render/draw_on_any_device.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"
#include "lapwing/run/run_report.h"
#include "messages.h"
#include "output_files.h"

namespace lapwing::cli {
namespace {

// Returns a ratio as text with at most four digits, such as "0.126" or "1.234e+05".
std::string measured(double ratio) {
  if (!std::isfinite(ratio)) return "not measurable";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), std::abs(ratio) < 1000.0 ? "%.3f" : "%.4g", ratio);
  return text.data();
}

void print_certificate(const Certificate& c, double diagonal) {
  const std::string detail =
      std::isnan(c.detail_error) ? "not measurable (there is no detail)" : measured(c.detail_error);
  std::printf(
      "  %s %.1e, handle error %.2g of the diagonal, scale %s to %s,\n"
      "  largest rotation %.1f degrees, %s,\n"
      "  detail error %s, edge stretch %s",
      c.settle_iterations > 0 ? "residual force" : "residual",
      c.settle_iterations > 0 ? c.relative_gradient : c.relative_residual,
      diagonal > 0.0 ? c.handle_error / diagonal : 0.0, measured(c.smallest_scale).c_str(),
      measured(c.largest_scale).c_str(), c.largest_rotation_degrees,
      counted(c.flipped_triangles, "flipped triangles").c_str(), detail.c_str(),
      measured(c.edge_stretch).c_str());
  const auto& [a, b] = c.largest_edge_stretch_vertices;
  if (a != kNoIndex) {
    std::printf(", at most %s between vertices %u and %u", measured(c.largest_edge_stretch).c_str(),
                a, b);
  }
  std::printf("\n");
  if (c.settle_iterations == 0) return;
  std::printf(c.settled ? "  settled in %s, to %.1e of the mean edge\n"
                        : "  not settled after %s: one more would move a vertex by %.1e of the "
                          "mean edge\n",
              counted(static_cast<std::size_t>(c.settle_iterations), "iterations").c_str(),
              c.settle_last_step);
}

// Returns the warnings that are errors with --strict: those in the certificates of deform steps,
// and those about wraps.
std::vector<std::string> strict_warnings(const RunReport& report) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const StepReport& step = report.steps[i];
    const std::string place = "step " + std::to_string(i + 1) + ": ";
    if (step.wrap && !step.wrap->trouble.empty()) list.push_back(place + step.wrap->trouble);
    if (!step.deform) continue;
    for (const std::string& text : warnings_of(step.deform->certificate)) {
      list.push_back(place + text);
    }
  }
  return list;
}

void print_source(const CoatSourceReport& source) {
  std::printf("  coating from %s, scale %s", counted(source.vertices, "vertices").c_str(),
              measured(source.mean_scale).c_str());
  for (std::size_t p = 0; p < source.pins.size(); ++p) {
    std::printf("%s[%u, %u]", p == 0 ? ",\n  boundaries aligned at " : ", ", source.pins[p][0],
                source.pins[p][1]);
  }
  std::printf("\n  flipped in the domain: %s of the source, %zu of the target\n",
              counted(source.flipped_source, "triangles").c_str(), source.flipped_target);
}

void print_coat(const CoatReport& coat, std::size_t patch, double diagonal) {
  for (const CoatSourceReport& source : coat.sources) print_source(source);
  if (coat.vertices_before_remeshing > 0) {
    std::printf("  patch remeshed from %zu to %s\n", coat.vertices_before_remeshing,
                counted(patch, "vertices").c_str());
  }
  std::printf("  fading in over %.3g, residual %.1e, largest displacement %.2g of the diagonal\n",
              coat.transition_width, coat.relative_residual,
              diagonal > 0.0 ? coat.largest_displacement / diagonal : 0.0);
}

void print_transplant(const TransplantReport& transplant, double diagonal) {
  std::printf("  part of %s%s, loops of %zu and %s",
              counted(transplant.part_vertices, "vertices").c_str(),
              transplant.turned ? " turned inside out" : "", transplant.host_loop,
              counted(transplant.part_loop, "vertices").c_str());
  if (transplant.welded > 0) std::printf(", %zu of them welded", transplant.welded);
  if (transplant.strip_triangles > 0) {
    std::printf(",\n  zipped by %s", counted(transplant.strip_triangles, "triangles").c_str());
  }
  if (transplant.remeshed_vertices > 0) {
    std::printf(", transition remeshed to %s",
                counted(transplant.remeshed_vertices, "vertices").c_str());
  }
  std::printf("\n  transition over %.3g, free for %.3g beyond, held for %.3g\n",
              transplant.transition_width, transplant.padding, transplant.belt);
  std::printf(
      "  residual %.1e, seam turns by at most %.3g degrees an edge,\n"
      "  largest displacement %.2g of the diagonal\n",
      transplant.relative_residual, transplant.seam_degrees,
      diagonal > 0.0 ? transplant.largest_displacement / diagonal : 0.0);
}

const char* words_of(AlignmentMethod method) {
  switch (method) {
    case AlignmentMethod::none:
      return "as it is";
    case AlignmentMethod::landmarks:
      return "by the landmarks";
    case AlignmentMethod::surfaces:
      return "by the surfaces";
  }
  return "";
}

void print_distance(const char* name, const SurfaceDistance& distance, double diagonal) {
  std::printf("  %-18s mean %.4f%%, 95th percentile %.4f%%, largest %.4f%%\n", name,
              100.0 * distance.mean / diagonal, 100.0 * distance.percentile_95 / diagonal,
              100.0 * distance.max / diagonal);
}

void print_wrap(const WrapStepReport& wrap) {
  std::printf("  aligned %s, scaled by %.4g; %d minimizations\n", words_of(wrap.alignment.method),
              wrap.alignment.scale, wrap.steps);
  std::printf("  distances, in percent of the scan's diagonal:\n");
  print_distance("result to scan", wrap.to_scan, wrap.scan_diagonal);
  print_distance("scan to result", wrap.to_template, wrap.scan_diagonal);
  std::printf("  %.1f%% of the template has a counterpart on the scan\n", 100.0 * wrap.coverage);
  if (wrap.landmark_error > 0.0) {
    std::printf("  largest error of a landmark %.4f%%\n",
                100.0 * wrap.landmark_error / wrap.scan_diagonal);
  }
  std::printf("  flipped triangles %zu, self-intersecting triangles %s, edge stretch %.3f\n",
              wrap.flipped_triangles,
              wrap.self_intersecting ? std::to_string(*wrap.self_intersecting).c_str() : "unknown",
              wrap.edge_stretch);
}

void print_kernels(const DeviceInfo& device, std::span<const KernelTime> times) {
  std::printf("kernels\n");
  for (const KernelTime& time : times) {
    std::printf("  %-24s %10.2f ms in %s on %s\n", time.kernel.c_str(), time.milliseconds,
                counted(time.calls, "calls").c_str(), printable(time.device).c_str());
  }
  if (!device.frames) {
    std::printf("  settling runs on the CPU, which is faster than this device (--frames device)\n");
  }
}

void print_summary(const RunReport& report, std::span<const KernelTime> kernels) {
  std::printf("%s: %s, %s\n%s", shown(report.mesh).c_str(),
              counted(report.vertices, "vertices").c_str(), counted(report.faces, "faces").c_str(),
              format_stages(report).c_str());
  for (const StepReport& step : report.steps) {
    const double diagonal = report.bounds.diagonal();
    if (step.deform) print_certificate(step.deform->certificate, diagonal);
    if (step.coat) print_coat(*step.coat, step.roi, diagonal);
    if (step.transplant) print_transplant(*step.transplant, diagonal);
    if (step.wrap) print_wrap(*step.wrap);
    if (step.peel) {
      std::printf("  coating %.3g on average, %.3g at most\n", step.peel->mean_coating,
                  step.peel->largest_coating);
    }
  }
  if (!kernels.empty() || !report.device.frames) print_kernels(report.device, kernels);
  std::printf("peak memory %.0f MB\n", static_cast<double>(report.peak_memory_bytes) / 1e6);
}

void print_written(const RunResult& result, const std::filesystem::path& target) {
  std::printf("wrote %s\n", shown(target.lexically_normal()).c_str());
  for (const AttachmentFile& file : result.carried) {
    std::printf("wrote %s\n", shown(file.target(target).lexically_normal()).c_str());
  }
}

}  // namespace

CLI::Option* EditOutput::add_to(CLI::App& command, const std::string& save_flag) {
  std::vector<std::string> colors{"regions", kFileColor, kPlainColor, kDistanceColor};
  colors.insert(colors.end(), pose_colors().begin(), pose_colors().end());
  auto* saved = command.add_option(save_flag, save, "write the edited mesh to this file");
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
      .add_option("--frames", frames,
                  "where settling runs: auto uses the CPU for a software device; device never does")
      ->check(CLI::IsMember({"auto", "device"}))
      ->capture_default_str();
  command.add_flag("--strict", strict,
                   "exit with 4 if a step is not settled, flips triangles or stretches an edge "
                   "far, or if a wrap is not usable; files are still written");
  command.add_flag("--quiet", quiet, "print errors only");
  picture.add_to(command);
  return saved;
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
  if (color == kDistanceColor &&
      (recipe.steps.empty() || !std::holds_alternative<WrapStep>(recipe.steps.back()))) {
    throw InputError("--color distance shows the result of a wrap, but the last step is none");
  }
  const auto target = save.empty() ? recipe.save_path() : std::filesystem::path(save);
  require_place_for_motion(target);
  require_places(recipe, target, recipe_file, recipe_path);
  const std::string recipe_text = recipe_path.empty() ? "" : to_json(recipe);
  const Device opened = open_device(device, frames == "device");
  if (!quiet && !opened.note.empty()) note(opened.note);
  TimedKernels kernels(*opened.kernels);
  ProgressDisplay display(quiet);
  const auto result = run_recipe(recipe, kernels, display.callback(), {report_vertices});
  display.clear();
  FileReplacements files;
  if (!target.empty()) save_result(*result, target, files, {vertex_motion});
  std::string no_pictures;
  if (!render.empty() || !render_before.empty()) {
    no_pictures = add_pictures(*result, recipe.mesh_path(), opened, files);
  }
  if (!report.empty()) files.add(report, to_json(result->report));
  if (!recipe_path.empty()) files.add(recipe_path, recipe_text);
  files.commit();
  const std::vector<std::string> failures =
      strict ? strict_warnings(result->report) : std::vector<std::string>();
  for (const std::string& text : quiet ? failures : result->report.warnings) warn(text);
  if (!quiet) {
    for (const std::string& text : result->report.notes) note(text);
    print_summary(result->report, kernels.times());
    if (!target.empty()) print_written(*result, target);
  }
  if (!no_pictures.empty()) {
    say("no picture was drawn, but all other files are written: " + no_pictures);
    throw ExitWith{kDevice};
  }
  if (!failures.empty()) {
    say("--strict: the result has warnings, see above; all files are written");
    throw ExitWith{kSolver};
  }
}

std::string EditOutput::add_pictures(const RunResult& result,
                                     const std::filesystem::path& mesh_file, const Device& used,
                                     FileReplacements& files) const {
  Pictures pictures;
  try {
    // If the edit ran on the CPU, or its device was lost, open a device to draw the images.
    const bool has_failed = !used.kernels->device().took_over.empty();
    const std::string changed = draw_on_any_device(
        has_failed ? nullptr : used.context,
        [&](const auto& context) { pictures = draw(result, mesh_file, context); });
    if (!changed.empty()) pictures.notes.push_back(changed);
  } catch (const GpuError& error) {
    return error.what();
  }
  for (const std::string& text : pictures.notes) {
    if (!quiet) note(text);
  }
  if (!render_before.empty()) files.add(render_before, pictures.before);
  if (!render.empty()) files.add(render, pictures.after);
  return {};
}

EditOutput::Pictures EditOutput::draw(const RunResult& result,
                                      const std::filesystem::path& mesh_file,
                                      const std::shared_ptr<gpu::Context>& context) const {
  const PictureRequest asked = picture.request();
  Surface surface(context, result.original, result.mesh.topology(), asked.feature_angle_degrees);
  SurfacePaint paint(surface);
  paint.set_polygons(result.mesh);
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
  } else if (color == kDistanceColor) {
    color_by_distance(result.report.steps.back().wrap->distances, paint, options);
  }
  const Topology& topology = result.mesh.topology();
  Positions both = surface_positions(result.original, topology);
  const Positions after = surface_positions(result.mesh.positions, topology);
  both.insert(both.end(), after.begin(), after.end());
  const Camera camera = asked.camera(both, options.style.color == SurfaceColor::scalar);
  if (!render_before.empty()) {
    pictures.before = encode_png(render_image(surface, paint, camera, options));
  }
  surface.place(result.mesh.positions);
  if (!render.empty()) pictures.after = encode_png(render_image(surface, paint, camera, options));
  return pictures;
}

}  // namespace lapwing::cli
