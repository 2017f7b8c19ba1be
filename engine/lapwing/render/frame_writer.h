#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "lapwing/io/image.h"

namespace lapwing {

/// A sequence of images to write.
struct FrameSequence {
  int count = 1;
  std::uint32_t width = 1;   ///< in pixels, of each
  std::uint32_t height = 1;  ///< in pixels, of each
  double per_second = 30.0;  ///< frame rate of a video
  bool transparent = false;  ///< whether pixels may be transparent
};

/// Writes the images of a sequence one after the other. Never leaves an incomplete file.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;

  /// Writes the next image. May wait until ffmpeg has read it. Throws IoError.
  virtual void write(const Image& frame) = 0;
  /// Call this after the last image. Otherwise a video is discarded, and a file that existed before
  /// is not replaced.
  virtual void finish() = 0;
};

/// Returns whether `output` ends in .mp4, .webm or .gif, in any letter case.
bool is_video(const std::filesystem::path& output);

/// Returns whether ffmpeg, the program that writes videos, is on $PATH.
bool can_write_videos();

/// Returns the file of image `number`, counted from 1, of `count`: NAME-0001.png for `output`
/// NAME.png.
std::filesystem::path frame_file(const std::filesystem::path& output, int number, int count);

/// Returns a writer of numbered PNG files if `output` ends in .png, or of a video by the program
/// ffmpeg if it ends in .mp4, .webm or .gif. Transparent pixels become black in .mp4. For a .gif,
/// ffmpeg needs memory for all images at once. Throws InputError for another ending, and IoError if
/// ffmpeg is not on $PATH or the file cannot be created.
std::unique_ptr<FrameWriter> open_frames(const std::filesystem::path& output,
                                         const FrameSequence& sequence);

/// Throws the errors of open_frames that concern the name or ffmpeg, for an early check.
void check_frames_name(const std::filesystem::path& output);

}  // namespace lapwing
