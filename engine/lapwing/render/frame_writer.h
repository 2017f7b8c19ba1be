#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "lapwing/io/image.h"

namespace lapwing {

/// A sequence of pictures that is to be written.
struct FrameSequence {
  int count = 1;
  std::uint32_t width = 1;   ///< in pixels, of each
  std::uint32_t height = 1;  ///< likewise
  double per_second = 30.0;  ///< of a video
  bool transparent = false;  ///< whether some pixels may be
};

/// Where the pictures of a sequence go, one after the other. No file is ever there by half.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;

  /// The next one. May wait for what reads it. Throws IoError.
  virtual void write(const Image& frame) = 0;
  /// After the last one: without this a video is given up, and what was there before stays.
  virtual void finish() = 0;
};

/// Whether a sequence called so is a video: .mp4, .webm or .gif, in either case of letters.
bool is_video(const std::filesystem::path& output);

/// Whether the program that writes videos, ffmpeg, is on $PATH.
bool can_write_videos();

/// The file of picture `number`, from 1, of a sequence of `count` called NAME.png: NAME-0001.png.
std::filesystem::path frame_file(const std::filesystem::path& output, int number, int count);

/// Writes numbered PNG files where `output` ends in .png, and a video by the program ffmpeg where
/// it ends in .mp4, .webm or .gif. Of these .mp4 knows no transparency: it is black there; for a
/// .gif all pictures are in memory at once. Throws InputError for another ending, and IoError where
/// ffmpeg is not on $PATH or the file cannot be made.
std::unique_ptr<FrameWriter> open_frames(const std::filesystem::path& output,
                                         const FrameSequence& sequence);

/// Throws what open_frames throws for the name alone, before there is a picture.
void check_frames_name(const std::filesystem::path& output);

}  // namespace lapwing
