#pragma once

#include <string>

#include <CLI/App.hpp>

#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"

namespace lapwing::cli {

/// The options of a command that makes pictures from all around.
struct TurntableOptions {
  int count = 0;  ///< of the pictures; 0: a single one is wanted
  double per_second = 30.0;

  void add_to(CLI::App& command);
  /// Before anything is read: throws what check_frames_name does, and CLI::ValidationError for a
  /// single picture that is called like a video.
  void check(const std::string& output) const;
};

/// Writes the pictures of `surface` on its way around to `output` (open_frames), and shows how far
/// that is. An interrupt ends it: numbered pictures stay as far as they are done, of a video
/// nothing.
void write_turntable(const std::string& output, const TurntableOptions& turntable,
                     const Turntable& way, Surface& surface, const SurfacePaint& paint,
                     const RenderOptions& options);

}  // namespace lapwing::cli
