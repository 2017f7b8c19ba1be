#include "turntable_output.h"

#include <cstdio>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "exit_code.h"
#include "lapwing/base/errors.h"
#include "lapwing/render/frame_writer.h"
#include "lapwing/render/surface.h"
#include "progress_display.h"

namespace lapwing::cli {

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
      display.note("lapwing: cancelled; the first " + std::to_string(step) + " of " +
                   std::to_string(turntable.count) + " pictures are written");
      throw ExitWith{kCancelled};
    }
    writer->write(renderer.render(surface, paint, way.camera(step, turntable.count)));
  }
  writer->finish();
}

}  // namespace lapwing::cli
