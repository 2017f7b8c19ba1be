#pragma once

#include <string>

#include <CLI/App.hpp>

#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"

namespace lapwing::cli {

/// The options of a turntable.
struct TurntableOptions {
  int count = 0;  ///< number of pictures; 0: a single picture
  double per_second = 30.0;

  void add_to(CLI::App& command);
  /// Call before reading. Throws as check_frames_name does, and CLI::ValidationError if a single
  /// picture has the name of a video.
  void check(const std::string& output) const;
};

/// Writes the pictures of `surface` along `way` to `output` (open_frames), and shows the progress.
/// An interrupt leaves the finished numbered pictures, and no video.
void write_turntable(const std::string& output, const TurntableOptions& turntable,
                     const Turntable& way, Surface& surface, const SurfacePaint& paint,
                     const RenderOptions& options);

}  // namespace lapwing::cli
